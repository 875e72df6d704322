#pragma once
/// The profile of a cam as a curve over the cam's angle, and as a NURBS of degree 5.
#include <vector>

#include "core/cam_profile/cam_conditions.hpp"
#include "core/geometry/region/point.hpp"
#include "core/geometry/spline/nurbs_path.hpp"

namespace bahnwerk::cam {

/// Which curve: the pitch curve, the profile (the flank towards −y of a barrel's groove), the other flank.
enum class CamCurve { pitch, profile, other_flank };

/// Point and first two derivatives by φ.
struct CamCurvePoint {
  Point value, first, second;
};
/// Returns the curve in the cam's frame, mm: a barrel's lies in the unrolled plane (r φ, y).
CamCurvePoint cam_curve_point(const CamGeometry& geometry, const FollowerLaw& law, double base_radius, CamCurve curve,
                              std::size_t piece, double x);

/// Returns the curve as polynomials of degree 5 over the cam's angle in deg, knots of multiplicity 5: value and two
/// derivatives are exact at the knots (Hermite), and spans of at most 5 deg are halved until the curve is within a
/// quarter of the geometry's tolerance. Throws ToleranceUnreachable beyond 20 000 spans.
NurbsPath cam_curve(const CamGeometry& geometry, const FollowerLaw& law, double base_radius, CamCurve curve,
                    Progress progress);

}  // namespace bahnwerk::cam
