#include "core/redundant/chain/controllable_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/redundant/chain/chain_solver.hpp"
#include "tests/core/redundant/random_chain.hpp"

namespace bahnwerk {
namespace {

ControllableSet begin_of(const Chain<2>& chain) {
  return ControllableSet::at_node(chain.states.front(), chain.begins_at_rest);
}
ControllableSet end_of(const Chain<2>& chain) {
  return ControllableSet::at_node(chain.states.back(), chain.ends_at_rest);
}

bool can_be_followed(const Chain<2>& chain) {
  const std::size_t n = chain.cells();
  return followed_forward(begin_of(chain), chain, 0, n / 2).meets(followed_backward(end_of(chain), chain, n / 2, n));
}

TEST(ControllableSet, AMoveFromRestToRestNeedsItsLeastTime) {
  for (const double way : {0.3, 1.0, 7.0}) {
    EXPECT_TRUE(can_be_followed(test::point_to_point<2>(way, 2 * std::sqrt(way) * 1.001, 200)));
    EXPECT_FALSE(can_be_followed(test::point_to_point<2>(way, 2 * std::sqrt(way) * 0.999, 200)));
  }
}

TEST(ControllableSet, AgreeWithTheSolutionOfTheChain) {
  Random random(3);
  int followed = 0, not_followed = 0;
  for (int round = 0; round < 200; ++round) {
    Chain<2> chain = test::known_chain<2>(random, 20 + 2 * static_cast<std::size_t>(round)).chain;
    EXPECT_TRUE(can_be_followed(chain)) << round;
    ++followed;
    const double by = random.uniform(0.05, 0.5);
    for (auto& boxes : chain.states)
      if (random.below(4) == 0)
        boxes[0].lowest += by, boxes[0].highest = std::max(boxes[0].highest, boxes[0].lowest + 0.1);
    if (solve(chain, ChainOptions()).excess < 1e-3) continue;
    EXPECT_FALSE(can_be_followed(chain)) << round;
    ++not_followed;
  }
  EXPECT_GT(followed, 100);
  EXPECT_GT(not_followed, 20);
}

TEST(ControllableSet, ConflictsAreWhereTheSolutionHasExcess) {
  Random random(4);
  int without = 0, with = 0;
  for (int round = 0; round < 200; ++round) {
    Chain<2> chain = test::known_chain<2>(random, 40 + 2 * static_cast<std::size_t>(round)).chain;
    EXPECT_TRUE(conflicts(chain, {}).empty()) << round;
    ++without;
    const std::size_t n = chain.cells(), here = n / 2;
    for (std::size_t i = here; i < std::min(here + 5, n); ++i)
      chain.states[i][0] = {chain.states[i][0].lowest + 3, chain.states[i][0].highest + 3};
    if (solve(chain, ChainOptions()).excess < 1e-3) continue;
    const auto found = conflicts(chain, {});
    ASSERT_FALSE(found.empty()) << round;
    ++with;
    for (const auto& [first, last] : found) {
      // Free at both ends it is no easier than a part of the whole.
      Chain<2> part;
      part.begins_at_rest = first == 0 && chain.begins_at_rest;
      part.ends_at_rest = last == n && chain.ends_at_rest;
      part.steps.assign(chain.steps.begin() + static_cast<std::ptrdiff_t>(first),
                        chain.steps.begin() + static_cast<std::ptrdiff_t>(last));
      part.controls.assign(chain.controls.begin() + static_cast<std::ptrdiff_t>(first),
                           chain.controls.begin() + static_cast<std::ptrdiff_t>(last));
      part.states.assign(chain.states.begin() + static_cast<std::ptrdiff_t>(first),
                         chain.states.begin() + static_cast<std::ptrdiff_t>(last) + 1);
      EXPECT_GT(solve(part, ChainOptions()).excess, 0) << round;
      EXPECT_LT(first, here + 5) << round;
      EXPECT_GT(last + 1, here) << round;
    }
  }
  EXPECT_EQ(without, 200);
  EXPECT_GT(with, 20);
}

}  // namespace
}  // namespace bahnwerk
