#include "core/motion/law/dwell.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"
#include "core/motion/law/block_times.hpp"

namespace bahnwerk {
namespace {

/// Two lines of 5 mm with a dwell between them, of 0.5 s, and one of 2 s at the end.
Contour two_lines() {
  ContourBuilder builder(2, {0, 0, 0});
  builder.block(Mode::cut, 50);
  builder.line({5, 0, 0});
  builder.dwell(0.5);
  builder.block(Mode::cut, 50);
  builder.line({5, 5, 0});
  builder.dwell(2);
  return builder.finish();
}

/// From rest to rest over each line: 1 s up, 1 s down, at 5 mm/s².
TimeLaw law() {
  TimeLaw law;
  for (const double s : {0.0, 5.0}) {
    const auto segment = static_cast<std::size_t>(s / 5);
    law.append({0, 1, s, s + 2.5, 0, 5, 0, segment});
    law.append({0, 1, s + 2.5, s + 5, 5, -5, 0, segment});
  }
  return law;
}

TEST(Dwell, EveryRestBecomesAPieceThatStands) {
  const Contour contour = two_lines();
  const CartesianAxisPath path(contour.path, 2);
  Progress progress;
  const Machine machine;
  const TimeLaw with = with_dwells(law(), contour_task(path, contour, machine), progress);
  ASSERT_EQ(with.pieces().size(), 6u);
  EXPECT_DOUBLE_EQ(with.duration(), 4 + 2.5);
  std::vector<bool> standing;
  for (const LawPiece& p : with.pieces()) standing.push_back(dwells(p));
  EXPECT_EQ(standing, (std::vector<bool>{false, false, true, false, false, true}));
  EXPECT_DOUBLE_EQ(with.pieces()[2].duration, 0.5);
  EXPECT_EQ(with.pieces()[2].s, 5);
  EXPECT_DOUBLE_EQ(with.pieces()[3].t0, 2.5);  // what follows is only shifted
  EXPECT_EQ(with.pieces()[3].a, 5);
}

TEST(Dwell, APieceThatStartsFromRestIsNone) {
  EXPECT_FALSE(dwells({0, 1, 0, 2.5, 0, 5, 0, 0}));
  EXPECT_TRUE(dwells({0, 1, 3, 3, 0, 0, 0, 0}));
  EXPECT_FALSE(dwells({0, 1, 3, 4, 1, 0, 0, 0}));
}

}  // namespace
}  // namespace bahnwerk
