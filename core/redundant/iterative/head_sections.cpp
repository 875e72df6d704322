#include "core/redundant/iterative/head_sections.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/errors.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/grid/sections.hpp"
#include "core/motion/jerk/jerk_limited.hpp"

namespace bahnwerk {

HeadSections::HeadSections(const RedundancyTask& task, const RedundancyOptions& options, const Machine& machine,
                           const std::vector<double>& feeds, Progress& progress, double from, double to)
    : task_(task), options_(options), progress_(progress), at_(to) {
  const PathTask whole{*task.path, machine, feeds, task.rests};
  ProgressScope scope(progress, "planning", from, from);
  begin_ = find_sections(whole, options.corner_angle, scope).begin;
  const TimeLaw law = plan(whole, progress, from, to);
  laws_.resize(size());
  std::size_t section = 0;
  for (LawPiece piece : law.pieces()) {
    while (section + 1 < size() && piece.segment >= begin_[section + 1]) ++section;
    laws_[section].append(piece);
  }
}

std::size_t HeadSections::section_of(std::size_t segment) const {
  return static_cast<std::size_t>(std::upper_bound(begin_.begin(), begin_.end() - 1, segment) - begin_.begin()) - 1;
}

TimeLaw HeadSections::plan(const PathTask& task, Progress& progress, double from, double to) const {
  bool jerk = false;
  for (const AxisLimits& axis : task.machine.axes) jerk = jerk || axis.jerk < unlimited;
  if (jerk) {
    JerkLimitedOptions o;
    o.corner_angle = options_.corner_angle;
    return plan_jerk_limited(task, o, progress, from, to).law;
  }
  AccelerationLimitedOptions o;
  o.corner_angle = options_.corner_angle;
  o.keep_reserve = options_.keep_reserve;
  o.braking_reserve = options_.braking_reserve;
  return plan_acceleration_limited(task, o, progress, from, to).law;
}

void HeadSections::replan(std::size_t section, const Machine& machine, const std::vector<double>& feeds) {
  const std::size_t first = begin_[section], last = begin_[section + 1];
  Path own;
  for (std::size_t i = first; i < last; ++i)  // the curves belong to the whole path, which outlives this
    own.append(std::shared_ptr<const Curve>(task_.path, &(*task_.path)[i].curve()), i);
  if (own.size() != last - first) throw Infeasible("a section of the contour cannot be planned by itself");
  const CartesianAxisPath axes(own, task_.path->axes());
  std::vector<bool> rests(own.size() + 1, false);
  rests.front() = rests.back() = true;
  const std::vector<double> own_feeds(feeds.begin() + static_cast<std::ptrdiff_t>(first),
                                      feeds.begin() + static_cast<std::ptrdiff_t>(last));
  const TimeLaw planned = plan({axes, machine, own_feeds, rests}, progress_, at_, at_);
  TimeLaw law;
  law.reserve(planned.pieces().size());
  for (LawPiece piece : planned.pieces()) {
    const Segment &here = own[piece.segment], &there = (*task_.path)[first + piece.segment];
    const auto moved = [&](double s) {
      return s >= here.s1() ? there.s1() : std::clamp(there.s0() + (s - here.s0()), there.s0(), there.s1());
    };
    piece.s = moved(piece.s);
    piece.s_end = moved(piece.s_end);
    piece.segment += first;
    law.append(piece);
  }
  laws_[section] = std::move(law);
}

void HeadSections::append_dwells(TimeLaw& law, std::size_t segment) const {
  const auto& path = *task_.path;
  for (const Rest& rest : task_.dwells) {
    if (rest.segment != segment || !(rest.seconds > 0)) continue;
    LawPiece piece;
    piece.duration = rest.seconds;
    piece.segment = std::min(segment, path.size() - 1);
    piece.s = piece.s_end = segment < path.size() ? path[segment].s0() : path.length();
    law.append(piece);
  }
}

TimeLaw HeadSections::law(std::size_t first, std::size_t last) const {
  TimeLaw law;
  std::size_t pieces = 2;
  for (std::size_t i = first; i < last; ++i) pieces += laws_[i].pieces().size() + 1;
  law.reserve(pieces);
  for (std::size_t i = first; i < last; ++i) {
    append_dwells(law, begin_[i]);
    for (const LawPiece& piece : laws_[i].pieces()) law.append(piece);
  }
  if (last == size()) append_dwells(law, task_.path->size());
  return law;
}

double HeadSections::duration(std::size_t first, std::size_t last) const {
  double sum = 0;
  for (std::size_t i = first; i < last; ++i) sum += laws_[i].duration();
  for (const Rest& rest : task_.dwells)
    if (rest.segment >= begin_[first] && (rest.segment < begin_[last] || last == size())) sum += rest.seconds;
  return sum;
}

}  // namespace bahnwerk
