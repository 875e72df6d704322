#include "core/verify/redundant/stroke_bound.hpp"

#include <algorithm>

#include "core/base/progress_scope.hpp"

namespace bahnwerk {
namespace {

using verify::Passage;
using verify::StrokeAxis;
using verify::StrokeSections;

constexpr double closed = 1e-5;  // relative
// Units of time. Longer sections are left as they are.
constexpr double longest = 100;
constexpr int most_doublings = 20;
constexpr double first_step = 0.02;  // of a unit of time
constexpr double rounding = 1e-9;    // of a bound

/// What a section takes at least, s.
double least(const StrokeSections& sections, std::size_t section, ProgressScope& scope) {
  const double given = sections.bound(section, section + 1);
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

StrokeGain raise_by_stroke(const StrokeBoundTask& task, std::vector<SectionBound>& sections, Progress& progress) {
  ProgressScope scope(progress, "bound", task.progress_from, task.progress_to);
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
