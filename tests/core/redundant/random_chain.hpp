#pragma once
/// Chains with a motion that is known to stay inside their boxes, and what to check of any motion.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/numeric/random.hpp"
#include "core/redundant/chain/chain.hpp"

namespace bahnwerk::test {

template <std::size_t order>
struct KnownChain {
  Chain<order> chain;
  std::vector<ChainState<order>> states;
  std::vector<double> controls;
  double energy = 0;
};

/// Σ h·a², as the solver counts it.
template <std::size_t order>
double energy(const Chain<order>& chain, const std::vector<ChainState<order>>& states,
              const std::vector<double>& controls) {
  double sum = 0;
  for (std::size_t c = 0; c < chain.cells(); ++c)
    sum += chain.steps[c] * (order == 2 ? controls[c] * controls[c]
                                        : 0.5 * (states[c][order - 1] * states[c][order - 1] +
                                                 states[c + 1][order - 1] * states[c + 1][order - 1]));
  return sum;
}

/// Cells of very different duration; a motion from rest to rest in the middle of boxes of random width, some of whose
/// controls are fixed.
template <std::size_t order>
KnownChain<order> known_chain(Random& random, std::size_t cells) {
  KnownChain<order> known;
  Chain<order>& chain = known.chain;
  known.states.assign(1, ChainState<order>{random.uniform(-5, 5)});
  // The second half undoes what the first does to the derivatives: the first order of them by mirrored controls.
  std::vector<double> half, steps;
  for (std::size_t i = 0; i < cells / 2; ++i) {
    half.push_back(random.uniform(-1, 1));
    steps.push_back(std::pow(10, random.uniform(-3, -0.5)));
  }
  for (std::size_t i = 0; i < cells; ++i) {
    const bool second = i >= cells / 2;
    const std::size_t from = second ? cells - 1 - i : i;
    chain.steps.push_back(steps[from]);
    // Order 2: the velocity comes back when the acceleration is odd. Order 3: so does the acceleration, and the
    // velocity when the acceleration is odd, which needs a jerk that is even with mean 0: made so below.
    known.controls.push_back(order == 2 ? (second ? -half[from] : half[from]) : half[from]);
  }
  if constexpr (order == 3) {
    double sum = 0, time = 0;
    for (std::size_t i = 0; i < cells; ++i) {
      sum += chain.steps[i] * known.controls[i];
      time += chain.steps[i];
    }
    for (double& u : known.controls) u -= sum / time;
  }
  for (std::size_t i = 0; i < cells; ++i)
    known.states.push_back(advanced<order>(known.states.back(), chain.steps[i], known.controls[i]));
  for (std::size_t i = 0; i < cells; ++i) {
    const double room = random.below(5) == 0 ? 0 : random.uniform(0.01, 1);
    chain.controls.push_back({known.controls[i] - room, known.controls[i] + room * random.uniform(0.5, 2)});
  }
  for (const auto& x : known.states) {
    std::array<Range, order> ranges;
    for (std::size_t k = 0; k < order; ++k)
      ranges[k] = {x[k] - random.uniform(0.05, 1), x[k] + random.uniform(0.05, 1)};
    chain.states.push_back(ranges);
  }
  known.energy = energy<order>(chain, known.states, known.controls);
  return known;
}

/// Largest excess over the boxes that count, controls included.
template <std::size_t order>
double excess(const Chain<order>& chain, const std::vector<ChainState<order>>& states,
              const std::vector<double>& controls) {
  double worst = 0;
  for (std::size_t i = 0; i <= chain.cells(); ++i)
    for (std::size_t k = 0; k < order; ++k)
      if (chain.counts(i, k))
        worst = std::max({worst, states[i][k] - chain.states[i][k].highest, chain.states[i][k].lowest - states[i][k]});
  for (std::size_t c = 0; c < chain.cells(); ++c)
    worst = std::max({worst, controls[c] - chain.controls[c].highest, chain.controls[c].lowest - controls[c]});
  return worst;
}

/// From 0 to `way` in `time`, |acceleration| ≤ 1 (order 3: |jerk| ≤ 1), evenly divided.
template <std::size_t order>
Chain<order> point_to_point(double way, double time, std::size_t cells) {
  constexpr double far = 1e3;
  Chain<order> chain;
  chain.steps.assign(cells, time / static_cast<double>(cells));
  chain.controls.assign(cells, {-1, 1});
  std::array<Range, order> wide;
  wide.fill({-far, far});
  chain.states.assign(cells + 1, wide);
  chain.states.front()[0] = {-1e-6, 1e-6};
  chain.states.back()[0] = {way - 1e-6, way + 1e-6};
  return chain;
}

}  // namespace bahnwerk::test
