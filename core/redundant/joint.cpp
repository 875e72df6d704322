#include "core/redundant/joint.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/progress_scope.hpp"
#include "core/motion/axes/spline_motion.hpp"
#include "core/redundant/calm_heads.hpp"
#include "core/redundant/carried_motion.hpp"
#include "core/redundant/chain_windows.hpp"
#include "core/redundant/energy.hpp"
#include "core/redundant/followable_states.hpp"
#include "core/redundant/following.hpp"
#include "core/redundant/head_plan.hpp"
#include "core/redundant/head_slowing.hpp"
#include "core/redundant/lone_move.hpp"
#include "core/redundant/slowed_by_energy.hpp"

namespace bahnwerk {
namespace {

constexpr double head_share = 1 - 1e-7;  // of the summed limits: so that rounding leaves the coarse axis something
// With jerk limited accelerations are linear in a cell, which leaves the fine axis a little less than its limit.
constexpr double head_share_with_jerk = 1 - 2e-3;
// Excess that counts as none, in the chain's units, of what boxes keep back (1e-6 of strokes and velocities). Stretches
// that are slowed have to have none at all, so that the whole is not left just above.
constexpr double followed = 2e-7;
constexpr double change = 0.05;       // of the fine acceleration, within a cell where it is what is limited
constexpr double jerk_change = 4e-3;  // of the fine acceleration: range of the jerk in a cell, times its duration
// Of the fine jerk: range of the jerk in a cell. With twice the fine jerk no coarse jerk would do for the whole cell.
constexpr double jerk_range = 1;
constexpr double rest_of_window = 4;  // of a window of the chain, in its units of time, beyond a stop of the axis
constexpr int most_attempts = 6;
// What is slowed by no more than this is slowed evenly, and so is what would keep more than this of its energy.
constexpr double least_spread = 1e-6, worth_spreading = 0.9;
constexpr double hopeless = 3;                          // times the least energy so far: no spreading makes up for that
constexpr std::array<double, 2> less_stroke{0.7, 0.4};  // parts of the strokes that may be planned for instead
constexpr double far_above = 1.02;                      // times the bound: then they are
constexpr double quicker = 1e-6;                        // of a duration: what the closed form has to gain

template <std::size_t order>
class Planner {
 public:
  Planner(const JointTask& task, const JointOptions& options, Progress& progress, double from, double to)
      : task_(task),
        options_(options),
        progress_(progress),
        scope_(progress, "planning", from, to),
        plan_(task, options.corner_angle, order == 2 ? head_share : head_share_with_jerk, progress) {
    const Machine held = head_limits(task.machine);
    cell_options_.longest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < axes(); ++k) {
      const CoarseFineAxis& axis = task.machine.axes[k];
      const bool splits = axis.stroke > 0;
      if (splits) split_.push_back(k);
      if (splits) cell_options_.longest = std::min(cell_options_.longest, options.cell * chain_units(axis).time);
      cell_options_.acceleration_change.push_back(splits && order == 2 ? change * axis.fine.acceleration : unlimited);
      cell_options_.jerk_change.push_back(splits && order == 3 ? jerk_change * axis.fine.acceleration : unlimited);
      cell_options_.jerk_range.push_back(splits && order == 3 ? jerk_range * axis.fine.jerk : unlimited);
      cell_options_.held.push_back(held.axes[k]);
    }
    chain_options_.tick = [this] { scope_.report(); };
  }

  JointResult run() {
    head_ = plan_.motion();
    result_.fastest = head_->duration();
    if (split_.empty())
      fastest_.head = head_;
    else if (!lone())
      followed_head();
    const double chosen = options_.stretch >= 1 ? options_.stretch : stretch_of(options_.smoothness);
    if (options_.compare)
      for (const double stretch : stretches) {
        const Split split = smoothest(stretch);
        result_.trades.push_back(trade(stretch, split));
        if (stretch == chosen) keep(stretch, split);
      }
    if (!result_.coarse) keep(chosen, smoothest(chosen));
    result_.cells = fastest_.cells.size();
    return std::move(result_);
  }

 private:
  /// A head, stretched, and what the coarse axes do.
  struct Split {
    std::shared_ptr<const PathMotion> head;
    HeadCells cells;
    double stretch = 1;
    std::vector<WindowedSolution<order>> solutions;  ///< of each axis that is split
    std::vector<SplineMotion::Piece> closed;         ///< in place of solutions, of all axes; not stretched
    double slowed = 1;  ///< by which solutions of the motion were slowed that are those of a quicker one
  };

