#include "core/winding/path/post_passage.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/winding/needle/clearance.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double least_beside = 0.1;                      // mm, beyond the required clearance
constexpr std::array beside_more = {0.0, 0.5, 1.0, 2.0};  // further distances in needle's widths
constexpr std::array along = {0.5, 1.0, 0.0};             // places from the post's inner face to its outer one

}  // namespace

PostPassage::PostPassage(const StatorPart& part, const std::vector<Coil>& coils, const ToolPost& post,
                         const NeedleShape& needle, double clearance)
    : part_(part), coils_(coils), post_(post), needle_(needle), clearance_(clearance) {
  const Slot slot = checked_slot(part);
  for (const Coil& coil : coils) obstacles_.push_back(part_obstacles(part, slot, post, {coil}));
}

double PostPassage::from_posts(std::size_t coil, std::span<const BezierPiece> pieces, Progress progress) const {
  const auto& all = obstacles_.at(coil).list();
  const std::vector<const Obstacle*> posts(all.begin() + 1, all.end());  // the stack is first
  return clearance_up_to(pieces, needle_, posts, {enough(), tolerance}, progress);
}

double PostPassage::from_all(std::size_t coil, std::span<const BezierPiece> pieces, Progress progress) const {
  return clearance_up_to(pieces, needle_, obstacles_.at(coil).list(), {enough(), tolerance}, progress);
}

ExtraPoint PostPassage::beside(const Way& way, std::size_t place) const {
  const Coil& coil = coils_.at(way.coil);
  const double slot = (coil.first + (way.second ? coil.span : 0)) * part_.pitch();
  // The direction towards the coil's middle, counterclockwise positive.
  const double inwards = (coil.span > 0) == way.second ? -1 : 1;
  const Vec3 tip = turned(way.slot.tip, -slot);
  const double width = post_.width / 2 + needle_.width / 2 + std::max(clearance_, -needle_.width / 2) + least_beside +
                       beside_more[place / along.size()] * needle_.width;
  const double y = std::min(inwards * tip.y, part_.heads.tool_shift - width);
  const double x = part_.heads.tool_radius - (1 - along[place % along.size()]) * post_.thickness;
  return {slot + std::atan2(inwards * y, x), std::hypot(x, y)};
}

}  // namespace bahnwerk::winding
