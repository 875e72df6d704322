#pragma once
/// Rounding of a contour within a tolerance: a path whose curvature and curvature rate are continuous wherever
/// possible.
///
/// There are two mechanisms. A *corner blend* replaces the ends of two curves that meet with a jump of tangent or
/// curvature by one Bézier curve of degree 7 with three common derivatives by arc length at both ends
/// (core/contour/blend/corner.hpp). Where joints are so close together that the tolerance allows longer blends than the
/// segments have room for, one quintic spline (four continuous derivatives) replaces the whole *run* of segments within
/// a tube around it (core/contour/blend/smooth_run.hpp). The rest of lines, arcs, polynomials and NURBS is exact.
///
/// A blend is as long as the tolerance allows, but no longer than the machine can use. Where jerk is limited, joints
/// that can be passed as given are not changed: the curvature rate of a blend costs jerk. Not blended are rests of the
/// contour and, each with a note, turns of more than 170° and cusps (the motion rests there), and borders between
/// cutting and positioning, where the path stays as given.
///
/// A border between two blocks of one mode stays in its place: every block with a length has a piece of the rounded
/// path, in order, that begins within the tolerance of the block's beginning. A corner blend is cut at the place that
/// belongs to the joint, a run at every border inside it. The feed of a block therefore holds exactly there.
///
/// A change is made only if its deviation is proven to fit, from bounds of the bulge of curves between places where
/// they have been compared. A corner that does not fit is rounded less; a run is cut at its sharpest joints; the
/// remaining ones stay as given, with a note of their number and the place of the first one.
#include <cstddef>
#include <vector>

#include "core/base/progress.hpp"
#include "core/contour/contour.hpp"
#include "core/machine/tool_limits.hpp"

namespace bahnwerk {

/// The options of rounding.
struct BlendOptions {
  double tolerance = 0.01;                                   ///< mm, from the given contour to the path and back
  double corner_angle = 0.1 * 3.14159265358979323846 / 180;  ///< rad; larger tangent jumps that remain are stops
};

/// The segments between two places at which the motion rests both on the given contour and on the blended one, which
/// are one point; the section ends where the next one begins.
struct BlendSection {
  std::size_t given = 0, blended = 0;  ///< first segments
  bool changed = false;                ///< false: all segments are as given
};

/// Returns the blended contour with the dimension and blocks of `given` and more notes. `limits` are those of the tool
/// on the machine: an element is rounded by those at its beginning. Every point of a block has a
/// point of its counterpart within the tolerance and vice versa, in order along both (core/verify/geometry/tube.hpp
/// checks this). `sections`, if given, is filled with those of the path, in order.
/// Throws InvalidInput at {"planning","corner","tolerance"} for a tolerance outside 1e-5 … 1e3 mm, ToleranceUnreachable
/// for a block of less than some 1e-11 mm that was lost, Stopped. Cost: O(segments): 10 µs per chord of a long run, 25
/// µs per corner, 65 µs per segment where many short runs alternate with corners (tests/bench/bench_blend.cpp, one core
/// of 2.3 GHz).
Contour blend(const Contour& given, const BlendOptions& options, const ToolLimitsMap& limits, Progress progress,
              std::vector<BlendSection>* sections = nullptr);

}  // namespace bahnwerk
