#pragma once
/// The curve that replaces one joint: a Bézier curve of degree 7 that has position and three derivatives by arc length
/// in common with the contour at both ends.
///
/// The contour is cut back by d₁ before the joint and d₂ behind it. With h the contour by arc length and a parameter
/// interval of length L = λ(d₁ + d₂), the derivatives at both ends are f⁽ᵏ⁾ = Lᵏ h⁽ᵏ⁾. Between two lines that turn
/// by θ, both cut back by d, its control points lie at d, (1 − 2λ/7) d, (1 − 4λ/7) d, (1 − 6λ/7) d from the corner; its
/// middle is then 2 S d sin(θ/2) away from the corner, S = (64 − 44 λ)/128, which is the largest distance in either
/// direction. λ = 0.9 + 0.03 θ is what passes a corner of given deviation soonest with a limit on |h''v² + h'a| (found
/// by scanning λ and integrating the fastest motion; 0.5 to 5 % shorter than λ = 1, and its peak curvature is within 4
/// % of the circle's with the same deviation for small θ).
#include <cmath>

#include "core/contour/blend/elements.hpp"
#include "core/geometry/curve/rational.hpp"

namespace bahnwerk::blending {

/// Jumps and curvature at a joint.
struct JointShape {
  double turn = 0;            ///< θ, rad
  double curvature_jump = 0;  ///< |jump of the curvature vector|, 1/mm
  double tightest = 0;        ///< larger one of the curvatures on both sides, 1/mm
};
/// Returns the shape of the joint between two elements.
JointShape joint_shape(const Element& before, const Element& after);

/// Limits of the machine at a joint.
struct Ability {
  double speed = 0, acceleration = 0, jerk = 0;  ///< speed that feed and axes allow; limits of the weakest axis; mm, s
  double step = 0;                               ///< length covered in one cycle, mm; shorter blends are useless
  double pull = HUGE_VAL;                        ///< largest acceleration of all axes together, mm/s²
  double corner = 0;                             ///< rad; smaller tangent jumps are passed without a blend, if slowly
};

/// Lengths of a blend on one side of the joint, mm.
struct Reach {
  double allowed = 0;  ///< length that the tolerance allows
  double wanted = 0;   ///< part of `allowed` that the machine can use
  double least = 0;    ///< length below which a blend is slower than the given joint
};
/// Returns the reach of a blend. Where jerk is limited a blend has a cost: its curvature rate takes Δκ v³/d of the
/// jerk. The given joint may step the acceleration by jerk · cycle (and the velocity by acceleration · cycle). `wanted`
/// is 0 where these steps allow any speed that the curvature beside the joint allows.
Reach reach(const JointShape& joint, double tolerance, const Ability& ability);

/// Returns the blend from `d1` before the end of `before` to `d2` behind the beginning of `after`.
Rational corner_curve(const Element& before, double d1, const Element& after, double d2);

/// Deviation of a blend from the curves that it replaces.
struct CornerFit {
  double deviation = 0;  ///< mm; proven up to the tolerance, above it one distance of more than the tolerance
  double joint = 0.5;    ///< the parameter of the blend that belongs to the joint; strictly between 0 and 1
};

/// Matches the blend up to the place nearest to the joint with the replaced part of `before`, and the rest with that of
/// `after`, forwards on both. Distances are therefore in order along both, and the joint has a place on the blend
/// within the tolerance. The result is in closed form between lines cut back equally, where the deviation is at the
/// joint; otherwise it is a bound that is refined until it is within the tolerance or one distance is not
/// (core/geometry/path/matched.hpp).
CornerFit corner_fit(const Rational& curve, const Element& before, double d1, const Element& after, double d2,
                     double tolerance);

}  // namespace bahnwerk::blending
