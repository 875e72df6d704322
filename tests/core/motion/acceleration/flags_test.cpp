#include "core/motion/acceleration/flags.hpp"

#include <gtest/gtest.h>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

TEST(CellFlags, AreFoundInBothDirections) {
  Random random(4);
  for (const std::size_t n : {0, 1, 7, 8, 9, 64, 100})
    for (const double share : {0.0, 0.03, 0.5, 1.0}) {
      CellFlags flags(n);
      for (auto& flag : flags) flag = random.uniform(0, 1) < share ? 1 : 0;
      for (std::size_t at = 0; at <= n; ++at) {
        std::size_t ahead = at, behind = at;
        while (ahead < n && flags[ahead] == 0) ++ahead;
        while (behind > 0 && flags[behind - 1] == 0) --behind;
        EXPECT_EQ(first_set(flags, at), ahead < n ? ahead : no_flag);
        EXPECT_EQ(last_set(flags, at), behind > 0 ? behind - 1 : no_flag);
      }
    }
}

}  // namespace
}  // namespace bahnwerk
