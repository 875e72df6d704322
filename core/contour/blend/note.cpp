#include "core/contour/blend/note.hpp"

#include <cstdio>
#include <string>

namespace bahnwerk::blending {

namespace {

constexpr double small_jump = 1e-6;  // rad, worth a note

}  // namespace

void note(Contour& blended, const BlendCount& count, const BlendOptions& options, ProgressScope& progress) {
  char text[200];
  std::snprintf(text, sizeof text, "blended within %.6g mm: %zu joints, %zu runs of %zu short segments",
                options.tolerance, count.corners, count.runs, count.run_segments);
  blended.notes.emplace_back(text);
  std::size_t stops = 0;
  double where = 0;
  std::size_t small = 0;
  for (std::size_t i = 1; i < blended.path.size(); ++i) {
    progress.work();
    const Segment &before = blended.path[i - 1], &after = blended.path[i];
    const double angle =
        angle_between(before.at_parameter(before.curve().end()).d1, after.at_parameter(after.curve().begin()).d1);
    if (angle > options.corner_angle && stops++ == 0) where = after.s0();
    if (angle > small_jump && angle <= options.corner_angle) ++small;
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
  const auto left = [&](const char* what, std::size_t number, Vec first) {
    if (number == 0) return;
    const int end = std::snprintf(text, sizeof text, "%zu %s within the tolerance, the first at %.6g, %.6g", number,
                                  what, first.x, first.y);
    if (blended.dimension == 3)
      std::snprintf(text + end, sizeof text - static_cast<std::size_t>(end), ", %.6g", first.z);
    blended.notes.emplace_back(text);
  };
  left("runs could not be smoothed", count.unsmoothed, count.first_unsmoothed);
  left("joints could not be blended", count.failed, count.first_failed);
}

}  // namespace bahnwerk::blending
