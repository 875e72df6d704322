#include "core/redundant/joint/joint_planner.hpp"

#include <algorithm>
#include <utility>

#include "core/redundant/chain/controllable_set.hpp"
#include "core/redundant/coarse/lone_move.hpp"
#include "core/redundant/head/following.hpp"

namespace bahnwerk {
namespace {

constexpr int most_attempts = 6;
constexpr std::size_t window_cells = 6000;  // approximate number of cells that a window solves at once
constexpr double quicker = 1e-6;            // least relative gain of the closed form

/// Returns the positions of the coarse axes at both ends.
bool within_ranges(const LoneMove& move, const CoarseFineMachine& machine) {
  const SplineMotion motion(move.coarse);
  const MotionState begin = motion.in_piece(0, 0), end = motion.final_state();
  for (std::size_t k = 0; k < machine.axes.size(); ++k)
    for (const double x : {begin[0][k], end[0][k]})
      if (x < machine.axes[k].coarse.lowest || x > machine.axes[k].coarse.highest) return false;
  return true;
}

}  // namespace

template <std::size_t order>
JointPlanner<order>::JointPlanner(JointTask task, const JointOptions& options, Progress progress)
    : task_(std::move(task)),
      options_(options),
      scope_(progress, "planning"),
      plan_(task_, options.corner_angle, joint_head_share<order>, progress),
      splits_(task_, options.cell, [this] { scope_.report(); }),
      head_(options.coarse_head ? plan_.coarse_alone() : plan_.motion()),
      smoother_(task_, splits_, plan_, fastest_, scope_) {
  result_.fastest = head_->duration();
  work_.most = joint_work(result_.fastest, order);
}

template <std::size_t order>
Expected<bool, NoPlan> JointPlanner<order>::find(double below) {
  if (!(head_->duration() < below)) return false;
  if (lone()) return true;
  if (const std::optional<NoPlan> none = follow()) return *none;
  return true;
}

template <std::size_t order>
bool JointPlanner<order>::find_closed() {
  if (!task_.dwells.empty()) return false;
  std::optional<LoneMove> move = lone_move(*task_.path, task_.machine, task_.feeds.front());
  if (!move || !within_ranges(*move, task_.machine)) return false;
  take(*std::move(move));
  closed_ = true;
  return true;
}

template <std::size_t order>
void JointPlanner<order>::take(LoneMove move) {
  fastest_.head = std::make_shared<const PathMotion>(task_.path, std::move(move.head));
  fastest_.closed = std::move(move.coarse);
  const bool slower = fastest_.head->duration() > head_->duration() * (1 + quicker);
  result_.slowed = result_.certified = slower ? 1 : 0;
}

template <std::size_t order>
JointResult JointPlanner<order>::result() {
  const double chosen = options_.stretch >= 1 ? options_.stretch : stretch_of(options_.smoothness);
  const bool with_reserve = !closed_ && !options_.coarse_head;
  if (options_.compare)
    for (const double stretch : stretches) {
      const JointSplit<order> split = smoother_.smoothest(stretch, with_reserve);
      result_.trades.push_back(splits_.trade(stretch, split));
      if (stretch == chosen) keep(stretch, split);
    }
  if (!result_.coarse) keep(chosen, smoother_.smoothest(chosen, with_reserve));
  result_.cells = fastest_.cells.size();
  result_.iterations = splits_.iterations();
  return std::move(result_);
}

/// Takes the closed form of a single straight move if no feasible head is known to be as quick.
template <std::size_t order>
bool JointPlanner<order>::lone() {
  if (!task_.dwells.empty()) return false;
  std::optional<LoneMove> move = lone_move(*task_.path, task_.machine, task_.feeds.front());
  if (!move || !within_ranges(*move, task_.machine)) return false;
  // The closed form can be below the head's duration only by the share of the limits that the head leaves unused, which
  // is larger with limited jerk.
  if (!(move->head.duration() < head_->duration() * (1 - quicker))) {
    cells_ = head_cells(*head_, splits_.cells(), scope_);
    if (std::optional<std::vector<WindowedSolution<order>>> solutions = followed()) {
      fastest_ = {head_, std::move(cells_), 1, *std::move(solutions), {}};
      return true;
    }
  }
  take(*std::move(move));
  HeadCellOptions cells = splits_.cells();  // the closed form's jerk is the sum of both axes', more than a head's
  for (std::size_t k = 0; k < cells.held.size(); ++k)
    cells.held[k].jerk = task_.machine.axes[k].coarse.jerk + task_.machine.axes[k].fine.jerk;
  fastest_.cells = head_cells(*fastest_.head, cells, scope_);
  return true;
}

/// Finds the quickest head that the coarse axes are found to be able to follow.
template <std::size_t order>
std::optional<NoPlan> JointPlanner<order>::follow() {
  std::vector<WindowedSolution<order>> solutions;
  HeadSlowingCounts counts;
  for (int attempt = 0;; ++attempt) {
    cells_ = head_cells(*head_, splits_.cells(), scope_);
    std::optional<std::vector<SegmentRange>> too_fast = std::vector<SegmentRange>();
    if (attempt == 0) too_fast = conflicting();
    if (!too_fast) return NoPlan::head_exceeds_limits;
    if (too_fast->empty()) {
      std::optional<std::vector<WindowedSolution<order>>> found = solved();
      if (!found) return NoPlan::head_exceeds_limits;
      solutions = *std::move(found);
      too_fast = exceeding(solutions);
    }
    if (too_fast->empty()) break;
    if (options_.coarse_head) return NoPlan::cannot_follow;
    if (attempt == most_attempts || work_.spent()) return NoPlan::effort;
    if (const std::optional<NoPlan> none = slow(*too_fast, counts)) return none;
  }
  result_.rounds = counts.rounds;
  result_.certified = counts.certified;
  result_.slowed = plan_.slowed();
  fastest_ = {head_, std::move(cells_), 1, std::move(solutions), {}};
  return std::nullopt;
}

/// Returns solutions without excess, if there are any.
template <std::size_t order>
std::optional<std::vector<WindowedSolution<order>>> JointPlanner<order>::followed() {
  std::optional<std::vector<WindowedSolution<order>>> solutions = solved();
  if (solutions && !exceeding(*solutions).empty()) return std::nullopt;
  return solutions;
}

template <std::size_t order>
std::optional<std::vector<WindowedSolution<order>>> JointPlanner<order>::solved() {
  std::optional<std::vector<WindowedSolution<order>>> solutions = splits_.solve(cells_, 1);
  if (!solutions) return std::nullopt;
  for (const WindowedSolution<order>& s : *solutions)
    work_.done += static_cast<double>(s.iterations * std::min(cells_.size(), window_cells));
  return solutions;
}

/// Slows the head on the given ranges. Returns the reason if no slower head was found that can be followed there.
template <std::size_t order>
std::optional<NoPlan> JointPlanner<order>::slow(const std::vector<SegmentRange>& too_fast, HeadSlowingCounts& counts) {
  double around = 0;
  for (const std::size_t k : splits_.axes()) around = std::max(around, splits_.ahead(k));
  const HeadSlowingOptions options{splits_.cells(), around, options_.max_rounds};
  HeadSlowing<order> slowing(plan_, task_.machine, options, work_, scope_);
  for (const SegmentRange& range : too_fast)
    if (const Expected<bool, NoPlan> slower = slowing.run(range, counts); !slower) return slower.reason();
  head_ = plan_.motion();
  splits_.double_look_ahead();  // the look-ahead may have been too short
  return std::nullopt;
}

/// Returns the sections around the nodes that exceed their boxes.
template <std::size_t order>
std::vector<SegmentRange> JointPlanner<order>::exceeding(const std::vector<WindowedSolution<order>>& solutions) const {
  std::vector<Nodes> nodes;
  for (const WindowedSolution<order>& solution : solutions) nodes.push_back(solution.exceeds);
  return sections_around(nodes);
}

/// Returns the sections around conflicts found by reachable sets, which is much quicker than solving the chains.
template <std::size_t order>
std::optional<std::vector<SegmentRange>> JointPlanner<order>::conflicting() {
  std::vector<Nodes> nodes;
  if constexpr (order == 2)
    for (const std::size_t k : splits_.axes()) {
      const std::optional<Chain<2>> chain = following<2>(cells_, k, splits_.axis(k));
      if (!chain) return std::nullopt;
      nodes.push_back(conflicts(*chain, splits_.chain().tick));
    }
  return sections_around(nodes);
}

template <std::size_t order>
std::vector<SegmentRange> JointPlanner<order>::sections_around(const std::vector<Nodes>& nodes) const {
  std::vector<SegmentRange> found;
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    const double around = splits_.ahead(splits_.axes()[j]);
    for (const auto& [first, last] : nodes[j])
      found.push_back({plan_.section_begin(segment_at(cells_.times[first] - around)),
                       plan_.section_end(segment_at(cells_.times[last] + around))});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<SegmentRange> merged;
  for (const SegmentRange& s : found)
    if (!merged.empty() && s.first < merged.back().last)
      merged.back().last = std::max(merged.back().last, s.last);
    else
      merged.push_back(s);
  return merged;
}

template <std::size_t order>
std::size_t JointPlanner<order>::segment_at(double t) const {
  const TimeLaw& law = head_->law();
  return law.pieces()[law.find(std::clamp(t, 0.0, law.duration()))].segment;
}

template <std::size_t order>
void JointPlanner<order>::keep(double stretch, const JointSplit<order>& split) {
  result_.chosen = splits_.trade(stretch, split);
  result_.head = splits_.head_of(split);
  result_.chosen.duration = result_.head->duration();
  result_.coarse = splits_.coarse_of(split, result_.head);
}

template class JointPlanner<2>;
template class JointPlanner<3>;

}  // namespace bahnwerk
