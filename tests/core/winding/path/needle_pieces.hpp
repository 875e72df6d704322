#pragma once
/// Fixed pieces of the source's stator and rotor, and how well the pieces of a path join.
#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "core/winding/laying/needle.hpp"
#include "core/winding/needle/support_points.hpp"
#include "tests/core/geometry/spline/spline_support.hpp"
#include "tests/core/winding/needle/quiet_support.hpp"

namespace bahnwerk::winding {

inline std::vector<Coil> stator_coils(const StatorPart& part, std::size_t coils, int span = 5) {
  return repeated(coil_between(part, 0, span), part.slots, 12, coils, true);
}
inline std::vector<FixedPiece> stator_pieces(const StatorPart& part, const std::vector<Coil>& coils, std::size_t turns,
                                             std::optional<NeedleShape> shape = std::nullopt) {
  constexpr double radius = 0.9895 / 2;
  const Slot slot = checked_slot(part);
  std::vector<LayingRegions> regions;
  for (const Coil& coil : coils) regions.push_back(coil_regions(part, slot, coil));
  Progress progress;
  const NeedleLayout layout = needle(regions.front(), radius, slot.tension_point, progress);
  NeedleModel model;
  model.pivot_limit = 0.2;
  model.shape = shape;
  return support_points(part, coils, turns_of(regions, layout, turns, radius), model);
}
inline std::vector<FixedPiece> stator_pieces(std::size_t turns, std::size_t coils = 1) {
  const StatorPart part;
  return stator_pieces(part, stator_coils(part, coils), turns);
}
inline std::vector<FixedPiece> rotor_pieces(std::size_t turns, std::size_t coils = 1) {
  constexpr double radius = 0.9895 / 2;
  const RotorPart part;
  const Slot slot = checked_slot(part);
  std::vector<LayingRegions> regions;
  for (const Coil& coil : repeated(coil_between(part, 0, 1), part.poles, 1, coils, true))
    regions.push_back(coil_regions(part, slot, coil));
  Progress progress;
  const NeedleLayout layout = needle(regions.front(), radius, slot.tension_point, progress);
  return support_points(part, turns_of(regions, layout, turns, radius), {});
}

/// The largest jump at any joint, of the derivative of this order, relative to the larger of its sizes there (or to
/// what a thousandth of the curve's own scale makes of it, where it vanishes).
inline double worst_jump(std::span<const BezierPiece> pieces, std::size_t order) {
  double worst = 0;
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
    const auto peak = bahnwerk::testing::peaks(pieces.subspan(i, 2));
    worst = std::max(worst, bahnwerk::testing::jump(pieces[i], pieces[i + 1], order, peak[order]));
  }
  return worst;
}

}  // namespace bahnwerk::winding
