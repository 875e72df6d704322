#pragma once
/// Step 4 of the joint planner (joint.hpp): the coarse motion with the least energy ∫a² for a given duration.
/// Candidates are the quickest motion slowed down and heads that need less coarse acceleration, both slowed evenly or
/// mostly where the coarse axes need most energy (slowed_by_energy.hpp).
#include <memory>
#include <optional>

#include "core/base/progress_scope.hpp"
#include "core/redundant/head/smooth_head_candidates.hpp"
#include "core/redundant/joint/joint_split.hpp"

namespace bahnwerk {

template <std::size_t order>
class JointSmoother {
 public:
  /// All references must outlive this object. `plan` supplies smoother heads; `fastest` is the quickest motion found.
  JointSmoother(const JointTask& task, JointSplits<order>& splits, const HeadPlan<order>& plan,
                const JointSplit<order>& fastest, ProgressScope& scope)
      : task_(task), splits_(splits), fastest_(fastest), scope_(scope), smooth_heads_(plan, joint_head_share<order>) {}

  /// Returns the candidate with the least energy for the duration of `fastest` times `stretch`. `with_reserve` adds
  /// heads that need less coarse acceleration (without limited jerk only): a head that uses the summed limits forces
  /// the coarse axis to accelerate wherever the fine one alone could not.
  JointSplit<order> smoothest(double stretch, bool with_reserve);

 private:
  JointSplit<order> slowed_evenly(double stretch);
  /// Returns the valid split of `head`, slowed to `duration`; none if there is no such.
  std::optional<JointSplit<order>> split_of(std::shared_ptr<const PathMotion> head, double duration,
                                            const HeadCellOptions& options);
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
