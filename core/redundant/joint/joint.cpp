#include "core/redundant/joint/joint.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "core/base/infeasible_at.hpp"
#include "core/redundant/coarse/coarse_task.hpp"
#include "core/redundant/coarse/following.hpp"
#include "core/redundant/joint/joint_planner.hpp"

namespace bahnwerk {
namespace {

constexpr std::array<double, 2> less_stroke{0.7, 0.4};  // shares of the strokes for which other plans are made
constexpr double far_above = 1.02;                      // factor of the bound from which on they are made
constexpr double mostly_slowed = 1.5;  // factor of the head's own duration from which on its limits do not matter
constexpr double uneven_jerk = 1.02;   // least quotient of both axes' times to reach their accelerations that matters

/// Returns the task with the share `part` of the strokes and without the fine axes whose strokes are too small for
/// cells.
JointTask resolved(JointTask task, const JointOptions& options, double part) {
  for (CoarseFineAxis& axis : task.machine.axes) {
    axis.stroke *= part;
    if (axis.stroke > 0 && axis.stroke < options.least_stroke) axis = coarse_alone(axis);
  }
  return task;
}

/// Lowers accelerations so that all axes reach theirs in the same time (`share` 1; 0 leaves the machine unchanged). The
/// head's jerk is a share of its acceleration (head_limits), so with lower accelerations its jerk may be higher.
/// Returns false if all axes take equally long already.
bool evened(CoarseFineMachine& machine, double share) {
  bool changed = false;
  for (CoarseFineAxis& axis : machine.axes) {
    if (!(axis.stroke > 0)) continue;
    const double coarse = axis.coarse.acceleration / axis.coarse.jerk, fine = axis.fine.acceleration / axis.fine.jerk;
    if (std::max(coarse, fine) <= uneven_jerk * std::min(coarse, fine)) continue;
    (coarse > fine ? axis.coarse : axis.fine).acceleration *=
        std::pow(std::min(coarse, fine) / std::max(coarse, fine), share);
    changed = true;
  }
  return changed;
}

/// Plans for the machine and for machines with smaller limits, and keeps the quickest plan.
template <std::size_t order>
class Candidates {
 public:
  Candidates(const JointTask& task, const JointOptions& options, Progress& progress, double from, double to)
      : task_(task), options_(options), progress_(progress), from_(from), to_(to) {}

  JointResult best() {
    if (!options_.coarse_alone) {
      if (unresolved()) add(task_, true);
      add(resolved(task_, options_, 1));
      if (order == 3 && best_ && best_->quickest() < mostly_slowed * head_alone_)
        for (const double share : {1.0, 0.5})
          if (JointTask other = task_; worth_it() && evened(other.machine, share))
            add(resolved(std::move(other), options_, 1));
      const bool slowed = best_ && most_slowed_ > 0 && task_.path->size() > 1;
      for (const double part : less_stroke)
        if (slowed && worth_it() && options_.bound > 0 && best_->quickest() > far_above * options_.bound &&
            within_coarse_range(*task_.path, task_.machine, part))
          add(resolved(task_, options_, part));
      if (slowed && within_coarse_range(*task_.path, task_.machine)) {
        const double split = best_->quickest();
        if (add(without_fine_axes(task_))) slower_ = split;
      }
    }
    const bool gave_way = !best_;
    if (gave_way) {
      refuse_beyond_range();
      best_ = planner(without_fine_axes(task_));
      best_->find(unlimited);
    }
    JointResult result = best_->result();
    result.gave_way = gave_way;
    result.slower = slower_;
    result.slowed = std::max(result.slowed, most_slowed_);
    result.fastest = std::min({result.fastest, head_alone_, result.chosen.duration});
    return result;
  }

 private:
  /// Tells whether the coarse axes alone would leave their ranges.
  void refuse_beyond_range() const {
    std::vector<InputFault> faults;
    for (const std::size_t k : beyond_coarse_range(*task_.path, task_.machine))
      faults.push_back(
          {{"machine", "coarse", task_.machine.axes[k].name, "range"},
           "no motion was found in which this coarse axis stays within its range; widen the range, or move "
           "the contour"});
    if (!faults.empty())
      throw InfeasibleAt("no motion was found in which the coarse axes stay within their ranges", std::move(faults));
  }

  std::unique_ptr<JointPlanner<order>> planner(JointTask task) const {
    return std::make_unique<JointPlanner<order>>(std::move(task), options_, progress_, from_, to_);
  }

  /// Tells whether the work so far leaves budget for another plan.
  bool worth_it() const { return work_ <= joint_work(head_alone_, order == 3); }

  /// Tells whether some stroke is too small for cells.
  bool unresolved() const {
    return std::any_of(task_.machine.axes.begin(), task_.machine.axes.end(), [this](const CoarseFineAxis& axis) {
      return axis.stroke > 0 && axis.stroke < options_.least_stroke;
    });
  }

  /// Plans a task; `closed`: only if there is a closed form, which needs no cells. Returns whether it is the quickest.
  bool add(JointTask task, bool closed = false) {
    std::unique_ptr<JointPlanner<order>> other;
    bool found = false;
    try {
      other = planner(std::move(task));
      head_alone_ = std::min(head_alone_, other->head_alone());
      found = closed ? other->find_closed() : other->find(best_ ? best_->quickest() : unlimited);
    } catch (const Infeasible&) {
      // Another plan may be feasible.
    }
    if (other) work_ += other->work();
    if (!found || (best_ && !(other->quickest() < best_->quickest()))) return false;
    most_slowed_ = std::max(most_slowed_, other->slowed());
    best_ = std::move(other);
    return true;
  }

  const JointTask& task_;
  const JointOptions& options_;
  Progress& progress_;
  double from_, to_;
  std::unique_ptr<JointPlanner<order>> best_;
  double head_alone_ = unlimited;  // s, least duration of a head under its own limits
  double work_ = 0;                // cells times Newton steps
  std::size_t most_slowed_ = 0;
  double slower_ = 0;  // s, the split that the coarse axes alone are quicker than
};

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
  if (jerk) return Candidates<3>(task, options, progress, from, to).best();
  return Candidates<2>(task, options, progress, from, to).best();
}

}  // namespace bahnwerk
