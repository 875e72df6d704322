#pragma once
/// The smoothest coarse axes for a duration: by slowing the quickest motion, or by a head that asks less of them and
/// takes as long, either of them evenly or most where the coarse axes work hardest (slowed_by_energy.hpp).
#include "core/base/progress_scope.hpp"
#include "core/redundant/joint_split.hpp"
#include "core/redundant/smooth_head_candidates.hpp"

namespace bahnwerk {

template <std::size_t order>
class JointSmoother {
 public:
  /// All outlive it. `plan`: whose heads are calmed; `fastest`: the quickest motion that was found.
  JointSmoother(const JointTask& task, JointSplits<order>& splits, const HeadPlan<order>& plan,
                const JointSplit<order>& fastest, ProgressScope& scope)
      : task_(task), splits_(splits), fastest_(fastest), scope_(scope), smooth_heads_(plan, joint_head_share<order>) {}

  /// The quickest motion, slowed, or a head that leaves the coarse axes more freedom and takes as long (`calm`, without
  /// limited jerk): with what the summed limits demand of it a coarse axis has to accelerate wherever the fine one
  /// could not alone.
  JointSplit<order> smoothest(double stretch, bool calm);

 private:
  JointSplit<order> slowed_evenly(double stretch);
  JointSplit<order> split_of(std::shared_ptr<const PathMotion> head, double duration, const HeadCellOptions& options);
  JointSplit<order> spread(JointSplit<order> even, double duration, const HeadCellOptions& options);

  const JointTask& task_;
  JointSplits<order>& splits_;
  const JointSplit<order>& fastest_;
  ProgressScope& scope_;
  SmoothHeadCandidates<order> smooth_heads_;
};

extern template class JointSmoother<2>;
extern template class JointSmoother<3>;

}  // namespace bahnwerk
