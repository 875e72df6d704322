#include "core/redundant/chain/chain.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(Chain, AtRestOnlyThePositionCounts) {
  Chain<3> chain;
  chain.steps = {1, 1};
  EXPECT_TRUE(chain.counts(0, 0));
  EXPECT_FALSE(chain.counts(0, 1));
  EXPECT_TRUE(chain.counts(1, 2));
  EXPECT_FALSE(chain.counts(2, 2));
  chain.begins_at_rest = chain.ends_at_rest = false;
  EXPECT_TRUE(chain.counts(0, 1));
  EXPECT_TRUE(chain.counts(2, 2));
}

}  // namespace
}  // namespace bahnwerk
