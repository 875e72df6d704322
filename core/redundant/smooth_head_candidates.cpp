#include "core/redundant/smooth_head_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bahnwerk {
namespace {

constexpr double same_duration = 1e-6;  // relative
// The coarse axes' accelerations go in so many steps, then long moves last up to twice as long in twice as many.
constexpr std::size_t calm_steps = 8, all_steps = 3 * calm_steps;
Freedom freedom_of(std::size_t step) {
  if (step <= calm_steps) return {static_cast<double>(step) / calm_steps, 1, 1};
  return {1, std::pow(2, static_cast<double>(step - calm_steps) / (2 * calm_steps)), 1};
}

// Accelerations and the largest speed fall to no less than this part, which so many plans at most find, or until no
// more than so much of the time there is stays unused.
constexpr double least_gentle = 1.0 / 8, unused = 0.01;
constexpr int most_trials = 8;
constexpr double parts_of_spare[] = {0.5, 1};  // of the time there is

}  // namespace

template <std::size_t order>
SmoothHeadCandidate SmoothHeadCandidates<order>::planned(const Freedom& freedom) const {
  return {plan_.calmer(share_, freedom), freedom};
}

/// From a head that takes no longer than that. False: none is any gentler.
template <std::size_t order>
bool SmoothHeadCandidates<order>::smoothest(double duration, SmoothHeadCandidate& found) {
  const double spare = duration - found.head->duration();
  // By 1/gentle: what fits, what does not, and by how much they miss the duration.
  double low = 1, high = 2, below = spare, above = 0;
  bool any = false;
  for (int trial = 0; trial < most_trials && low * least_gentle < 1 && below > unused * spare; ++trial) {
    const double next = above > 0 ? low + (high - low) * std::clamp(below / (below + above), 0.1, 0.9) : high;
    SmoothHeadCandidate head = planned({1, 1, 1 / next});
    const double left = found.head->duration() + below - head.head->duration();
    if (left < 0) {
      high = next, above = -left;
      continue;
    }
    low = next, below = left, any = true;
    found = std::move(head);
    if (!(above > 0)) high = std::min(2 * low, 1 / least_gentle);
  }
  return any;
}

template <std::size_t order>
std::vector<SmoothHeadCandidate> SmoothHeadCandidates<order>::within(double duration, double longest) {
  while (steps_.size() < all_steps && (steps_.empty() || steps_.back().head->duration() <= longest))
    steps_.push_back(planned(freedom_of(steps_.size() + 1)));
  const auto fits = [&](const SmoothHeadCandidate& calm) {
    return calm.head->duration() <= duration * (1 + same_duration);
  };
  const auto last = std::find_if(steps_.rbegin(), steps_.rend(), fits);
  std::vector<SmoothHeadCandidate> heads;
  if (last != steps_.rend()) heads.push_back(*last);
  if (steps_.size() < calm_steps || !fits(steps_[calm_steps - 1])) return heads;
  const double calm = steps_[calm_steps - 1].head->duration();
  for (const double part : parts_of_spare) {
    SmoothHeadCandidate gentle = steps_[calm_steps - 1];
    if (smoothest(calm + part * (duration - calm), gentle)) heads.push_back(std::move(gentle));
  }
  return heads;
}

template class SmoothHeadCandidates<2>;
template class SmoothHeadCandidates<3>;

}  // namespace bahnwerk
