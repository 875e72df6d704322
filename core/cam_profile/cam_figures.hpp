#pragma once
/// Figures of a cam, each a proven extreme with its place: pressure angles, radii of curvature, Hertz pressure.
#include <optional>

#include "core/cam_profile/cam_conditions.hpp"

namespace bahnwerk::cam {

/// An extreme and its place.
struct CamExtreme {
  double value = 0;
  double at = 0;  ///< rad, angle of the cam
};

struct CamContactFigures {
  CamExtreme stress;       ///< largest Hertz pressure, N/mm²
  CamExtreme least_force;  ///< along the follower's motion, N; the follower leaves the cam where it is not positive
  CamExtreme most_force;   ///< N
};

struct CamFigures {
  double base_radius = 0;
  CamExtreme pressure_angle, pressure_angle_back;  ///< largest and smallest signed α, rad
  CamExtreme pitch_curvature;       ///< largest one, 1/mm, where the pitch curve is convex; none of a flat follower
  CamExtreme pitch_curvature_back;  ///< smallest one, 1/mm: negative where the pitch curve is concave
  /// Least radius of curvature where the profile is convex, mm: ≤ 0 at cusps and loops. None: convex nowhere.
  std::optional<CamExtreme> profile_radius;
  /// Least radius of curvature where the profile is concave, mm; none: concave nowhere.
  std::optional<CamExtreme> concave_radius;
  double undercut_bound = 0;  ///< < 0: proven that there is neither cusp nor loop
  double face_width = 0;      ///< width that the contact takes on a flat face, mm: max y′ − min y′
  std::optional<CamContactFigures> contact;
};

/// State of the contact at one angle.
struct CamPlace {
  double at = 0;              ///< rad, angle of the cam
  double pressure_angle = 0;  ///< signed, rad
  double curvature = 0;       ///< curvature of the profile (convex: positive) or of the groove's centre line, 1/mm
};
CamPlace cam_place(const CamGeometry& geometry, const FollowerLaw& law, double base_radius, std::size_t piece,
                   double x);

/// O(pieces) searches of core/cam_profile/follower_law.hpp, some ms each. The follower reaches the base circle.
CamFigures cam_figures(const CamGeometry& geometry, const FollowerLaw& law, double base_radius, Progress progress);

}  // namespace bahnwerk::cam
