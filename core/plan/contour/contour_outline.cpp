#include "core/plan/contour/contour_outline.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/progress.hpp"
#include "core/drawing/path_lines.hpp"
#include "core/geometry/curve/chord_fan.hpp"

namespace bahnwerk {
namespace {

constexpr std::size_t units_per_report = 4096;
constexpr const char* stage = "read";

/// The points of a contour's curves.
struct Points {
  std::vector<Vec> at;
  std::vector<bool> cut;  ///< whether the edge that ends here is cut
};

Points sample(const Contour& contour, double tolerance, Progress progress) {
  Points points;
  bool cut = false;
  const std::function<void(Vec)> to = [&](Vec p) {
    points.at.push_back(p);
    points.cut.push_back(cut);
  };
  to(contour.path.at(0).value);
  drawing::Sampler sampler(tolerance, to);
  for (const Block& block : contour.blocks) {
    cut = block.mode == Mode::cut;
    for (std::size_t i = block.first; i < block.last; ++i) {
      if (i % units_per_report == 0) progress.report(stage, 0);
      sampler(contour.path[i]);
    }
  }
  return points;
}

Outline thinned(const Points& points, double tolerance, bool keep_modes, Progress progress) {
  Outline out;
  ChordFan fan(tolerance, false);
  bool cut = false;
  const auto vertex = [&](std::size_t i) {
    out.vertices.push_back(points.at[i]);
    out.cut.push_back(cut);
    fan.begin(points.at[i]);
    cut = false;
  };
  vertex(0);
  for (std::size_t i = 1; i < points.at.size(); ++i) {
    if (i % units_per_report == 0) progress.report(stage, 0);
    const bool change = keep_modes && i > 1 && points.cut[i] != points.cut[i - 1];
    if (change || !fan.take(points.at[i])) {
      vertex(i - 1);
      fan.take(points.at[i]);
    }
    cut = cut || points.cut[i];
  }
  if (points.at.size() > 1) vertex(points.at.size() - 1);
  return out;
}

double size_of(const std::vector<Vec>& points) {
  Vec low = points.front(), high = low;
  for (const Vec& p : points)
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  return norm(high - low);
}

/// Returns the largest magnitude along a direction that no axis' component exceeds.
double along(const AxisArray& direction, const Machine& machine, int order, std::size_t axes) {
  double most = unlimited;
  for (std::size_t k = 0; k < axes; ++k)
    if (direction[k] != 0) most = std::min(most, machine.axes[k].of(order) / std::abs(direction[k]));
  return most;
}

/// A segment as the estimate sees it.
struct Stretch {
  double length = 0, speed = 0, acceleration = 0;
};

/// Returns the time over a segment from speed v0 to v1, which its acceleration permits, with the peak that fits.
double time_of(const Stretch& s, double v0, double v1) {
  const double a = s.acceleration;
  const double peak = std::min(s.speed, std::sqrt(a * s.length + (v0 * v0 + v1 * v1) / 2));
  const double ramps = (2 * peak * peak - v0 * v0 - v1 * v1) / (2 * a);
  return (2 * peak - v0 - v1) / a + std::max(0.0, s.length - ramps) / peak;
}

}  // namespace

Outline outline(const Contour& contour, std::size_t most, Progress progress) {
  if (contour.path.empty()) return {};
  std::vector<Vec> ends{contour.path.at(0).value};
  for (std::size_t i = 0; i < contour.path.size(); ++i)
    ends.push_back(contour.path[i].curve().at(contour.path[i].curve().end()).value);
  double tolerance = std::max(1e-4 * size_of(ends), 1e-9);
  const Points points = sample(contour, tolerance / 2, progress);
  std::size_t changes = 0;
  for (std::size_t i = 2; i < points.cut.size(); ++i) changes += points.cut[i] != points.cut[i - 1] ? 1 : 0;
  for (;; tolerance *= 2) {
    Outline out = thinned(points, tolerance / 2, changes < most / 2, progress);
    out.tolerance = tolerance;
    if (out.vertices.size() <= most) return out;
  }
}

Outline outline(const std::vector<Vec>& points, std::size_t most, Progress progress) {
  if (points.size() <= most) return {points, std::vector<bool>(points.size(), true), 0};
  const Points all{points, std::vector<bool>(points.size(), true)};
  for (double tolerance = std::max(1e-5 * size_of(points), 1e-9);; tolerance *= 2) {
    Outline out = thinned(all, tolerance, false, progress);
    out.tolerance = tolerance;
    if (out.vertices.size() <= most) return out;
  }
}

DurationEstimate estimate_duration(const Contour& contour, const AxisPath& follows, const Machine& machine,
                                   double corner_angle, Progress progress) {
  const Path& path = contour.path;
  const std::size_t n = path.size(), axes = std::min(machine.dimension(), follows.axes());
  const std::vector<double> feeds = contour.feeds();
  const std::vector<bool> rests = contour.rest_places();
  std::vector<Stretch> stretches(n);
  std::vector<double> speed(n + 1, 0.0);  // where segments meet
  Vec before;
  for (std::size_t i = 0; i < n; ++i) {
    if (i % units_per_report == 0) progress.report(stage, 0);
    const Segment& segment = path[i];
    Stretch& s = stretches[i];
    s.length = segment.length(), s.speed = feeds[i], s.acceleration = unlimited;
    const Curve& curve = segment.curve();
    for (const double u : {curve.begin(), (curve.begin() + curve.end()) / 2, curve.end()}) {
      const AxisJet p = follows.at_parameter(i, u);
      s.speed = std::min(s.speed, along(p.d1, machine, 1, axes));
      s.acceleration = std::min(s.acceleration, along(p.d1, machine, 2, axes));
      s.speed = std::min(s.speed, std::sqrt(along(p.d2, machine, 2, axes)));
    }
    if (i > 0 && !rests[i] && angle_between(before, segment.at_parameter(curve.begin()).d1) <= corner_angle)
      speed[i] = std::min(stretches[i - 1].speed, s.speed);
    before = segment.at_parameter(curve.end()).d1;
  }
  const auto reach = [&](double v, const Stretch& s) { return std::sqrt(v * v + 2 * s.acceleration * s.length); };
  for (std::size_t i = 0; i < n; ++i) speed[i + 1] = std::min(speed[i + 1], reach(speed[i], stretches[i]));
  for (std::size_t i = n; i-- > 0;) speed[i] = std::min(speed[i], reach(speed[i + 1], stretches[i]));
  DurationEstimate estimate;
  for (const Block& block : contour.blocks) {
    double& time = block.mode == Mode::cut ? estimate.cut_time : estimate.position_time;
    for (std::size_t i = block.first; i < block.last; ++i) time += time_of(stretches[i], speed[i], speed[i + 1]);
  }
  for (const Rest& rest : contour.rests)
    (contour.blocks[rest.block].mode == Mode::cut ? estimate.cut_time : estimate.position_time) += rest.seconds;
  return estimate;
}

}  // namespace bahnwerk
