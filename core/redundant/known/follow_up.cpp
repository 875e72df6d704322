#include "core/redundant/known/follow_up.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/progress_scope.hpp"
#include "core/redundant/known/split_plan.hpp"

namespace bahnwerk {
namespace {

constexpr double used_stroke = 1 - 1e-9;
constexpr double looks_per_stroke = 200;
constexpr double smallest_step = 1e-8;  // rad, tangent jumps up to this are rounding

struct Box {
  AxisArray lowest, highest;
  Box() {
    lowest.fill(std::numeric_limits<double>::infinity()), highest.fill(-std::numeric_limits<double>::infinity());
  }
  void add(const AxisArray& x, std::size_t axes, double around = 0) {
    for (std::size_t k = 0; k < axes; ++k)
      lowest[k] = std::fmin(lowest[k], x[k] - around), highest[k] = std::fmax(highest[k], x[k] + around);
  }
};

/// Encloses the tool's positions on a segment: between two samples the tool leaves both by at most half of the path
/// length between them.
void add_segment(Box& box, const AxisPath& path, std::size_t i, double stroke, ProgressScope& scope) {
  const Segment& segment = path[i];
  box.add(path.at(i, segment.s0()).value, path.axes());
  box.add(path.at(i, segment.s1()).value, path.axes());
  if (path.linear(i)) return;
  const auto looks =
      static_cast<std::size_t>(std::clamp(looks_per_stroke * segment.length() / stroke, 4.0, 20 * looks_per_stroke));
  const double step = segment.length() / static_cast<double>(looks);
  for (std::size_t j = 0; j < looks; ++j) {
    box.add(path.at(i, segment.s0() + step * (static_cast<double>(j) + 0.5)).value, path.axes(), 0.5 * step);
    scope.work();
  }
}

}  // namespace

FollowUp::FollowUp(const AxisPath& path, const Contour& contour, const CoarseFineMachine& machine, Progress progress)
    : axes_(path.axes()), run_(path.size()) {
  ProgressScope scope(progress.part(0, 0), "planning");
  for (const Block& block : contour.blocks) {
    if (block.first == block.last) continue;
    const bool cuts = block.mode == Mode::cut;
    if (runs_.empty() || runs_.back().cuts != cuts) runs_.push_back({block.first, block.last, cuts});
    runs_.back().last = block.last;
  }
  double stroke = machine.axes.front().stroke;
  for (const CoarseFineAxis& axis : machine.axes) stroke = std::fmin(stroke, axis.stroke);
  const bool centred =
      std::any_of(machine.axes.begin(), machine.axes.end(), [](const CoarseFineAxis& a) { return a.centred; });
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    Run& run = runs_[r];
    run.s0 = path[run.first].s0();
    run.length = path[run.last - 1].s1() - run.s0;
    for (std::size_t i = run.first; i < run.last; ++i) run_[i] = r;
    if (!run.cuts) continue;
    // A run at the begin or end of the contour leaves the fine axes where they are.
    if (centred && (r == 0 || r + 1 == runs_.size())) continue;
    Box box;
    run.fits = true;
    for (std::size_t i = run.first; i < run.last && run.fits; ++i) {
      add_segment(box, path, i, stroke, scope);
      for (std::size_t k = 0; k < axes_; ++k)
        run.fits = run.fits && box.highest[k] - box.lowest[k] <= 2 * used_stroke * machine.axes[k].stroke;
    }
    if (run.fits)
      for (std::size_t k = 0; k < axes_; ++k) run.centre[k] = 0.5 * (box.lowest[k] + box.highest[k]);
  }
  // The offset of the fine axes at the ends of a run that fits is what the moves before and behind it have to reach.
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    Run& run = runs_[r];
    if (run.cuts) continue;
    AxisArray end{};
    const auto offset = [&](const Run& beside, std::size_t segment, double s, AxisArray& out) {
      if (!beside.fits) return;
      const AxisArray x = path.at(segment, s).value;
      for (std::size_t k = 0; k < axes_; ++k) out[k] = x[k] - beside.centre[k];
    };
    if (r > 0) offset(runs_[r - 1], run.first, run.s0, run.begin);
    if (r + 1 < runs_.size()) offset(runs_[r + 1], run.last - 1, run.s0 + run.length, end);
    if (r == 0 && !centred) run.begin = end;  // where nothing was before, the fine axes already stand where needed
    if (r + 1 == runs_.size() && !centred) end = run.begin;
    for (std::size_t k = 0; k < axes_; ++k) run.change[k] = end[k] - run.begin[k];
  }
}

AxisJet FollowUp::at(std::size_t segment, double s, const AxisJet& tool) const {
  const Run& run = runs_[run_[segment]];
  AxisJet q;
  if (run.fits) {
    q.value = run.centre;
    return q;
  }
  q = tool;
  for (std::size_t k = 0; k < axes_; ++k) {
    q.value[k] -= run.begin[k] + run.change[k] * (s - run.s0) / run.length;
    q.d1[k] -= run.change[k] / run.length;
  }
  return q;
}

Expected<RedundancyResult, NoPlan> plan_follow_up(const RedundancyTask& task, const RedundancyOptions& options,
                                                  Progress progress) {
  const auto split = std::make_shared<const FollowUp>(*task.path, *task.contour, task.machine, progress);
  RedundancyTask stops = task;
  std::size_t fine = 0, coarse = 0;
  for (const FollowUp::Run& run : split->runs()) {
    stops.rests[run.first] = true;
    if (run.cuts) ++(run.fits ? fine : coarse);
    if (run.fits) continue;
    // The coarse axes carry all jumps of the tool's velocity, but their own velocity has to be continuous.
    for (std::size_t i = run.first + 1; i < run.last; ++i)
      if (stops_at(task.path->tool(), i, smallest_step)) stops.rests[i] = true;
  }
  Expected<RedundancyResult, NoPlan> result = plan_split(stops, split, unlimited, options, progress);
  if (!result) return result;
  result->notes.push_back("Of " + std::to_string(fine + coarse) + " runs of cuts the fine axes cut " +
                          std::to_string(fine) + " alone, the coarse axes " + std::to_string(coarse) + ".");
  return result;
}

}  // namespace bahnwerk
