#pragma once
/// Drawing of a planned contour as SVG: what is cut, what is positioned, to scale.
#include <cstddef>
#include <string>
#include <vector>

#include "core/contour/contour.hpp"
#include "core/geometry/curve/vec.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

class Progress;

struct ContourDrawingOptions {
  std::string title;
  std::size_t max_bytes = 200'000;  ///< of the drawing; its frame takes up to 6 kB of them
  std::vector<Vec> way = {};        ///< drawn thin over the path, "coarse axes" in the legend; empty: none
  const TimeLaw* law = nullptr;     ///< along the path: cuts are coloured by its speed; none: in one colour
};

/// The path from above (x to the right, y up), and below it from the front (x, z) if it is in space; axes in mm, cuts
/// solid, in ten colours from rest (blue) to their largest speed (red) where the law is known, positioning dashed, the
/// begin marked, a legend with the lengths of both. A self-contained file on a white
/// background, about 800 px wide.
///
/// Every point of the path lies within `e` of what is drawn and the reverse; the legend states e in mm. It is 0.2 px,
/// and grows by √2 until the drawing is no larger than max_bytes: points are left out where e permits, lines that lie
/// within e of one already drawn are not drawn again. What does not even fit with 51 px is said in place of the path.
/// Cost: O(points), about 0.1 µs per segment and pass, at most 17 passes; calls progress every 4096 points.
std::string contour_drawing(const Contour& contour, const ContourDrawingOptions& options, Progress& progress);

}  // namespace bahnwerk
