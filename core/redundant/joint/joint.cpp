#include "core/redundant/joint/joint.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "core/redundant/coarse/coarse_task.hpp"
#include "core/redundant/joint/joint_planner.hpp"

namespace bahnwerk {
namespace {

constexpr double far_above = 1.02;     // factor of the bound from which on plans for less stroke are made
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

/// Plans for the machine and for machines with smaller limits or strokes, and keeps the quickest plan.
template <std::size_t order>
class Variants {
 public:
  Variants(const JointTask& task, const JointOptions& options, Progress progress)
      : task_(task), options_(options), progress_(progress) {}

  Expected<JointResult, NoPlan> best() {
    static constexpr Variant variants[] = {
        // stroke, even jerk, coarse head, closed form, worth trying
        {1, 0, false, true, [](const Variants& v) { return v.unresolved(); }},
        {1, 0, false, false, [](const Variants&) { return true; }},
        {1, 1, false, false, [](const Variants& v) { return v.jerk_matters(); }},
        {1, 0.5, false, false, [](const Variants& v) { return v.jerk_matters(); }},
        {0.7, 0, false, false, [](const Variants& v) { return v.far_above_bound(0.7); }},
        {0.4, 0, false, false, [](const Variants& v) { return v.far_above_bound(0.4); }},
        {1, 0, true, false, [](const Variants& v) { return v.slowed() && (order == 3 || v.fine_axes_needed()); }},
    };
    for (const Variant& variant : variants)
      if (variant.worth(*this)) add(variant);
    if (!best_) return why_not_;
    JointResult result = best_->result();
    result.slowed = std::max(result.slowed, most_slowed_);
    result.fastest = std::min({result.fastest, head_alone_, result.chosen.duration});
    return result;
  }

 private:
  struct Variant {
    double stroke;     ///< used share of the strokes
    double even_jerk;  ///< share with which evened() lowers accelerations; 0: they are the task's
    bool coarse_head;  ///< whether the head keeps the limits of the coarse axes alone
    bool closed;       ///< closed form of a lone move alone, which needs no cells
    bool (*worth)(const Variants&);
  };

  /// Tells whether the work so far leaves budget for another plan.
  bool within_budget() const { return work_ <= joint_work(head_alone_, order); }
  /// Tells whether no plan was found yet, or only ones whose head had to be slowed.
  bool slowed() const { return !best_ || (most_slowed_ > 0 && task_.path->size() > 1); }
  bool jerk_matters() const {
    return order == 3 && best_ && best_->quickest() < mostly_slowed * head_alone_ && within_budget();
  }
  bool far_above_bound(double stroke) const {
    return slowed() && within_budget() && options_.bound > 0 &&
           (!best_ || best_->quickest() > far_above * options_.bound) &&
           within_coarse_range(*task_.path, task_.machine, stroke);
  }
  /// Tells whether the coarse axes alone would leave their ranges.
  bool fine_axes_needed() const { return !within_coarse_range(*task_.path, task_.machine); }
  /// Tells whether some stroke is too small for cells.
  bool unresolved() const {
    return std::any_of(task_.machine.axes.begin(), task_.machine.axes.end(), [this](const CoarseFineAxis& axis) {
      return axis.stroke > 0 && axis.stroke < options_.least_stroke;
    });
  }

  /// Plans a variant and keeps its plan if it is the quickest one.
  void add(const Variant& variant) {
    JointTask task = task_;
    if (variant.even_jerk > 0 && !evened(task.machine, variant.even_jerk)) return;
    if (!variant.closed) task = resolved(std::move(task), options_, variant.stroke);
    if (std::none_of(task.machine.axes.begin(), task.machine.axes.end(),
                     [](const CoarseFineAxis& axis) { return axis.stroke > 0; }))
      return;
    JointOptions options = options_;
    options.coarse_head = variant.coarse_head;
    auto other = std::make_unique<JointPlanner<order>>(std::move(task), options, progress_);
    head_alone_ = std::min(head_alone_, other->head_alone());
    const Expected<bool, NoPlan> found =
        variant.closed ? other->find_closed() : other->find(best_ ? best_->quickest() : unlimited);
    work_ += other->work();
    if (!found && !best_) why_not_ = found.reason();
    if (!found || !*found || (best_ && !(other->quickest() < best_->quickest()))) return;
    most_slowed_ = std::max(most_slowed_, other->slowed());
    best_ = std::move(other);
  }

  const JointTask& task_;
  const JointOptions& options_;
  Progress progress_;
  std::unique_ptr<JointPlanner<order>> best_;
  NoPlan why_not_ = NoPlan::no_fine_axis;
  double head_alone_ = unlimited;  // s, least duration of a head under its own limits
  double work_ = 0;                // cells times Newton steps
  std::size_t most_slowed_ = 0;
};

}  // namespace

double stretch_of(double smoothness) {
  const double at = std::clamp(smoothness, 0.0, 1.0) * static_cast<double>(std::size(stretches) - 1);
  const auto i = std::min(static_cast<std::size_t>(at), std::size(stretches) - 2);
  return stretches[i] + (at - static_cast<double>(i)) * (stretches[i + 1] - stretches[i]);
}

Expected<JointResult, NoPlan> plan_joint(const JointTask& task, const JointOptions& options, Progress progress) {
  const bool jerk = task.machine.limited_order() == 3;
  for (const CoarseFineAxis& axis : task.machine.axes)
    if ((axis.coarse.jerk < unlimited) != jerk || (axis.fine.jerk < unlimited) != jerk)
      throw std::invalid_argument("the jerk is limited of all axes or of none");
  if (jerk) return Variants<3>(task, options, progress).best();
  return Variants<2>(task, options, progress).best();
}

}  // namespace bahnwerk
