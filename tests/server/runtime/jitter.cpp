#include "server/runtime/jitter.hpp"

#include <gtest/gtest.h>

#include <set>

namespace bahnwerk::server {
namespace {

using std::chrono::milliseconds;

TEST(Jitter, IsBetweenAHalfAndThreeHalvesAndDiffers) {
  std::set<milliseconds> seen;
  for (int k = 0; k < 1000; ++k) {
    const milliseconds time = jittered(milliseconds(1000));
    ASSERT_GE(time, milliseconds(500));
    ASSERT_LE(time, milliseconds(1500));
    seen.insert(time);
  }
  EXPECT_GT(seen.size(), 100U);
}

}  // namespace
}  // namespace bahnwerk::server
