#include "core/contour/polyline.hpp"

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"

namespace bahnwerk {

Contour polyline(std::size_t dimension, const std::vector<Vec>& points, bool closed, double feed, Progress progress) {
  std::vector<InputFault> faults;
  for (std::size_t i = 0; i < points.size() && faults.size() < 100; ++i)
    if (!std::isfinite(norm(points[i])))
      faults.push_back({{"contour", "points", std::to_string(i)}, "a coordinate is not finite"});
  if (points.size() < 2) faults.push_back({{"contour", "points"}, "at least two points are needed"});
  if (!faults.empty()) throw InvalidInput(std::move(faults));

  ContourBuilder builder(dimension, points.front());
  builder.block(Mode::cut, feed);
  constexpr std::size_t points_per_report = 4096;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (i % points_per_report == 0) progress.report("reading", 0);
    builder.line(points[i]);
  }
  if (closed) builder.line(points.front());
  return builder.finish();
}

}  // namespace bahnwerk
