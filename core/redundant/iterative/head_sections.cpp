#include "core/redundant/iterative/head_sections.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/motion/grid/sections.hpp"
#include "core/motion/jerk/jerk_limited.hpp"
#include "core/redundant/head/section_law.hpp"

namespace bahnwerk {
namespace {

constexpr double pieces_per_cycle = 4, widest = 8;

bool limits_jerk(const Machine& machine) {
  return std::any_of(machine.axes.begin(), machine.axes.end(), [](const AxisLimits& a) { return a.jerk < unlimited; });
}

}  // namespace

HeadSections::HeadSections(const RedundancyTask& task, const RedundancyOptions& options, const Machine& machine,
                           const std::vector<double>& feeds, Progress progress, double width)
    : task_(task), options_(options), progress_(progress), width_(width > 0 ? width : 1) {
  const PathTask whole{*task.path, machine, feeds, task.rests};
  ProgressScope scope(progress.part(0, 0), "planning");
  begin_ = find_sections(whole, options.corner_angle, scope).begin;
  TimeLaw law = plan(whole, progress.part(0, 0.5));
  if (!(width > 0) && !limits_jerk(machine)) {
    const double cycles = law.duration() / task.machine.cycle_time;
    width_ = std::clamp(static_cast<double>(law.pieces().size()) / (pieces_per_cycle * cycles), 1.0, widest);
    if (width_ > 1) {
      law = {};  // gives its memory to the next one
      law = plan(whole, progress.part(0.5, 1));
    }
  }
  laws_.resize(size());
  const auto& pieces = law.pieces();
  for (std::size_t section = 0, first = 0; section < size(); ++section) {
    std::size_t last = first;
    while (last < pieces.size() && (section + 1 == size() || pieces[last].segment < begin_[section + 1])) ++last;
    laws_[section].reserve(last - first);
    for (; first < last; ++first) laws_[section].append(pieces[first]);
  }
}

std::size_t HeadSections::section_of(std::size_t segment) const {
  return static_cast<std::size_t>(std::upper_bound(begin_.begin(), begin_.end() - 1, segment) - begin_.begin()) - 1;
}

TimeLaw HeadSections::plan(const PathTask& task, Progress progress) const {
  if (limits_jerk(task.machine)) {
    JerkLimitedOptions o;
    o.corner_angle = options_.corner_angle;
    return plan_jerk_limited(task, o, progress).law;
  }
  AccelerationLimitedOptions o;
  o.corner_angle = options_.corner_angle;
  o.keep_reserve = options_.keep_reserve;
  o.braking_reserve = options_.braking_reserve;
  o.width = width_;
  return plan_acceleration_limited(task, o, progress).law;
}

void HeadSections::replan(std::size_t section, const Machine& machine, const std::vector<double>& feeds) {
  laws_[section] = section_law(*task_.path, begin_[section], begin_[section + 1], machine, feeds,
                               [&](const PathTask& task) { return plan(task, progress_.part(1, 1)); });
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