  /// The closed form of a lone move, where no head that the coarse axes can follow is known to be as quick.
  bool lone() {
    if (!task_.dwells.empty()) return false;
    std::optional<LoneMove> move = lone_move(*task_.path, task_.machine, task_.feeds.front());
    if (!move) return false;
    // Below the head's own duration only by what its limits keep back, which is more with limited jerk.
    if (!(move->head.duration() < head_->duration() * (1 - quicker))) {
      cells_ = head_cells(*head_, cell_options_, scope_);
      std::vector<WindowedSolution<order>> solutions = solve_all(1);
      if (exceeding(solutions).empty()) {
        fastest_ = {head_, std::move(cells_), 1, std::move(solutions), {}};
        return true;
      }
    }
    fastest_.head = std::make_shared<const PathMotion>(task_.path, std::move(move->head));
    fastest_.cells = head_cells(*fastest_.head, cell_options_, scope_);
    fastest_.closed = std::move(move->coarse);
    const bool slower = fastest_.head->duration() > head_->duration() * (1 + quicker);
    result_.slowed = result_.certified = slower ? 1 : 0;
    return true;
  }

  /// The quickest head that the coarse axes are found to be able to follow.
  void followed_head() {
    std::vector<WindowedSolution<order>> solutions;
    HeadSlowingCounts counts;
    for (int attempt = 0;; ++attempt) {
      cells_ = head_cells(*head_, cell_options_, scope_);
      std::vector<HeadStretch> stretches = attempt == 0 ? conflicting() : std::vector<HeadStretch>();
      if (stretches.empty()) {
        solutions = solve_all(1);
        stretches = exceeding(solutions);
      }
      if (stretches.empty()) break;
      if (!alone_) {
        slow(stretches, attempt, counts);
      } else if (order == 3 && !stops_) {
        stops_ = true;
        head_ = plan_.coarse_alone(true);
      } else {
        throw Infeasible("the coarse axes cannot follow, however slowly the tool moves");
      }
    }
    result_.rounds = counts.rounds;
    result_.certified = counts.certified;
    result_.slowed = plan_.slowed();
    fastest_ = {head_, std::move(cells_), 1, std::move(solutions), {}};
  }

  std::size_t axes() const { return task_.machine.axes.size(); }
  const CoarseFineAxis& axis(std::size_t k) const { return task_.machine.axes[k]; }

  /// The head gets slower on those stretches; it is never slower than the coarse axes alone, unless those have to rest
  /// where curvature jumps.
  void slow(const std::vector<HeadStretch>& stretches, int attempt, HeadSlowingCounts& counts) {
    double around = 0;
    for (const std::size_t k : split_) around = std::max(around, ahead(k) * chain_units(axis(k)).time);
    HeadSlowing<order> slowing(plan_, task_.machine, cell_options_, around, options_.max_rounds, scope_);
    bool found = attempt < most_attempts;
    try {
      for (const HeadStretch& stretch : stretches)
        if (found) slowing.run(stretch, counts);
    } catch (const Infeasible&) {
      found = false;
    }
    if (found) head_ = plan_.motion();
    const auto alone = plan_.coarse_alone();
    alone_ = !found || alone->duration() < head_->duration();
    if (alone_) head_ = alone;
    ahead_ *= 2;  // should it have been too short
  }

  /// What a window of the chain of an axis needs beyond what is kept, in the chain's units of time.
  double ahead(std::size_t k) const {
    const Limits& coarse = axis(k).coarse;
    return ahead_ * (coarse.velocity / coarse.acceleration / chain_units(axis(k)).time + rest_of_window);
  }

  std::vector<WindowedSolution<order>> solve_all(double stretch) { return solve_all(cells_, stretch); }
  std::vector<WindowedSolution<order>> solve_all(const HeadCells& cells, double stretch) {
    std::vector<WindowedSolution<order>> solutions;
    for (const std::size_t k : split_) {
      ChainWindowOptions windows;
      windows.ahead = ahead(k);
      windows.followed = followed;
      solutions.push_back(solve_in_windows(following<order>(cells, k, axis(k), stretch), chain_options_, windows));
      result_.iterations += solutions.back().iterations;
    }
    return solutions;
  }

