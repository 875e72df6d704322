#pragma once
/// Heads that take longer than the quickest one and leave the coarse axes more freedom: what the summed limits demand
/// of a head, coarse axes have to accelerate for wherever the fine ones could not do it alone.
#include <memory>
#include <vector>

#include "core/motion/law/path_motion.hpp"
#include "core/redundant/head_plan.hpp"

namespace bahnwerk {

struct SmoothHeadCandidate {
  std::shared_ptr<const PathMotion> head;
  Freedom freedom;
};

/// Each head costs a plan (HeadPlan::calmer); those that serve several durations are kept.
template <std::size_t order>
class SmoothHeadCandidates {
 public:
  /// `plan` outlives it. `share` as for calmer().
  SmoothHeadCandidates(const HeadPlan<order>& plan, double share) : plan_(plan), share_(share) {}

  /// That take no longer than `duration`, s: with ever less of the coarse axes' accelerations, then slower long moves,
  /// as far as the time allows; and, with none of those accelerations, gentler ones for half of the time that is left
  /// then, and for all of it. None where even a little calm takes longer. `longest`: of the durations to come.
  std::vector<SmoothHeadCandidate> within(double duration, double longest);

 private:
  SmoothHeadCandidate planned(const Freedom& freedom) const;
  bool smoothest(double duration, SmoothHeadCandidate& found);

  const HeadPlan<order>& plan_;
  double share_;
  std::vector<SmoothHeadCandidate> steps_;
};

extern template class SmoothHeadCandidates<2>;
extern template class SmoothHeadCandidates<3>;

}  // namespace bahnwerk
