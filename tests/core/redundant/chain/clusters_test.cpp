#include "core/redundant/chain/clusters.hpp"

#include <gtest/gtest.h>

#include "tests/core/redundant/random_chain.hpp"

namespace bahnwerk {
namespace {

/// Stands at 0, moves on by `way` in a time that allows for 1 from rest (a little more, since it stands only to 1e-4 at
/// the nodes), stands there; and moves back.
Chain<2> two_moves(double way) {
  Chain<2> chain;
  const std::size_t stands = 40, moves = 40;
  for (std::size_t i = 0; i < 3 * stands + 2 * moves; ++i) {
    chain.steps.push_back(0.05);
    chain.controls.push_back({-1, 1});
  }
  for (std::size_t i = 0; i <= chain.cells(); ++i) {
    const bool first = i <= stands, third = i >= 2 * (stands + moves),
               second = i >= stands + moves && i <= 2 * stands + moves;
    const Range at = first || third ? Range{-1e-4, 1e-4} : second ? Range{way - 1e-4, way + 1e-4} : Range{-1, 2};
    chain.states.push_back({at, Range{-10, 10}});
  }
  return chain;
}

TEST(Clusters, EveryMoveThatIsTooFastHasItsOwnWithAProof) {
  const Chain<2> chain = two_moves(1.2);
  const ChainSolution<2> s = solve(chain, {});
  const auto found = clusters(chain, s, 1e-7);
  ASSERT_EQ(found.size(), 2u);
  for (const auto& c : found) {
    EXPECT_GT(c.certificate.value, 0);
    EXPECT_NEAR(infeasibility(chain, c.certificate), c.certificate.value, 1e-9 * c.certificate.value);
    EXPECT_GE(c.need, c.certificate.value);
    EXPECT_LE(c.first, c.last);
    EXPECT_EQ(c.gain.size(), c.certificate.last - c.certificate.first);
  }
  EXPECT_LT(found[0].certificate.last, 120u);
  EXPECT_GT(found[1].certificate.first, 80u);
}

TEST(Clusters, NoneWhereThereIsASolution) {
  const Chain<2> chain = two_moves(0.99);
  EXPECT_TRUE(clusters(chain, solve(chain, {}), 1e-7).empty());
}

TEST(Clusters, TheGainIsWhatALongerCellBrings) {
  const Chain<2> chain = test::point_to_point<2>(1.05, 2, 400);
  ChainOptions options;
  options.gap = 1e-8;
  const auto found = clusters(chain, solve(chain, options), 1e-7);
  ASSERT_EQ(found.size(), 1u);
  ASSERT_EQ(found[0].gain.size(), chain.cells());
  for (const std::size_t cell : {50u, 200u, 350u}) {
    Chain<2> longer = chain;
    const double by = 1e-4;
    longer.steps[cell] += by;
    const auto then = clusters(longer, solve(longer, options), 1e-7);
    ASSERT_EQ(then.size(), 1u);
    const double gain = (found[0].certificate.value - then[0].certificate.value) / by;
    EXPECT_NEAR(gain, found[0].gain[cell], 0.01 * gain) << cell;
  }
}

}  // namespace
}  // namespace bahnwerk