  using Nodes = std::vector<std::pair<std::size_t, std::size_t>>;  ///< first and last ones of stretches

  /// The sections around what exceeds boxes.
  std::vector<HeadStretch> exceeding(const std::vector<WindowedSolution<order>>& solutions) const {
    std::vector<Nodes> nodes;
    for (const WindowedSolution<order>& solution : solutions) nodes.push_back(solution.exceeds);
    return sections_around(nodes);
  }

  /// The sections around what no coarse motion can follow, as far as sets of states tell: much sooner than a solution.
  std::vector<HeadStretch> conflicting() {
    std::vector<Nodes> nodes;
    if constexpr (order == 2)
      for (const std::size_t k : split_)
        nodes.push_back(conflicts(following<2>(cells_, k, axis(k)), chain_options_.tick));
    return sections_around(nodes);
  }

  std::vector<HeadStretch> sections_around(const std::vector<Nodes>& nodes) const {
    std::vector<HeadStretch> found;
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      const double around = ahead(split_[j]) * chain_units(axis(split_[j])).time;
      for (const auto& [first, last] : nodes[j])
        found.push_back({plan_.section_begin(segment_at(cells_.times[first] - around)),
                         plan_.section_end(segment_at(cells_.times[last] + around))});
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<HeadStretch> merged;
    for (const HeadStretch& s : found)
      if (!merged.empty() && s.first < merged.back().last)
        merged.back().last = std::max(merged.back().last, s.last);
      else
        merged.push_back(s);
    return merged;
  }

  std::size_t segment_at(double t) const {
    const TimeLaw& law = head_->law();
    return law.pieces()[law.find(std::clamp(t, 0.0, law.duration()))].segment;
  }

  /// The same motion slowed, or a head that leaves the coarse axes more freedom and takes as long: with what the summed
  /// limits demand of it a coarse axis has to accelerate wherever the fine one could not alone.
  Split smoothest(double stretch) {
    if (stretch == 1) return fastest_;
    Split slowed = slowed_evenly(stretch);
    if (order != 2 || alone_ || split_.empty()) return slowed;
    const double duration = fastest_.head->duration() * stretch;
    std::vector<std::pair<Split, HeadCellOptions>> found{{std::move(slowed), cell_options_}};
    double least = energy(found.front().first);
    const double longest = std::max(duration, fastest_.head->duration() * stretches[std::size(stretches) - 1]);
    for (const CalmHead& calm : calm_.within(duration, longest)) {
      const HeadCellOptions cells = cell_options(calm.freedom);
      Split split = split_of(calm.head, duration, cells);
      if (!valid(split)) continue;
      least = std::min(least, energy(split));
      found.emplace_back(std::move(split), cells);
    }
    std::optional<Split> best;
    for (auto& [split, cells] : found) {
      if (energy(split) > hopeless * least) continue;
      Split slower = spread(std::move(split), duration, cells);
      if (!best || energy(slower) < energy(*best)) best = std::move(slower);
    }
    return *std::move(best);
  }

  /// The quickest head, slowed, with the coarse axes' least energy then; where that is not found they are slowed with
  /// it.
  Split slowed_evenly(double stretch) {
    Split split{fastest_.head, fastest_.cells, stretch, {}, {}};
    if (!split_.empty()) split.solutions = solve_all(fastest_.cells, stretch);
    if (valid(split)) return split;
    split.solutions = fastest_.solutions;
    split.closed = fastest_.closed;
    split.slowed = stretch;
    return split;
  }

  HeadCellOptions cell_options(const Freedom& freedom) const {
    HeadCellOptions cells = cell_options_;
    for (std::size_t k = 0; k < axes(); ++k) {
      double& held = cells.held[k].acceleration;
      held += freedom.calm * (std::min(held, axis(k).fine.acceleration) - held);
      held *= freedom.gentle;
    }
    return cells;
  }

  Split split_of(std::shared_ptr<const PathMotion> head, double duration, const HeadCellOptions& options) {
    Split split{std::move(head), {}, 1, {}, {}};
    split.cells = head_cells(*split.head, options, scope_);
    split.stretch = std::max(duration / split.head->duration(), 1.0);
    split.solutions = solve_all(split.cells, split.stretch);
    return split;
  }
  static bool valid(const Split& split) {
    return std::all_of(split.solutions.begin(), split.solutions.end(), [](const auto& s) { return s.exceeds.empty(); });
  }

