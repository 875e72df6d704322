#include "core/verify/redundant/stroke_sections.hpp"

#include <algorithm>
#include <cmath>

#include "core/verify/redundant/least_stroke.hpp"

namespace bahnwerk::verify {
namespace {

constexpr double piece = 0.05;  // size of the path's boxes, relative to the least stroke

}  // namespace

StrokeSections::StrokeSections(const StrokeBoundTask& task, const std::vector<SectionBound>& sections)
    : task_(task), sections_(sections), step_(unlimited) {
  for (std::size_t k = 0; k < axes(); ++k) {
    if (!split(k)) continue;
    step_ = std::min(step_, piece * task.fine[k].highest);
    horizon_ = std::max(horizon_, StrokeAxis(task.coarse[k], task.fine[k], k, 0).horizon());
  }
}

bool StrokeSections::split(std::size_t k) const { return task_.fine[k].highest > least_stroke; }

double StrokeSections::end_distance(std::size_t k, std::size_t section) const {
  return std::abs(rest(section + 1).value[k] - rest(section).value[k]);
}

double StrokeSections::bound(std::size_t first, std::size_t last) const {
  double sum = 0;
  for (std::size_t i = first; i < last; ++i) sum += sections_[i].duration;
  return sum;
}

bool StrokeSections::far(std::size_t section) const {
  const SectionBound& s = sections_[section];
  double length = 0, stroke = unlimited;
  bool fast = false;
  for (std::size_t k = 0; k < axes(); ++k)
    if (split(k)) stroke = std::min(stroke, task_.fine[k].highest);
  for (std::size_t i = s.first; i < s.last; ++i) {
    length += task_.head.path[i].s1() - task_.head.path[i].s0();
    for (std::size_t k = 0; k < axes(); ++k) {
      if (!split(k)) continue;
      const double feed = task_.head.feeds[i];
      fast = fast || feed * feed > task_.coarse[k].acceleration * task_.fine[k].highest ||
             feed > task_.coarse[k].velocity || feed > task_.fine[k].velocity;
    }
  }
  return fast && length > stroke;
}

bool StrokeSections::waits(std::size_t before) const {
  return dwell_before(task_.head, before < count() ? sections_[before].first : sections_.back().last) > 0;
}

AxisJet StrokeSections::rest(std::size_t before) const {
  const AxisPath& path = task_.head.path;
  if (before == count()) return path.at(sections_.back().last - 1, path[sections_.back().last - 1].s1());
  return path.at(sections_[before].first, path[sections_[before].first].s0());
}

StrokeAxis StrokeSections::axis(std::size_t k, std::size_t origin) const {
  return {task_.coarse[k], task_.fine[k], k, rest(origin).value[k]};
}

StrokeSections::Surroundings StrokeSections::around(std::size_t first, std::size_t last) const {
  return {reached(task_.head, sections_, first, 0, {horizon_, step_}),
          reached(task_.head, sections_, last, count(), {horizon_, step_}), first == 0 && !waits(first),
          last == count() && !waits(last)};
}

Passage StrokeSections::passage(std::size_t first, std::size_t last) const {
  const HeadReachOptions at_once{.step = step_, .dwells = false};
  return {rest(first), rest(last), reached(task_.head, sections_, first, last, at_once),
          reached(task_.head, sections_, last, first, at_once)};
}

}  // namespace bahnwerk::verify
