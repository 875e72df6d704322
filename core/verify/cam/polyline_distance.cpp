#include "core/verify/cam/polyline_distance.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/progress.hpp"

namespace bahnwerk::verify {
namespace {

double point_to_chord(Point p, Point a, Point b) {
  const Point d = b - a;
  const double square = dot(d, d), t = square > 0 ? std::clamp(dot(p - a, d) / square, 0.0, 1.0) : 0;
  return distance(p, a + t * d);
}

double chord_to_chord(Point a, Point b, Point c, Point d) {
  const double one = cross(b - a, c - a), two = cross(b - a, d - a), three = cross(d - c, a - c),
               four = cross(d - c, b - c);
  if (one * two < 0 && three * four < 0) return 0;
  return std::min({point_to_chord(a, c, d), point_to_chord(b, c, d), point_to_chord(c, a, b), point_to_chord(d, a, b)});
}

}  // namespace

NearestApproach nearest_approach(const std::vector<Point>& path, const std::vector<Point>& line, double near,
                                 Progress progress) {
  NearestApproach best{HUGE_VAL, 0};
  double longest = 0;
  for (std::size_t j = 0; j + 1 < line.size(); ++j) longest = std::max(longest, distance(line[j], line[j + 1]));
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (i % 64 == 0) progress.report("verification", 0.97);
    const double length = distance(path[i], path[i + 1]);
    for (std::size_t j = 0; j + 1 < line.size();) {
      // No chord up to the next j is nearer than this, which begins at a place that far away.
      const double room = distance(path[i], line[j]) - length - near;
      if (room > 2 * longest) {
        best.distance = std::min(best.distance, near + longest);
        j += static_cast<std::size_t>(room / longest) - 1;
        continue;
      }
      const double now = chord_to_chord(path[i], path[i + 1], line[j], line[j + 1]);
      if (now < best.distance) best = {now, i};
      ++j;
    }
  }
  return best;
}

}  // namespace bahnwerk::verify