  /// Lets a split that is slowed evenly be slow where its coarse axes work hardest instead.
  Split spread(Split even, double duration, const HeadCellOptions& options) {
    if (!(even.stretch > 1 + least_spread) || even.solutions.empty()) return even;
    const TimeLaw& law = even.head->law();
    std::vector<double> energies(even.cells.size());
    for (std::size_t j = 0; j < split_.size(); ++j) {
      const double unit = chain_units(axis(split_[j])).acceleration();
      for (std::size_t c = 0; c < energies.size(); ++c) {
        const double a = even.solutions[j].controls[c] * unit;
        energies[c] += a * a * (even.cells.times[c + 1] - even.cells.times[c]);
      }
    }
    SlowedByEnergy slowed = slowed_by_energy(law, even.cells.times, energies, duration);
    if (slowed.energy > worth_spreading) return even;
    TimeLaw slow = law;
    slow.slow_sections(std::move(slowed.slowings));
    Split uneven = split_of(std::make_shared<const PathMotion>(task_.path, std::move(slow)), duration, options);
    return valid(uneven) && energy(uneven) < energy(even) ? uneven : even;
  }

  double energy(const Split& split) const {
    double sum = 0;
    for (const double e : trade(split.stretch, split).energy) sum += e;
    return sum;
  }

  Trade trade(double stretch, const Split& split) const {
    Trade t{stretch, split.head->duration() * split.stretch, std::vector<double>(axes())};
    if (split.solutions.size() < axes()) {  // some axes are those of the head
      t.energy = acceleration_energy(*coarse_of(split, head_of(split)));
      return t;
    }
    for (std::size_t j = 0; j < split_.size(); ++j) {
      const ChainUnits u = chain_units(axis(split_[j]));
      t.energy[split_[j]] =
          split.solutions[j].energy * u.acceleration() * u.acceleration() * u.time / std::pow(split.slowed, 3);
    }
    return t;
  }

  void keep(double stretch, const Split& split) {
    result_.chosen = trade(stretch, split);
    result_.head = head_of(split);
    result_.chosen.duration = result_.head->duration();
    result_.coarse = coarse_of(split, result_.head);
  }

  std::shared_ptr<const PathMotion> head_of(const Split& split) const {
    if (split.stretch == 1) return split.head;
    return std::make_shared<const PathMotion>(task_.path, split.head->law().slowed(split.stretch));
  }

  /// What the coarse axes do; `head` is slowed already.
  std::shared_ptr<const Motion> coarse_of(const Split& split, std::shared_ptr<const PathMotion> head) const {
    if (split_.empty()) return std::make_shared<const CarriedMotion>(head, nullptr, std::vector<bool>(axes(), true));
    std::vector<SplineMotion::Piece> pieces = split.closed.empty() ? pieces_of(split, head->duration()) : split.closed;
    if (!split.closed.empty() && split.slowed > 1) {
      const std::vector<LawPiece>::size_type n = head->law().pieces().size();
      for (std::size_t i = 0; i < pieces.size(); ++i) {
        pieces[i].end = i + 1 < n ? head->law().pieces()[i + 1].t0 : head->duration();
        for (Polynomial& p : pieces[i].axes) slow(p, split.slowed);
      }
    }
    auto spline = std::make_shared<const SplineMotion>(std::move(pieces));
    if (split_.size() == axes() || !split.closed.empty()) return spline;
    std::vector<bool> carried(axes(), true);
    for (const std::size_t k : split_) carried[k] = false;
    return std::make_shared<const CarriedMotion>(std::move(head), std::move(spline), std::move(carried));
  }

  static void slow(Polynomial& p, double factor) {
    double power = 1;
    for (double& c : p) c /= power, power *= factor;
  }

