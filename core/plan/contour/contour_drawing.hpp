#pragma once
/// Drawing of a planned contour as SVG, to scale: cuts and positioning moves.
#include <cstddef>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/contour/contour.hpp"
#include "core/geometry/curve/vec.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

struct ContourDrawingOptions {
  std::string title;
  std::size_t max_bytes = 200'000;  ///< size limit of the SVG; the frame takes up to 6 kB of it
  std::vector<Vec> way = {};        ///< path of the coarse axes, mm, drawn as a thin line; empty: none
  const TimeLaw* law = nullptr;     ///< time law along the path; cuts are coloured by its speed; null: one colour
};

/// Returns the path seen from above (x to the right, y up) and, if it is not planar, from the front (x, z) below. Axes
/// are in mm. Cuts are solid, in ten colours from rest (blue) to their largest speed (red) if the law is known;
/// positioning is dashed; the begin is marked; a legend states both lengths. The SVG is self-contained, has a white
/// background and is about 800 px wide.
///
/// Every point of the path lies within `e` of the drawing and vice versa; the legend states e in mm. e is 0.2 px and
/// grows by factors of √2 until the drawing is no larger than max_bytes: points are left out where e permits, and lines
/// within e of a line already drawn are not repeated. If the drawing does not fit even with 51 px, a sentence takes its
/// place. Cost: O(points), about 0.1 µs per segment and pass, at most 17 passes; asks `progress` every 4096 points.
std::string contour_drawing(const Contour& contour, const ContourDrawingOptions& options, Progress progress);

}  // namespace bahnwerk
