#include "core/verify/redundant/stroke_bound.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/progress_scope.hpp"

namespace bahnwerk {
namespace {

using verify::Passage;
using verify::StrokeAxis;
using verify::StrokeSections;

constexpr double closed = 1e-5;  // relative
// Units of time. The bounds of longer sections are not raised.
constexpr double longest = 100;
constexpr int most_doublings = 20;
constexpr double first_step = 0.02;  // first step, in units of time
constexpr double rounding = 1e-9;    // relative rounding of a bound

/// Returns the time from one speed to rest, or back, within limits of acceleration and jerk.
double change(double speed, const AxisLimits& axis) {
  if (!(axis.jerk < unlimited)) return speed / axis.acceleration;
  return speed * axis.jerk >= axis.acceleration * axis.acceleration
             ? speed / axis.acceleration + axis.acceleration / axis.jerk
             : 2 * std::sqrt(speed / axis.jerk);
}

/// Returns the least time over a distance from rest to rest: trapezoid or double-S.
double rest_to_rest(double way, const AxisLimits& axis) {
  if (axis.velocity < unlimited && way >= axis.velocity * change(axis.velocity, axis))
    return way / axis.velocity + change(axis.velocity, axis);
  if (!(axis.jerk < unlimited)) return 2 * std::sqrt(way / axis.acceleration);
  const double a = axis.acceleration, turning = a * a / axis.jerk;  // speed from which on the acceleration is reached
  if (way < 2 * turning * std::sqrt(turning / axis.jerk)) return 4 * std::cbrt(way / (2 * axis.jerk));
  return 2 * change(0.5 * (std::sqrt(turning * turning + 4 * a * way) - turning), axis);
}

/// Returns the closed-form bound of the coarse axes of a section: its distance less two strokes at their largest speed,
/// or from rest to rest if there is nothing before and behind.
double least_way(const StrokeSections& sections, std::size_t section) {
  const bool lone = sections.count() == 1 && !sections.waits(0) && !sections.waits(1);
  double time = 0;
  for (std::size_t k = 0; k < sections.axes(); ++k) {
    const double way = sections.end_distance(k, section) - 2 * sections.stroke(k);
    if (!(way > 0)) continue;
    time = std::max(time, lone ? rest_to_rest(way, sections.coarse(k)) : way / sections.coarse(k).velocity);
  }
  return time * (1 - rounding);
}

/// Returns the lower bound of a section's time, s.
double least(const StrokeSections& sections, std::size_t section, ProgressScope& scope) {
  const double given = std::max(sections.bound(section, section + 1), least_way(sections, section));
  double bound = given;
  if (!sections.far(section)) return bound;
  const StrokeSections::Surroundings around = sections.around(section, section + 1);
  if (!around.known()) return bound;
  const Passage passage = sections.passage(section, section + 1);
  for (std::size_t k = 0; k < sections.axes(); ++k) {
    if (!sections.split(k)) continue;
    const StrokeAxis axis = sections.axis(k, section);
    if (given > longest * axis.unit()) continue;
    const ReachableStates begin = around.begin(axis), end = around.end(axis).reversed();
    const auto possible = [&](double duration) {
      scope.work(2000);
      ReachableStates states = axis.pass(begin, passage, duration);
      states.limit(end);
      return !states.empty();
    };
    if (possible(bound)) continue;
    double step = first_step * axis.unit(), high = bound + step;
    for (int i = 0; i < most_doublings && high < 2 * longest * axis.unit() && !possible(high); ++i) {
      bound = high;
      high += step *= 2;
    }
    while (high - bound > closed * bound) {
      const double middle = 0.5 * (bound + high);
      (possible(middle) ? high : bound) = middle;
    }
  }
  return bound > given ? std::max(given, bound * (1 - rounding)) : given;
}

}  // namespace

StrokeGain raise_by_stroke(const StrokeBoundTask& task, std::vector<SectionBound>& sections, Progress progress) {
  ProgressScope scope(progress, "bound");
  const StrokeSections looked(task, sections);
  std::vector<double> raised(sections.size());
  StrokeGain gain;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    scope.done(static_cast<double>(i) / static_cast<double>(sections.size()));
    raised[i] = least(looked, i, scope);
    const double by = raised[i] - sections[i].duration;
    gain.sections += by > 0;
    gain.duration += by * (1 - rounding);
  }
  for (std::size_t i = 0; i < sections.size(); ++i) sections[i].duration = raised[i];
  return gain;
}

}  // namespace bahnwerk
