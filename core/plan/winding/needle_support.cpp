#include "core/plan/winding/needle_support.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>

namespace bahnwerk {
namespace {

using winding::FixedPiece;
using winding::RotorPart;
using winding::StatorPart;

// Largest pivot shifts that are tried, deg. A needle aims at the middle of the opening by some degrees at most, so
// steps are finer there.
constexpr double swivel_series[] = {80, 60, 50, 40, 30, 25, 20, 15, 12, 10, 8, 6, 5, 4, 3, 2, 1, 0};

/// Returns the largest depth of the tip in the slot, mm; `depth` is that at a distance from the axis.
template <class Depth>
double deepest(const std::vector<FixedPiece>& support, Depth depth) {
  double most = 0;
  for (const FixedPiece& piece : support)
    if (piece.kind == FixedPiece::Kind::region && piece.region % 2 == 0)
      for (const winding::SupportPoint* point : {&piece.begin, &piece.end})
        most = std::max(most, depth(std::hypot(point->pose.tip.x, point->pose.tip.y)));
  return most;
}

/// Returns the depth of the tip in the slot, mm: below a stator's bore, or under a rotor's outer circle.
double slot_depth(const WindingRequest& request, const std::vector<FixedPiece>& support) {
  if (const auto* stator = std::get_if<StatorPart>(&request.part))
    return deepest(support, [bore = winding::bore(*stator) / 2](double from_axis) { return from_axis - bore; });
  const auto& rotor = std::get<RotorPart>(request.part);
  const double outer = winding::outer_radius(rotor, winding::checked_slot(rotor));
  return deepest(support, [outer](double from_axis) { return outer - from_axis; });
}

std::string where(const FixedPiece& piece) {
  const std::string turn = "turn " + std::to_string(piece.turn + 1) + " of coil " + std::to_string(piece.coil + 1);
  return piece.kind == FixedPiece::Kind::coil_change
             ? "the way to the next coil after " + turn
             : std::string(winding::region_in_words(piece.region)) + " of " + turn;
}

bool same_pose(const winding::NeedlePose& a, const winding::NeedlePose& b) {
  return a.tip.x == b.tip.x && a.tip.y == b.tip.y && a.tip.z == b.tip.z && a.phi == b.phi && a.psi == b.psi;
}

}  // namespace

std::vector<std::optional<double>> tried_swivels(const WindingRequest& request) {
  constexpr double degree = std::numbers::pi / 180, rounding = 1e-12;
  const std::optional<double> limit = request.model.pivot_limit;
  if (!limit || !(*limit >= 0 && *limit < std::numbers::pi / 2) || std::holds_alternative<RotorPart>(request.part))
    return {limit};
  std::vector<std::optional<double>> tried;
  for (const double swivel : swivel_series)
    if (swivel * degree <= *limit + rounding) tried.emplace_back(swivel * degree);
  return tried;
}

Expected<std::vector<FixedPiece>, winding::NoSupport> needle_support(const WindingRequest& request,
                                                                     const std::vector<winding::Turn>& turns,
                                                                     winding::NeedleModel model, Progress progress) {
  model.shape = request.needle, model.clearance = request.least_clearance;
  if (const auto* stator = std::get_if<StatorPart>(&request.part))
    return winding::support_points(*stator, request.coils, turns, model, progress);
  return winding::support_points(std::get<RotorPart>(request.part), turns, model, progress);
}

const char* in_words(winding::NoSupport why) {
  using enum winding::NoSupport;
  switch (why) {
    case no_distance:
      return "two laying regions have no distance: the wire between them has no direction";
    case short_head:
      return "a winding head is shorter than the needle's way into it";
    case no_direction:
      return "no direction of the needle brings the wire to its place";
    case beyond_axis:
      return "the needle's tip would lie beyond the part's axis: the wire leaves its place in a head too steeply, or "
             "bends in too large a circle for the bore; needed is a part.tool_radius nearer to the slots' base, more "
             "part.tool_height, or less pull.bend_radius";
    case backwards:
      return "the wire would leave the needle backwards along its axis";
  }
  return "";
}

std::string in_words(const winding::NoPath& why, const std::vector<FixedPiece>& support) {
  const FixedPiece& from = support[why.fixed];
  if (why.reason == winding::NoPath::Reason::no_length) return where(from) + " has no length";
  const FixedPiece& to = support[why.fixed + 1];
  const std::string link = where(from) + " and " + where(to);
  if (why.reason == winding::NoPath::Reason::cusp) return "no link without a cusp found between " + link;
  return "no room for a link between " + link +
         (from.kind == to.kind ? "" : ": raise needle.change_radius or needle.change_height");
}

void check_depth(const WindingRequest& request, const std::vector<FixedPiece>& support) {
  const double depth = slot_depth(request, support);
  const auto check = [&](double length, std::vector<std::string> place, const char* what) {
    if (length >= depth) return;
    char text[160];
    std::snprintf(text, sizeof text, "is too short: the tip goes %.4g mm deep into the slot, and %s with it", depth,
                  what);
    throw InvalidInput(std::vector<InputFault>{{std::move(place), text}});
  };
  check(request.needle.length, {"needle", "length"}, "the needle's holder");
  check(request.swivel_length, {"machine", "l_tool"}, "the swivel");
}

bool same_poses(const std::vector<FixedPiece>& a, const std::vector<FixedPiece>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const FixedPiece& x, const FixedPiece& y) {
    return same_pose(x.begin.pose, y.begin.pose) && same_pose(x.end.pose, y.end.pose);
  });
}

}  // namespace bahnwerk
