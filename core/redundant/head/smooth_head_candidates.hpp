#pragma once
/// Heads that take longer than the quickest one and need less acceleration of the coarse axes. Wherever a head needs
/// more acceleration than the fine axes have, the coarse axes must accelerate; these heads stay below the summed
/// limits.
#include <memory>
#include <vector>

#include "core/motion/law/path_motion.hpp"
#include "core/redundant/head/head_plan.hpp"

namespace bahnwerk {

struct SmoothHeadCandidate {
  std::shared_ptr<const PathMotion> head;
  HeadReserve reserve;
};

/// Plans candidates by HeadPlan and keeps those that serve several durations.
template <std::size_t order>
class SmoothHeadCandidates {
 public:
  /// `plan` must outlive this object; `share` of the summed limits is available to the heads.
  SmoothHeadCandidates(const HeadPlan<order>& plan, double share) : plan_(plan), share_(share) {}

  /// Returns heads that take no longer than `duration`, s. The first ones use ever less of the coarse axes'
  /// accelerations; the next ones, which use none of these, make long moves slower; the last ones reduce accelerations
  /// until half of the remaining time, and then all of it, is used. Empty if even the smallest reserve takes longer.
  /// `longest` is the largest duration that later calls will ask for.
  std::vector<SmoothHeadCandidate> within(double duration, double longest);

 private:
  SmoothHeadCandidate planned(const HeadReserve& reserve) const;
  bool smoothest(double duration, SmoothHeadCandidate& found);

  const HeadPlan<order>& plan_;
  double share_;
  std::vector<SmoothHeadCandidate> steps_;
};

extern template class SmoothHeadCandidates<2>;
extern template class SmoothHeadCandidates<3>;

}  // namespace bahnwerk
