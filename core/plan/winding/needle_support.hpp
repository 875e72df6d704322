#pragma once
/// The support points of a winding plan, and the swivels of the needle with which they are tried.
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/plan/winding/winding_plan.hpp"

namespace bahnwerk {

/// Returns the largest pivot shifts with which a plan is tried, in their order, rad: a fixed series from large ones to
/// 0, as far as the request's pivot limit admits them. What is tried with one limit is therefore tried with every
/// larger one, too. One entry, the request's own limit, for a rotor, without limit, and for an inadmissible limit.
std::vector<std::optional<double>> tried_swivels(const WindingRequest& request);

/// Returns the support points of these turns for the needle's model, with the shape and the clearance of the request.
/// Throws what support_points() throws.
Expected<std::vector<winding::FixedPiece>, winding::NoSupport> needle_support(const WindingRequest& request,
                                                                              const std::vector<winding::Turn>& turns,
                                                                              winding::NeedleModel model,
                                                                              Progress progress);

/// Return the reason as a sentence for people; `support` is that of the path.
const char* in_words(winding::NoSupport why);
std::string in_words(const winding::NoPath& why, const std::vector<winding::FixedPiece>& support);

/// Checks that the needle's holder and the swivel stay outside the slot at these support points. Throws InvalidInput
/// naming needle.length or machine.l_tool where the tip goes deeper into the slot than they are long.
void check_depth(const WindingRequest& request, const std::vector<winding::FixedPiece>& support);

/// Tells whether the needle has the same poses at all support points.
bool same_poses(const std::vector<winding::FixedPiece>& a, const std::vector<winding::FixedPiece>& b);

}  // namespace bahnwerk
