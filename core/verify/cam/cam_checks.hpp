#pragma once
/// Verifies a mechanical cam: its published curves against the law and the geometry that the user gave.
///
/// Places of the follower are computed by explicit formulas for each type of follower. Between places at which they are
/// compared, curve and follower differ from their chords by at most M h²/8, M a bound of the second derivative from
/// coefficients: so every check holds at every angle.
#include <optional>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/verification.hpp"
#include "core/cam_profile/cam_geometry.hpp"
#include "core/geometry/region/point.hpp"

namespace bahnwerk {

struct LawToVerify;

/// A published curve: polynomials of degree 5 over the cam's angle, deg; each begins where the one before ends.
struct CamCurveToVerify {
  std::vector<double> angles;  ///< ends of the spans, one more than spans
  std::vector<Point> points;   ///< 5 · spans + 1 control points, mm
};
struct CamToVerify {
  cam::CamGeometry geometry;
  double base_radius = 0;
  CamCurveToVerify profile;
  std::optional<CamCurveToVerify> other_flank;  ///< second flank of a barrel's groove
  double pressure_angle = 0;                    ///< largest |α| as reported, rad
  std::optional<double> profile_radius;         ///< least convex radius of curvature as reported, mm
  std::optional<double> stress;                 ///< largest Hertz pressure as reported, N/mm²
  std::optional<double> least_force;            ///< as reported, N
};

/// Appends checks, `at` s:
///   cam curve            the curve covers one turn without gaps, and closes (a barrel: ends at its begin's height)
///   cam contact          how far the follower stays away from the profile at the angle where they meet
///   cam penetration      how far any part of the profile reaches into the roller, or beyond the flat face
///   cam undercut         the profile goes forward where the follower does: −(least advance), mm/rad
///   cam pressure angle   enclosed |α| beyond the given limit, or the reported value where none is given
///   cam profile radius   reported least radius beyond the one by differences of the follower's places
///   cam stress           Hertz pressure by these differences beyond the reported one or the limit
///   cam force            the follower stays on the cam
/// Tolerances: the geometry's, 1e-5 deg, 1e-4 of a radius or a stress. O(places) for places some 1000 times the root
/// of 1e-3 mm/tolerance.
void verify_cam(const LawToVerify& law, const CamToVerify& cam, Progress progress, Verification& out);

}  // namespace bahnwerk
