#pragma once
/// Pieces of degree 7 between points: position, velocity, acceleration and jerk at both ends.
#include <array>

#include "core/probe/bezier.hpp"
#include "core/probe/straight/motion_writer.hpp"

namespace bahnwerk::probe {

using SepticEnd = MotionWriter::State;

/// Returns the piece in Bernstein form; it lasts `duration` s.
Bezier septic(const SepticEnd& left, const SepticEnd& right, double duration);
/// Returns its coefficients of powers of the time since its begin.
std::array<Vec, 8> septic_coefficients(const SepticEnd& left, const SepticEnd& right, double duration);

}  // namespace bahnwerk::probe
