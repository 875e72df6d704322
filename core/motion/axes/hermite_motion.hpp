#pragma once
/// Any motion as polynomials in time: what moves along curves has none of its own, and only of polynomials the verifier
/// can enclose every peak.
#include <cstddef>

#include "core/motion/axes/spline_motion.hpp"

namespace bahnwerk {

/// The quintic polynomial over [0, h] that shares position, velocity and acceleration of axis k with these states at
/// its ends; below 0.2 ms without the right one's position, below 1 µs without its velocity, too: along a curve
/// positions are known to 1e-10 of its length, and differences over so short a time would be little else.
Polynomial hermite_quintic(double h, const MotionState& left, const MotionState& right, std::size_t k);

/// Lets `state` begin where a piece of that duration ends: position and velocity of its axes, which are those from
/// `first` on. Where `state` is that but
/// for rounding it is left alone, so that what stands goes on standing.
void join(const SplineMotion::Piece& before, double duration, std::size_t first, MotionState& state);

/// Axes [first, last) of `motion` by quintic polynomials that share position, velocity and acceleration with it at both
/// ends of each piece (Hermite), and position and velocity with the piece before: a step of
/// the motion's velocity is evened out in the piece behind it. Pieces end where those of the motion do and last at most
/// `longest` s; the error is at most max|x⁽⁶⁾| h⁶/46 080 in a piece of h seconds. Pieces of no duration are left out.
/// Throws std::invalid_argument where nothing is left. O(pieces + duration/longest), two evaluations each.
SplineMotion hermite_motion(const Motion& motion, std::size_t first, std::size_t last, double longest);

}  // namespace bahnwerk
