#include "server/cli/progress_bar.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace bahnwerk::server::cli {
namespace {

TEST(ProgressLine, ShowsTheFraction) {
  EXPECT_EQ(progress_line(0.5, "grid", "", 79), "[############            ]  50 %  grid  ");
  EXPECT_EQ(progress_line(1, "", "", 79), "[########################] 100 %  ");
  EXPECT_EQ(progress_line(std::numeric_limits<double>::quiet_NaN(), "", "", 79), "[                        ]   0 %  ");
  EXPECT_EQ(progress_line(7, "", "", 79), progress_line(1, "", "", 79));
}

TEST(ProgressLine, StaysOnOneLine) {
  EXPECT_EQ(progress_line(0, "a\nb", "\x1b[2J", 79), "[                        ]   0 %  ab  [2J  ");
  EXPECT_EQ(progress_line(0.2, "a long stage", std::string(500, 'x'), 40).size(), 40U);
}

}  // namespace
}  // namespace bahnwerk::server::cli
