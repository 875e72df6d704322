#include "core/motion/feed/curvature_feed.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/curve/vec.hpp"
#include "core/numeric/golden_section.hpp"

namespace bahnwerk {
namespace {

constexpr std::size_t per_panel = 16;
constexpr double resolved = 1e-5;  // part of the interval in which the largest curvature is searched

}  // namespace

double chord_feed(double curvature, const CurvatureFeedLimits& limits) {
  if (!(limits.chord_tolerance < unlimited) || !(curvature > 0)) return unlimited;
  const double e = std::min(limits.chord_tolerance, 1 / curvature);
  return 2 / limits.cycle_time * std::sqrt(e * (2 / curvature - e));
}

double half_speed_feed(double curvature, const CurvatureFeedLimits& limits) {
  if (!(limits.half_speed_curvature < unlimited)) return unlimited;
  return limits.velocity / (1 + curvature / limits.half_speed_curvature);
}

double largest_curvature(const Segment& segment) {
  if (segment.straight()) return 0;
  if (segment.cusp_begin() || segment.cusp_end()) return unlimited;
  const auto curvature = [&](double u) { return norm(segment.at_parameter(u).d2); };
  const std::vector<double> panels = segment.panel_parameters();
  std::vector<double> places;
  for (std::size_t p = 0; p + 1 < panels.size(); ++p)
    for (std::size_t k = 0; k < per_panel; ++k)
      places.push_back(panels[p] +
                       (panels[p + 1] - panels[p]) * static_cast<double>(k) / static_cast<double>(per_panel));
  places.push_back(panels.back());
  std::size_t highest = 0;
  double most = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (const double here = curvature(places[i]); here > most) most = here, highest = i;
  const double low = places[highest > 0 ? highest - 1 : 0], high = places[std::min(highest + 1, places.size() - 1)];
  return std::max(most, golden_section(curvature, low, high, resolved * (high - low)).value);
}

std::vector<double> curvature_feeds(const Path& path, const CurvatureFeedLimits& limits) {
  std::vector<double> feeds(path.size(), unlimited);
  if (!(limits.chord_tolerance < unlimited) && !(limits.half_speed_curvature < unlimited)) return feeds;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double curvature = largest_curvature(path[i]);
    feeds[i] = std::min(chord_feed(curvature, limits), half_speed_feed(curvature, limits));
  }
  return feeds;
}

}  // namespace bahnwerk
