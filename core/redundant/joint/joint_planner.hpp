#pragma once
/// The joint plan of one machine (steps of joint.hpp): first the quickest head found that the coarse axes can follow,
/// then the coarse motion with the least energy for the requested duration.
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/redundant/coarse/lone_move.hpp"
#include "core/redundant/head/head_plan.hpp"
#include "core/redundant/head/head_slowing.hpp"
#include "core/redundant/joint/joint_smoother.hpp"
#include "core/redundant/joint/joint_split.hpp"
#include "core/redundant/no_plan.hpp"

namespace bahnwerk {

template <std::size_t order>
class JointPlanner {
 public:
  /// Plans the head under the summed limits, or under those of the coarse axes if `options.coarse_head`; throws as its
  /// planner does.
  JointPlanner(JointTask task, const JointOptions& options, Progress progress);

  /// Searches the quickest motion. Returns false without a search if the head by itself already takes `below` s or
  /// longer, and the reason if no head was found that the coarse axes can follow.
  Expected<bool, NoPlan> find(double below);
  /// Takes the closed form of a single straight move, which needs no cells. Returns false if the path has none.
  bool find_closed();
  /// Returns the duration of the motion found, s.
  double quickest() const { return fastest_.head->duration(); }
  std::size_t slowed() const { return result_.slowed; }
  /// Returns the work of all solutions so far, in cells times Newton steps.
  double work() const { return work_.done; }
  /// Returns the duration of the head by itself, s.
  double head_alone() const { return result_.fastest; }
  /// Returns the motion for the requested duration and the table of trade-offs.
  JointResult result();

 private:
  using Nodes = std::vector<std::pair<std::size_t, std::size_t>>;  ///< intervals: first and last node

  bool lone();
  void take(LoneMove move);
  std::optional<NoPlan> follow();
  std::optional<std::vector<WindowedSolution<order>>> followed();
  std::optional<std::vector<WindowedSolution<order>>> solved();
  std::optional<NoPlan> slow(const std::vector<SegmentRange>& too_fast, HeadSlowingCounts& counts);
  std::vector<SegmentRange> exceeding(const std::vector<WindowedSolution<order>>& solutions) const;
  std::optional<std::vector<SegmentRange>> conflicting();
  std::vector<SegmentRange> sections_around(const std::vector<Nodes>& nodes) const;
  std::size_t segment_at(double t) const;
  void keep(double stretch, const JointSplit<order>& split);

  JointTask task_;
  JointOptions options_;
  ProgressScope scope_;
  HeadPlan<order> plan_;
  JointSplits<order> splits_;
  std::shared_ptr<const PathMotion> head_;
  HeadCells cells_;
  JointSplit<order> fastest_;
  JointSmoother<order> smoother_;
  bool closed_ = false;  // whether the motion is a closed form without cells
  SlowingWork work_;
  JointResult result_;
};

extern template class JointPlanner<2>;
extern template class JointPlanner<3>;

}  // namespace bahnwerk