  std::vector<SplineMotion::Piece> pieces_of(const Split& split, double duration) const {
    const HeadCells& cells = split.cells;
    std::vector<SplineMotion::Piece> coarse(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c) {
      coarse[c].end = c + 1 < cells.size() ? cells.times[c + 1] * split.stretch : duration;
      coarse[c].axes.assign(axes(), Polynomial{0});
      for (std::size_t j = 0; j < split_.size(); ++j) {
        const ChainUnits u = chain_units(axis(split_[j]));
        const ChainState<order>& x = split.solutions[j].states[c];
        Polynomial p{x[0] * u.length, x[1] * u.velocity()};
        if constexpr (order == 2) {
          p.push_back(0.5 * split.solutions[j].controls[c] * u.acceleration());
        } else {
          p.push_back(0.5 * x[2] * u.acceleration());
          p.push_back(split.solutions[j].controls[c] * u.jerk() / 6);
        }
        slow(p, split.slowed);
        coarse[c].axes[split_[j]] = std::move(p);
      }
    }
    return coarse;
  }

  const JointTask& task_;
  const JointOptions& options_;
  Progress& progress_;
  ProgressScope scope_;
  HeadPlan<order> plan_;
  HeadCellOptions cell_options_;
  ChainOptions chain_options_;
  std::shared_ptr<const PathMotion> head_;
  std::vector<std::size_t> split_;  // axes that have a fine one
  HeadCells cells_;
  Split fastest_;
  CalmHeads<order> calm_{plan_, head_share};
  double ahead_ = 1;
  bool alone_ = false;  // whether the head moves as the coarse axes alone can
  bool stops_ = false;  // and rests where curvature jumps, too
  JointResult result_;
};

/// At rest wherever derivatives of the path jump that coarse axes have to let be continuous.
JointTask resting_at_jumps(JointTask task, bool jerk) {
  for (std::size_t i = 1; i < task.path->size(); ++i)
    task.rests[i] = task.rests[i] || derivatives_jump(*task.path, i, jerk ? 2 : 1);
  return task;
}

/// Without fine axes.
JointTask alone(JointTask task, bool jerk) {
  for (CoarseFineAxis& axis : task.machine.axes) axis = coarse_alone(axis);
  return resting_at_jumps(std::move(task), jerk);
}

/// The task on that part of the strokes, without the fine axes whose strokes are too small for cells.
JointTask resolved(JointTask task, const JointOptions& options, bool jerk, double part) {
  bool small = false;
  for (CoarseFineAxis& axis : task.machine.axes) {
    axis.stroke *= part;
    if (!(axis.stroke > 0) || options.cell * chain_units(axis).time >= options.least_cell) continue;
    axis = coarse_alone(axis);
    small = true;
  }
  return small ? resting_at_jumps(std::move(task), jerk) : task;
}

}  // namespace

double stretch_of(double smoothness) {
  const double at = std::clamp(smoothness, 0.0, 1.0) * static_cast<double>(std::size(stretches) - 1);
  const auto i = std::min(static_cast<std::size_t>(at), std::size(stretches) - 2);
  return stretches[i] + (at - static_cast<double>(i)) * (stretches[i + 1] - stretches[i]);
}

JointResult plan_joint(const JointTask& task, const JointOptions& options, Progress& progress, double from, double to) {
  const bool jerk = task.machine.limits_jerk();
  for (const CoarseFineAxis& axis : task.machine.axes)
    if ((axis.coarse.jerk < unlimited) != jerk || (axis.fine.jerk < unlimited) != jerk)
      throw std::invalid_argument("the jerk is limited of all axes or of none");
  const auto planned = [&](const JointTask& given, const JointOptions& how) {
    if (jerk) return Planner<3>(given, how, progress, from, to).run();
    return Planner<2>(given, how, progress, from, to).run();
  };
  std::optional<JointResult> best;
  const auto tried = [&](const JointTask& given, const JointOptions& how) {
    try {
      JointResult result = planned(given, how);
      if (!best || result.chosen.duration < best->chosen.duration) {
        if (best) result.fastest = best->fastest, result.slowed = std::max(result.slowed, best->slowed);
        best = std::move(result);
      }
    } catch (const Infeasible&) {
      // Another plan may be one.
    }
  };
  if (!options.coarse_alone) {
    tried(resolved(task, options, jerk, 1), options);
    const bool slowed = best && best->slowed > 0 && task.path->size() > 1;
    for (const double part : less_stroke)
      if (slowed && options.bound > 0 && best->chosen.duration > far_above * options.bound * best->chosen.stretch)
        tried(resolved(task, options, jerk, part), options);
    if (slowed) tried(alone(task, jerk), options);
    if (best) return *std::move(best);
  }
  JointResult result = planned(alone(task, jerk), options);
  result.gave_way = true;
  return result;
}

}  // namespace bahnwerk
