#include "server/runtime/build_info.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::server {
namespace {

TEST(BuildInfo, NamesVersionCommitAndBuildInOneLine) {
  EXPECT_EQ(to_string({"1.2.3", "abc1234-dirty", "Debug, Clang 15, -O0"}),
            "bahnwerk 1.2.3 (commit abc1234-dirty; Debug, Clang 15, -O0)");
}

}  // namespace
}  // namespace bahnwerk::server
