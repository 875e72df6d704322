#include "server/runtime/descriptors.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace bahnwerk::server {
namespace {

TEST(Descriptors, TheLimitIsRaisedAsFarAsTheSystemAllowsAndNeverLowered) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  rlimit low = before;
  low.rlim_cur = 64;
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &low), 0);
  EXPECT_EQ(raise_descriptors(32), 64u) << "more than wanted stays";
  EXPECT_EQ(raise_descriptors(80), 80u);
  rlimit now{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &now), 0);
  EXPECT_EQ(now.rlim_cur, 80u);
  EXPECT_EQ(now.rlim_max, before.rlim_max);
  if (before.rlim_max != RLIM_INFINITY) {
    EXPECT_EQ(raise_descriptors(before.rlim_max + 1), before.rlim_max);
  }
  ::setrlimit(RLIMIT_NOFILE, &before);
}

}  // namespace
}  // namespace bahnwerk::server
