#include "core/contour/blend/note.hpp"

#include <cstdio>
#include <string>

namespace bahnwerk::blending {

namespace {

constexpr double small_jump = 1e-6;  // rad, worth a note

}  // namespace

void note(Contour& blended, const BlendCount& count, const BlendOptions& options) {
  char text[200];
  std::snprintf(text, sizeof text, "blended within %.6g mm: %zu joints, %zu runs of %zu short segments",
                options.tolerance, count.corners, count.runs, count.run_segments);
  blended.notes.emplace_back(text);
  std::size_t stops = 0;
  double where = 0;
  std::size_t small = 0;
  for (const Joint& j : joints(blended.path)) {
    if (j.angle > options.corner_angle && stops++ == 0) where = j.s;
    if (j.angle > small_jump && j.angle <= options.corner_angle) ++small;
  }
  if (small > 0) {
    std::snprintf(text, sizeof text, "%zu tangent jumps below the corner angle left", small);
    blended.notes.emplace_back(text);
  }
  if (stops > 0) {
    std::snprintf(text, sizeof text, "%zu corners not blended (reversals, borders of cutting), the first at %.6g mm",
                  stops, where);
    blended.notes.emplace_back(text);
  }
  if (count.unsmoothed + count.failed > 0) {
    std::snprintf(text, sizeof text, "%zu runs could not be smoothed and %zu joints not blended within the tolerance",
                  count.unsmoothed, count.failed);
    blended.notes.emplace_back(text);
  }
}

}  // namespace bahnwerk::blending
