#include "core/motion/feed/critical_points.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

namespace bahnwerk {
namespace {

constexpr double resolution = 1e-4;  // resolution of the speed of a hill, relative
constexpr double least_gain = 1e-7;  // s: what is gained by less than that is not worth a change

/// A part of a segment with the largest feed at which all of it may be passed.
struct Cell {
  double s0 = 0, s1 = 0, feed = 0;
};

/// A rise, a constant speed and a fall between two holds.
struct Hill {
  FeedHold top;
  double duration = unlimited;
};

class Section {
 public:
  Section(const FeedGrid& grid, SpeedProfile profile, std::vector<Cell> cells, double begin, double end)
      : changes_(grid, profile), cells_(std::move(cells)), holds_(cells_.size() + 2) {
    holds_.front() = {begin, begin, 0}, holds_.back() = {end, end, 0};
    laid_ = {0, holds_.size() - 1};
  }

  std::vector<FeedHold> run(ProgressScope& stage_progress) {
    std::vector<std::size_t> order(cells_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return cells_[a].feed < cells_[b].feed; });
    for (const std::size_t cell : order) {
      lay(cell);
      stage_progress.work(400);
    }
    return with_hills(stage_progress);
  }

 private:
  // Holds are numbered as cells, from 1; 0 and the last one are the rests.
  void lay(std::size_t cell) {
    const auto after = laid_.upper_bound(cell + 1);
    const FeedHold &left = holds_[*std::prev(after)], &right = holds_[*after];
    const Cell& c = cells_[cell];
    const double lowest = std::max(left.v, right.v);
    for (const double part : {1.0, 0.97, 0.9, 0.8}) {
      const double feed = part * c.feed;
      if (!(feed >= lowest)) return;
      const auto rise = changes_.find(left.s1, left.v, feed, true, c.s1 - left.s1);
      if (!rise) continue;
      const auto fall = changes_.find(right.s0, right.v, feed, false, right.s0 - c.s0);
      if (!fall) continue;
      const FeedHold hold{std::max(c.s0, rise->far_end()), std::min(c.s1, fall->far_end()), feed};
      if (!(hold.s0 <= hold.s1)) continue;
      if (!worthwhile(left, right, hold, *rise, *fall)) return;
      holds_[cell + 1] = hold;
      laid_.insert(cell + 1);
      return;
    }
  }

  /// Returns whether the hold is quicker than going from one hold to the other directly.
  bool worthwhile(const FeedHold& left, const FeedHold& right, const FeedHold& hold, const FeedChange& rise,
                  const FeedChange& fall) const {
    const auto time = [&](double from, double to, double v) { return to > from ? (to - from) / v : 0; };
    const double through = time(rise.far_end(), fall.far_end(), hold.v) + rise.rise.duration + fall.rise.duration;
    const double lowest = std::max(left.v, right.v);
    if (!(lowest > 0)) return true;
    const auto direct = base(left, right);
    return !direct || through <= direct->duration + least_gain;
  }

  /// Returns the change at one end only, with the higher speed of both between the holds.
  std::optional<Hill> base(const FeedHold& left, const FeedHold& right) const {
    return hill(left, right, std::max(left.v, right.v));
  }

  /// Returns the changes with this speed at the top, if limits and the distance allow it.
  std::optional<Hill> hill(const FeedHold& left, const FeedHold& right, double top) const {
    const double room = right.s0 - left.s1;
    const auto rise = changes_.find(left.s1, left.v, top, true, room);
    if (!rise) return {};
    const auto fall = changes_.find(right.s0, right.v, top, false, room);
    if (!fall || !(rise->far_end() <= fall->far_end())) return {};
    return Hill{{rise->far_end(), fall->far_end(), top},
                rise->rise.duration + fall->rise.duration + (fall->far_end() - rise->far_end()) / top};
  }

  bool allowed(const Hill& hill, std::size_t first_cell, std::size_t last_cell) const {
    for (std::size_t i = first_cell; i < last_cell; ++i)
      if (cells_[i].s1 > hill.top.s0 && cells_[i].s0 < hill.top.s1 && cells_[i].feed < hill.top.v) return false;
    return true;
  }

