#pragma once
/// One machine's joint plan: the quickest head that the coarse axes are found to be able to follow, then the coarse
/// axes' motion for the duration that was asked for.
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/redundant/head_plan.hpp"
#include "core/redundant/head_slowing.hpp"
#include "core/redundant/joint_smoother.hpp"
#include "core/redundant/joint_split.hpp"
#include "core/redundant/lone_move.hpp"

namespace bahnwerk {

template <std::size_t order>
class JointPlanner {
 public:
  /// Plans the head within the summed limits. Throws as its planner does. `options` outlives it.
  JointPlanner(JointTask task, const JointOptions& options, Progress& progress, double from, double to);

  /// Looks for the quickest motion. False: the head by itself takes no less than `below`, s, and nothing was looked
  /// for. Throws Infeasible where no head was found that the coarse axes can follow.
  bool find(double below);
  /// The closed form of a lone move alone, which needs no cells. False: the path has none.
  bool find_closed();
  /// s, of what was found.
  double quickest() const { return fastest_.head->duration(); }
  std::size_t slowed() const { return result_.slowed; }
  /// Of all solutions so far.
  double work() const { return work_.done; }
  /// s, what the summed limits alone let the head do.
  double head_alone() const { return result_.fastest; }
  /// The motion that the options ask for, and the table of trades.
  JointResult result();

 private:
  using Nodes = std::vector<std::pair<std::size_t, std::size_t>>;  ///< first and last ones of stretches

  bool lone();
  void take(LoneMove move);
  void follow();
  std::optional<std::vector<WindowedSolution<order>>> followed();
  std::vector<WindowedSolution<order>> solved();
  void slow(const std::vector<HeadStretch>& too_fast, int attempt, HeadSlowingCounts& counts);
  std::vector<HeadStretch> exceeding(const std::vector<WindowedSolution<order>>& solutions) const;
  std::vector<HeadStretch> conflicting();
  std::vector<HeadStretch> sections_around(const std::vector<Nodes>& nodes) const;
  std::size_t segment_at(double t) const;
  void keep(double stretch, const JointSplit<order>& split);

  JointTask task_;
  const JointOptions& options_;
  ProgressScope scope_;
  HeadPlan<order> plan_;
  JointSplits<order> splits_;
  std::shared_ptr<const PathMotion> head_;
  HeadCells cells_;
  JointSplit<order> fastest_;
  JointSmoother<order> smoother_;
  bool alone_ = false;  // whether the head moves as the coarse axes alone can
  SlowingWork work_;
  bool stops_ = false;  // and rests where curvature jumps, too
  JointResult result_;
};

extern template class JointPlanner<2>;
extern template class JointPlanner<3>;

}  // namespace bahnwerk
