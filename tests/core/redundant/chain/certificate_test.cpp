#include "core/redundant/chain/certificate.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/redundant/chain/chain_solver.hpp"
#include "tests/core/redundant/random_chain.hpp"

namespace bahnwerk {
namespace {

template <std::size_t order>
Certificate<order> random_certificate(Random& random, const Chain<order>& chain) {
  Certificate<order> c;
  c.first = random.below(chain.cells());
  c.last = c.first + 1 + random.below(chain.cells() - c.first);
  c.multipliers.resize(c.last - c.first + 1);
  for (auto& z : c.multipliers)
    for (double& v : z) v = random.below(3) == 0 ? random.uniform(-1, 1) : 0;
  for (std::size_t k = 1; k < order; ++k) c.at_end[k] = random.uniform(-1, 1);
  return c;
}

/// No multipliers prove anything of a chain that has a motion inside its boxes, on whatever stretch.
template <std::size_t order>
void nothing_is_proven(std::uint64_t seed) {
  Random random(seed);
  for (int i = 0; i < 300; ++i) {
    const auto known = test::known_chain<order>(random, 20);
    const Certificate<order> c = random_certificate(random, known.chain);
    EXPECT_LE(infeasibility(known.chain, c), 1e-12);
  }
}

TEST(Certificate, ProvesNothingWhereThereIsASolution) {
  nothing_is_proven<2>(5);
  nothing_is_proven<3>(6);
}

TEST(Certificate, IsTheLeastOfAllMotions) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const auto known = test::known_chain<2>(random, 8);
    const Certificate<2> c = random_certificate(random, known.chain);
    std::vector<ChainState<2>> costates;
    const double value = infeasibility(known.chain, c, &costates);
    // The motion that attains it: controls and first state at the ends of their ranges that the costates tell.
    const auto sum_of = [&](bool extreme) {
      const auto pick = [&](double g, const Range& r) {
        return extreme ? (g > 0 ? r.lowest : r.highest) : random.uniform(r.lowest, r.highest);
      };
      ChainState<2> x{};
      for (std::size_t k = 0; k < 2; ++k)
        if (known.chain.counts(c.first, k)) x[k] = pick(costates[0][k], known.chain.states[c.first][k]);
      double sum = 0;
      for (std::size_t node = c.first;; ++node) {
        for (std::size_t k = 0; k < 2; ++k)
          if (known.chain.counts(node, k)) {
            const double z = c.multipliers[node - c.first][k];
            const Range& r = known.chain.states[node][k];
            sum += z * (x[k] - (z > 0 ? r.highest : r.lowest));
          }
        if (node == c.last) break;
        const double h = known.chain.steps[node];
        x = advanced<2>(x, h, pick(by_control<2>(costates[node + 1 - c.first], h), known.chain.controls[node]));
      }
      if (c.last == known.chain.cells()) sum += c.at_end[1] * x[1];
      return sum;
    };
    EXPECT_NEAR(sum_of(true), value, 1e-11);
    EXPECT_GE(sum_of(false), value - 1e-11);
  }
}

TEST(Certificate, TooFastAMoveIsProvenToBeTooFast) {
  const Chain<2> chain = test::point_to_point<2>(1.01, 2, 64);
  const ChainSolution<2> s = solve(chain, {});
  EXPECT_GT(infeasibility(chain, {0, chain.cells(), s.multipliers, s.at_end, 0}), 0);
  // By hand: at the end at 1.01 at least, and at rest; the first half can only accelerate, the second only brake.
  Certificate<2> c{0, chain.cells(), std::vector<ChainState<2>>(chain.cells() + 1), {}, 0};
  c.multipliers.front()[0] = 1;  // position at the begin not above 1e-6
  c.multipliers.back()[0] = -1;  // position at the end not below
  c.at_end[1] = 1;               // half of the time
  EXPECT_NEAR(infeasibility(chain, c), 0.01 - 2e-6, 1e-9);
}

TEST(Certificate, AnInfiniteRangeLeavesNothingProven) {
  Chain<2> chain = test::point_to_point<2>(1.01, 2, 8);
  for (auto& x : chain.states)
    x[1] = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Certificate<2> c{2, 5, std::vector<ChainState<2>>(4), {}, 0};
  c.multipliers.back()[0] = 1;  // with nothing to balance it the velocity at the begin of the stretch decides
  EXPECT_EQ(infeasibility(chain, c), -std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace bahnwerk