  /// The quickest hill between two holds, of some that are tried.
  std::optional<Hill> highest(const FeedHold& left, const FeedHold& right, std::size_t first_cell,
                              std::size_t last_cell) const {
    const double lowest = std::max(left.v, right.v);
    double most = 0;
    std::size_t begin = first_cell;
    while (begin > 0 && cells_[begin - 1].s1 > left.s1) --begin;
    std::size_t end = last_cell;
    while (end < cells_.size() && cells_[end].s0 < right.s0) ++end;
    for (std::size_t i = begin; i < end; ++i) most = std::max(most, cells_[i].feed);
    std::optional<Hill> best = lowest > 0 ? base(left, right) : std::nullopt;
    if (best && best->top.s1 - best->top.s0 < 1e-9) return best;  // the hill is full already
    const auto offer = [&](double top) {
      if (!(top > lowest)) return;
      const auto found = hill(left, right, top);
      if (found && allowed(*found, begin, end) && (!best || found->duration < best->duration - least_gain))
        best = found;
    };
    double step = (most - lowest) / 2, centre = lowest + step;
    offer(most), offer(centre);
    for (int i = 0; i < 16 && step > resolution * centre; ++i) {
      step /= 2;
      if (best)
        centre = std::max(best->top.v, lowest);
      else
        centre = lowest + step;
      offer(centre + step);
      if (best && centre - step > lowest) offer(centre - step);
    }
    return best;
  }

  std::vector<FeedHold> with_hills(ProgressScope& stage_progress) const {
    std::vector<FeedHold> list;
    for (auto at = laid_.begin(); at != laid_.end(); ++at) {
      const FeedHold& here = holds_[*at];
      list.push_back(here);
      const auto next = std::next(at);
      if (next == laid_.end()) break;
      const std::size_t first = *at == 0 ? 0 : *at - 1, last = std::min(*next, cells_.size());
      if (const auto top = highest(here, holds_[*next], first, last)) list.push_back(top->top);
      stage_progress.work(400);
    }
    return list;
  }

  FeedChanges changes_;
  std::vector<Cell> cells_;
  std::vector<FeedHold> holds_;
  std::set<std::size_t> laid_;
};

/// A division of the path, and the part of the axes' limits that a hold may use.
struct Cut {
  std::size_t parts;
  double share;
};
constexpr Cut cuts[] = {{1, 1}, {4, 1}, {16, 1}, {1, 0.93}, {4, 0.93}, {16, 0.93}};

std::vector<Cell> cells_of(const FeedGrid& grid, std::size_t first, std::size_t last, const Cut& cut) {
  const PathTask& task = grid.task();
  std::vector<Cell> cells;
  for (std::size_t i = first; i < last; ++i) {
    const Segment& segment = task.path[i];
    const auto at = [&](std::size_t k) {
      return k == cut.parts ? segment.s1()
                            : segment.s0() + segment.length() * static_cast<double>(k) / static_cast<double>(cut.parts);
    };
    for (std::size_t p = 0; p < cut.parts; ++p)
      cells.push_back({at(p), at(p + 1), grid.hold_between(i, at(p), at(p + 1), cut.share)});
  }
  return cells;
}

/// Returns the fastest law of all divisions from rest to rest; empty if none can be written.
TimeLaw quickest(const FeedGrid& grid, SpeedProfile profile, std::size_t first, std::size_t last,
                 ProgressScope& stage_progress) {
  const Path& tool = grid.task().path.tool();
  TimeLaw best;
  for (const Cut& cut : cuts) {
    Section section(grid, profile, cells_of(grid, first, last, cut), tool[first].s0(), tool[last - 1].s1());
    TimeLaw law;
    if (write_feed(grid, profile, section.run(stage_progress), law) &&
        (best.pieces().empty() || law.duration() < best.duration()))
      best = std::move(law);
  }
  return best;
}

}  // namespace

TimeLaw plan_critical_points(const PathTask& task, const FeedOptions& options, Progress progress) {
  ProgressScope stage_progress(progress, "critical points");
  stage_progress.part(0, 0.4);
  const FeedGrid grid(task,
                      {options.nodes, speed_profile_row(options.profile).order, options.corner_angle, options.path},
                      stage_progress);
  FeedOptions largest = options;
  largest.feed = 0;
  TimeLaw constant = constant_feed(grid, largest);
  stage_progress.part(0.4, 1);
  const Path& tool = task.path.tool();
  const auto& sections = grid.sections().begin;
  TimeLaw law;
  for (std::size_t i = 0; i + 1 < sections.size(); ++i) {
    const TimeLaw part = quickest(grid, options.profile, sections[i], sections[i + 1], stage_progress);
    if (part.pieces().empty()) return constant;
    law.reserve(part.pieces().size());
    for (const LawPiece& piece : part.pieces()) law.append(piece);
    stage_progress.done(tool[sections[i + 1] - 1].s1() / tool.length());
  }
  return law.duration() <= constant.duration() ? std::move(law) : std::move(constant);
}

}  // namespace bahnwerk
