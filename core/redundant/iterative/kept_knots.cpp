#include "core/redundant/iterative/kept_knots.hpp"

namespace bahnwerk {
namespace {

/// Returns the times at which the head reaches each block, rounded to samples, and the end. Blocks without a sample
/// take no time.
std::vector<double> entries(const HeadSamples& head) {
  std::vector<double> times;
  times.reserve(head.segments.back() - head.segments.front() + 2);
  for (std::size_t i = 0; i < head.times.size(); ++i)
    times.resize(head.segments[i] - head.segments.front() + 1, head.times[i]);
  times.push_back(head.times.back());
  return times;
}

}  // namespace

void KeptKnots::keep(const HeadSamples& head, const std::vector<TimeSpline>& coarse) {
  const std::vector<double> entry = entries(head);
  knots_.assign(coarse.size(), {});
  for (std::size_t k = 0; k < coarse.size(); ++k) {
    std::size_t block = 0;
    for (std::size_t i = 1; i < coarse[k].pieces(); ++i) {
      const double t = coarse[k].begin(i);
      while (block + 2 < entry.size() && entry[block + 1] <= t) ++block;
      const double lasts = entry[block + 1] - entry[block];
      knots_[k].push_back({block, lasts > 0 ? (t - entry[block]) / lasts : 0});
    }
  }
}

std::vector<double> KeptKnots::times(const HeadSamples& head, std::size_t axis) const {
  const std::vector<double> entry = entries(head);
  std::vector<double> times;
  times.reserve(knots_[axis].size());
  for (const Knot& knot : knots_[axis])
    if (knot.block + 1 < entry.size())
      times.push_back(entry[knot.block] + knot.share * (entry[knot.block + 1] - entry[knot.block]));
  return times;
}

}  // namespace bahnwerk
