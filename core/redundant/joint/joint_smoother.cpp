#include "core/redundant/joint/joint_smoother.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/redundant/head/following.hpp"
#include "core/redundant/head/slowed_by_energy.hpp"

namespace bahnwerk {
namespace {

// A factor up to this is applied evenly; so is one whose uneven distribution would keep more than this share of the
// energy.
constexpr double least_spread = 1e-6, worth_spreading = 0.9;
constexpr double hopeless = 3;  // factor of the least energy from which on uneven slowing cannot make up

}  // namespace

template <std::size_t order>
JointSplit<order> JointSmoother<order>::smoothest(double stretch, bool with_reserve) {
  if (stretch == 1) return fastest_;
  JointSplit<order> slowed = slowed_evenly(stretch);
  if (order != 2 || !with_reserve) return slowed;
  const double duration = fastest_.head->duration() * stretch;
  std::vector<std::pair<JointSplit<order>, HeadCellOptions>> found{{std::move(slowed), splits_.cells()}};
  double least = splits_.energy(found.front().first);
  const double longest = std::max(duration, fastest_.head->duration() * stretches[std::size(stretches) - 1]);
  for (const SmoothHeadCandidate& head : smooth_heads_.within(duration, longest)) {
    const HeadCellOptions cells = splits_.cells(head.reserve);
    std::optional<JointSplit<order>> split = split_of(head.head, duration, cells);
    if (!split) continue;
    least = std::min(least, splits_.energy(*split));
    found.emplace_back(*std::move(split), cells);
  }
  std::optional<JointSplit<order>> best;
  for (auto& [split, cells] : found) {
    if (splits_.energy(split) > hopeless * least) continue;
    JointSplit<order> slower = spread(std::move(split), duration, cells);
    if (!best || splits_.energy(slower) < splits_.energy(*best)) best = std::move(slower);
  }
  return *std::move(best);
}

/// Returns the quickest head, slowed, with the least energy of the coarse axes; if that is not found, the coarse axes
/// are slowed with it.
template <std::size_t order>
JointSplit<order> JointSmoother<order>::slowed_evenly(double stretch) {
  JointSplit<order> split{fastest_.head, fastest_.cells, stretch, {}, {}};
  if (fastest_.cells.size() > 0)  // there are none for strokes that are too small for them
    if (std::optional<std::vector<WindowedSolution<order>>> solutions = splits_.solve(fastest_.cells, stretch)) {
      split.solutions = *std::move(solutions);
      if (split.valid()) return split;
    }
  split.solutions = fastest_.solutions;
  split.closed = fastest_.closed;
  split.slowed = stretch;
  return split;
}

template <std::size_t order>
std::optional<JointSplit<order>> JointSmoother<order>::split_of(std::shared_ptr<const PathMotion> head, double duration,
                                                                const HeadCellOptions& options) {
  JointSplit<order> split{std::move(head), {}, 1, {}, {}};
  split.cells = head_cells(*split.head, options, scope_);
  split.stretch = std::max(duration / split.head->duration(), 1.0);
  std::optional<std::vector<WindowedSolution<order>>> solutions = splits_.solve(split.cells, split.stretch);
  if (!solutions) return std::nullopt;
  split.solutions = *std::move(solutions);
  if (!split.valid()) return std::nullopt;
  return split;
}

/// Replaces an evenly slowed split by one that is slow mostly where its coarse axes need most energy.
template <std::size_t order>
JointSplit<order> JointSmoother<order>::spread(JointSplit<order> even, double duration,
                                               const HeadCellOptions& options) {
  if (!(even.stretch > 1 + least_spread) || even.solutions.empty()) return even;
  const TimeLaw& law = even.head->law();
  std::vector<double> energies(even.cells.size());
  for (std::size_t j = 0; j < splits_.axes().size(); ++j) {
    const double unit = chain_units(splits_.axis(splits_.axes()[j])).acceleration();
    for (std::size_t c = 0; c < energies.size(); ++c) {
      const double a = even.solutions[j].controls[c] * unit;
      energies[c] += a * a * (even.cells.times[c + 1] - even.cells.times[c]);
    }
  }
  SlowedByEnergy slowed = slowed_by_energy(law, even.cells.times, energies, duration);
  if (slowed.energy > worth_spreading) return even;
  TimeLaw slow = law;
  slow.slow_sections(std::move(slowed.slowings));
  std::optional<JointSplit<order>> uneven =
      split_of(std::make_shared<const PathMotion>(task_.path, std::move(slow)), duration, options);
  return uneven && splits_.energy(*uneven) < splits_.energy(even) ? *std::move(uneven) : even;
}

template class JointSmoother<2>;
template class JointSmoother<3>;

}  // namespace bahnwerk
