// Windows of long problems: all steps once, the window before again where one fails.
#include "core/numeric/windows.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

TEST(Windows, KeepEveryStepOnceAndNoShortRest) {
  const WindowLengths lengths{100, 20, 130};
  for (const std::size_t n : {1, 100, 130, 131, 1000, 1029, 1031}) {
    std::size_t kept = 0;
    const std::size_t reached = solve_windows(std::size_t{0}, n, [&](std::size_t begin, auto*) {
      const Window window = lengths.at(begin, n);
      EXPECT_EQ(window.begin, kept);
      EXPECT_EQ(window.end, std::min(window.keep + (window.keep < n ? lengths.ahead : 0), n));
      EXPECT_GT(window.keep - window.begin, std::min<std::size_t>(30, n - 1));
      EXPECT_LE(window.end - window.begin, lengths.whole);
      return kept = window.keep;
    });
    EXPECT_EQ(reached, n);
    EXPECT_EQ(kept, n);
  }
}

struct Begin {
  double begin;
  int length;
  std::size_t solved;  // windows kept before
};

TEST(Windows, SolveTheWindowBeforeAgainWhereOneFails) {
  // Windows that begin at 2 fail unless they are 3 long.
  std::vector<double> begins;
  const Begin reached = solve_windows(Begin{0, 1, 0}, 6.0, [&](Begin& here, Begin* before) -> WindowResult<Begin> {
    begins.resize(here.solved);
    if (here.begin == 2) {
      EXPECT_EQ(before->begin, 1);
      before->length = 3;
      return WindowRetry::before;
    }
    begins.push_back(here.begin);
    return Begin{here.begin + here.length, 1, begins.size()};
  });
  EXPECT_EQ(reached.begin, 6);
  EXPECT_EQ(begins, (std::vector<double>{0, 1, 4, 5}));
}

TEST(Windows, SolveTheSameAgainIfThereIsNoneBefore) {
  int tries = 0;
  const Begin reached =
      solve_windows(Begin{0, 1, 0}, 2.0, [&](Begin& here, const Begin* before) -> WindowResult<Begin> {
        EXPECT_EQ(before, nullptr);
        if (++tries < 3) return tries == 1 ? WindowRetry::same : WindowRetry::before;
        return Begin{here.begin + 2, 1, 1};
      });
  EXPECT_EQ(tries, 3);
  EXPECT_EQ(reached.begin, 2);
}

TEST(Windows, ReturnWhereTheFirstOneFails) {
  const std::size_t reached =
      solve_windows(std::size_t{0}, std::size_t{9}, [](std::size_t begin, auto*) -> WindowResult<std::size_t> {
        if (begin >= 4) return WindowRetry::none;
        return begin + 2;
      });
  EXPECT_EQ(reached, 4u);
}

}  // namespace
}  // namespace bahnwerk
