#pragma once
/// What a cam's radius has to keep, the proof that it does, and the least radius for which the proof exists.
#include <optional>
#include <vector>

#include "core/cam_profile/follower_contact.hpp"

namespace bahnwerk::cam {

enum class CamCondition {
  pressure_angle,       ///< tan α ≤ tan α_max
  pressure_angle_back,  ///< −tan α ≤ tan α_max
  curvature,            ///< (roller radius + least profile radius) · κ < 1: no cusp and no loop
  curvature_back,       ///< the other flank of a barrel's groove
  flat_radius,          ///< radius of curvature under a flat follower above the least profile radius
};
/// Returns the conditions that the cam has; those of the pressure angle only where it is limited.
std::vector<CamCondition> cam_conditions(const CamGeometry& geometry);

/// Returns the excess of a condition, ≤ 0 where it holds: of tangents and of curvature · radius without unit, of a flat
/// follower's radius in mm.
template <class S>
LawSeries<S> condition_excess(CamCondition condition, const PitchSeat<S>& seat, const LawSeries<S>& y) {
  using T = LawSeries<S>;
  const CamGeometry& g = *seat.geometry;
  if (condition == CamCondition::flat_radius) return T(g.profile_radius) - flat_profile_radius(seat, y);
  const PitchPoint<S> p = pitch_point(seat, y);
  if (condition == CamCondition::pressure_angle || condition == CamCondition::pressure_angle_back) {
    const double sign = condition == CamCondition::pressure_angle ? 1 : -1;
    return sign * (p.along / p.across) - T(std::tan(*g.pressure_angle));
  }
  const double sign = condition == CamCondition::curvature ? 1 : -1;
  return (sign * (g.roller_radius + g.profile_radius)) * pitch_curvature(seat, p) - T(1);
}

/// Returns the radius of the pitch curve for a base radius, mm.
inline double pitch_radius(const CamGeometry& g, double base_radius) {
  return g.type == CamType::radial && g.has_roller() ? base_radius + g.roller_radius : base_radius;
}

/// Returns whether the follower reaches the pitch circle of that radius, and the whole stroke from there.
bool follower_reaches(const CamGeometry& geometry, const FollowerLaw& law, double radius);

/// Returns whether all conditions of the list hold everywhere, proven by enclosure.
bool conditions_hold(const CamGeometry& geometry, const FollowerLaw& law, const std::vector<CamCondition>& list,
                     double radius, Progress progress);

struct LeastRadius {
  double base_radius = 0;  ///< mm; all conditions hold, proven
  /// mm; every smaller base radius breaks a condition, proven; pitch radii within 1e-4 of the least one that the
  /// follower reaches are not looked at.
  double excluded = 0;
};
/// Returns the least base radius for which all conditions of the list hold, to 1e-6 of it: intervals of radii are
/// excluded by a place of the law where a condition fails for all of them. None if none up to 1e5 times the stroke, the
/// profile radius or the offset holds.
std::optional<LeastRadius> least_base_radius(const CamGeometry& geometry, const FollowerLaw& law,
                                             const std::vector<CamCondition>& list, Progress progress);

}  // namespace bahnwerk::cam
