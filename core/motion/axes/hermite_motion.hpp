#pragma once
/// Approximates any motion by polynomials in time. A motion along curves has no polynomials of its own, and the
/// verifier can enclose every peak of polynomials only.
#include <cstddef>

#include "core/motion/axes/spline_motion.hpp"

namespace bahnwerk {

/// Returns the quintic polynomial over [0, h] that has position, velocity and acceleration of axis k in common with the
/// states at its ends. For h below 0.2 ms it ignores the right position, below 1 µs also the right velocity: positions
/// along a curve are accurate to 1e-10 of its length, so differences over shorter times are mostly rounding.
Polynomial hermite_quintic(double h, const MotionState& left, const MotionState& right, std::size_t k);

/// Sets position and velocity of the axes of `state` from `first` on to those at the end of a piece of the given
/// duration. A
/// `state` that has these values but for rounding is unchanged, so axes that stand still remain still.
void join(const SplineMotion::Piece& before, double duration, std::size_t first, MotionState& state);

/// Approximates the axes [first, last) of `motion` by quintic polynomials that have position, velocity and acceleration
/// in common with it at both ends of each piece (Hermite interpolation), and position and velocity in common with the
/// piece before: a step of the motion's velocity is distributed over the piece behind it. Pieces end where those of the
/// motion do and last at most `longest` s. The error is at most max|x⁽⁶⁾| h⁶/46 080 in a piece of h seconds. Pieces
/// without duration are left out. Throws std::invalid_argument if no piece remains. O(pieces + duration/longest), two
/// evaluations each.
SplineMotion hermite_motion(const Motion& motion, std::size_t first, std::size_t last, double longest);

}  // namespace bahnwerk
