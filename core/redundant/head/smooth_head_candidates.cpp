#include "core/redundant/head/smooth_head_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bahnwerk {
namespace {

constexpr double same_duration = 1e-6;  // relative difference of durations that counts as rounding
// Number of steps in which the coarse axes' accelerations go to 0; afterwards long moves get up to twice as long in
// twice as many steps.
constexpr std::size_t acceleration_steps = 8, all_steps = 3 * acceleration_steps;
HeadReserve reserve_of(std::size_t step) {
  if (step <= acceleration_steps) return {static_cast<double>(step) / acceleration_steps, 1, 1};
  return {1, std::pow(2, static_cast<double>(step - acceleration_steps) / (2 * acceleration_steps)), 1};
}

// Least share of accelerations and of the largest speed, most plans of its search, and share of the available time that
// may stay unused.
constexpr double least_acceleration_share = 1.0 / 8, unused = 0.01;
constexpr int most_trials = 8;
constexpr double parts_of_spare[] = {0.5, 1};  // shares of the remaining time

}  // namespace

template <std::size_t order>
SmoothHeadCandidate SmoothHeadCandidates<order>::planned(const HeadReserve& reserve) const {
  return {plan_.smoother_head(share_, reserve), reserve};
}

/// Searches the smallest acceleration share whose head takes no longer than `duration`. Returns false if no share below
/// 1 fits.
template <std::size_t order>
bool SmoothHeadCandidates<order>::smoothest(double duration, SmoothHeadCandidate& found) {
  const double spare = duration - found.head->duration();
  // The search variable is 1/share: the largest value that fits, the least that does not, and their errors of the
  // duration.
  double low = 1, high = 2, below = spare, above = 0;
  bool any = false;
  for (int trial = 0; trial < most_trials && low * least_acceleration_share < 1 && below > unused * spare; ++trial) {
    const double next = above > 0 ? low + (high - low) * std::clamp(below / (below + above), 0.1, 0.9) : high;
    SmoothHeadCandidate head = planned({1, 1, 1 / next});
    const double left = found.head->duration() + below - head.head->duration();
    if (left < 0) {
      high = next, above = -left;
      continue;
    }
    low = next, below = left, any = true;
    found = std::move(head);
    if (!(above > 0)) high = std::min(2 * low, 1 / least_acceleration_share);
  }
  return any;
}

template <std::size_t order>
std::vector<SmoothHeadCandidate> SmoothHeadCandidates<order>::within(double duration, double longest) {
  while (steps_.size() < all_steps && (steps_.empty() || steps_.back().head->duration() <= longest))
    steps_.push_back(planned(reserve_of(steps_.size() + 1)));
  const auto fits = [&](const SmoothHeadCandidate& candidate) {
    return candidate.head->duration() <= duration * (1 + same_duration);
  };
  const auto last = std::find_if(steps_.rbegin(), steps_.rend(), fits);
  std::vector<SmoothHeadCandidate> heads;
  if (last != steps_.rend()) heads.push_back(*last);
  if (steps_.size() < acceleration_steps || !fits(steps_[acceleration_steps - 1])) return heads;
  const double shortest = steps_[acceleration_steps - 1].head->duration();
  for (const double part : parts_of_spare) {
    SmoothHeadCandidate candidate = steps_[acceleration_steps - 1];
    if (smoothest(shortest + part * (duration - shortest), candidate)) heads.push_back(std::move(candidate));
  }
  return heads;
}

template class SmoothHeadCandidates<2>;
template class SmoothHeadCandidates<3>;

}  // namespace bahnwerk
