#pragma once
/// Rounding of a contour within a tolerance: a path whose curvature and curvature rate are continuous wherever
/// possible.
///
/// Two mechanisms. A *corner blend* replaces the ends of two curves that meet with a jump of tangent or curvature by
/// one Bézier curve of degree 7 with three common derivatives by arc length at both ends
/// (core/contour/blend/corner.hpp). Where joints are so close together that the tolerance would allow longer blends
/// than the segments have room for, one quintic spline (four continuous derivatives) runs through the tube around the
/// whole *run* of segments (core/contour/blend/smooth_run.hpp). What is left of lines, arcs, polynomials and NURBS
/// keeps its shape exactly.
///
/// How long a blend is: as long as the tolerance allows, but no longer than the machine can use (a joint of 1e-5 rad
/// needs no metre). Where jerk is limited, joints that can be passed as they are stay so: a blend's curvature has a
/// rate, and that costs jerk. Not blended: rests of the contour, and each with a note turns of more than 170° and cusps
/// (the motion rests there), and borders between cutting and positioning, where the path stays as it was.
///
/// A border between two blocks of one mode keeps its place: every block with a length owns a piece of the rounded path,
/// however short it is, in order, and begins within the tolerance of where it began. A corner blend is cut at the place
/// that belongs to the joint, a run at every border inside it. So the feed of a block holds there and nowhere else.
///
/// A change is made only if its deviation is proven to fit, from bounds of what curves bulge between places where they
/// have been compared. A corner that does not fit is rounded less; a run is cut at its sharpest joints; what still does
/// not fit stays as it is, with a note of how many there are and where the first one is.
#include <cstddef>
#include <vector>

#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"

namespace bahnwerk {

class Progress;

struct BlendOptions {
  double tolerance = 0.01;                                   ///< mm, both from and to the given contour
  double corner_angle = 0.1 * 3.14159265358979323846 / 180;  ///< rad; larger jumps that stay are noted as stops
};

/// Between two places at which the motion rests both on the given contour and on the blended one, which are the same
/// point: segments from here to the next one's.
struct BlendSection {
  std::size_t given = 0, blended = 0;  ///< first segments
  bool changed = false;                ///< false: all segments are as they were given
};

/// The blended contour: same dimension, same blocks, notes extended. Every point of a block has a point of the same
/// block of `given` within the tolerance and vice versa, in order along both (core/verify/geometry/tube.hpp checks
/// that). Throws InvalidInput at {"planning","corner","tolerance"} for a tolerance that is not in 1e-5 … 1e3 mm,
/// ToleranceUnreachable for a block of less than some 1e-11 mm that got lost, Stopped when progress says so. Progress
/// runs from `from` to `to`. Cost: O(segments): 10 µs per chord of a long run, 25 µs per corner, 65 µs per segment
/// where many short runs alternate with corners (tests/bench/bench_blend.cpp, one core of 2.3 GHz). `sections`, if
/// given, is filled with those of the path, in order.
Contour blend(const Contour& given, const BlendOptions& options, const Machine& machine, Progress& progress,
              double from = 0, double to = 1, std::vector<BlendSection>* sections = nullptr);

}  // namespace bahnwerk
