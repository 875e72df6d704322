#include "core/motion/acceleration/law_writer.hpp"

#include <gtest/gtest.h>

#include "core/geometry/curve/line.hpp"

namespace bahnwerk {
namespace {

Path line_of(double length) {
  Path path;
  path.append(std::make_shared<Line>(Vec{0, 0, 0}, Vec{length, 0, 0}), 0);
  return path;
}

TEST(LawWriter, AStraightPartAcceleratesHoldsAndBrakes) {
  const Path path = line_of(10);
  TimeLaw law;
  LawWriter(law, path).straight(0, {0, 0}, {10, 4}, 2, 16);  // from rest to 2 mm/s, at most 4 mm/s, 2 mm/s²
  ASSERT_EQ(law.pieces().size(), 3u);
  EXPECT_DOUBLE_EQ(law.pieces()[0].duration, 2);        // 4 mm
  EXPECT_DOUBLE_EQ(law.pieces()[1].duration, 3.0 / 4);  // 3 mm
  EXPECT_DOUBLE_EQ(law.pieces()[2].duration, 1);        // 3 mm
  EXPECT_DOUBLE_EQ(law.pieces()[1].s, 4);
  EXPECT_DOUBLE_EQ(law.pieces()[2].s, 7);
  EXPECT_EQ(law.pieces()[2].a, -2);
  EXPECT_EQ(law.pieces()[2].s_end, 10);
}

TEST(LawWriter, AShortPartHasNoHold) {
  const Path path = line_of(1);
  TimeLaw law;
  LawWriter(law, path).straight(0, {0, 0}, {1, 0}, 4, 100);
  ASSERT_EQ(law.pieces().size(), 2u);
  EXPECT_DOUBLE_EQ(law.duration(), 1);  // twice √(2 · 0.5/4)
  EXPECT_DOUBLE_EQ(law.pieces()[1].v, 2);
  EXPECT_DOUBLE_EQ(law.pieces()[1].s, 0.5);
}

TEST(LawWriter, ASlowFeedIsReachedWithinNanometresFarAlongThePath) {
  const Path path = line_of(1e6);
  TimeLaw law;
  constexpr double v = 1e-3, a = 1e4;
  LawWriter(law, path).straight(0, {9e5, 0}, {9e5 + 1, 0}, a, v * v);
  ASSERT_EQ(law.pieces().size(), 3u);
  EXPECT_NEAR(law.pieces()[0].duration, v / a, 1e-12 * v / a);
  EXPECT_NEAR(law.pieces()[1].duration, (1 - v * v / a) / v, 1e-9);
}

}  // namespace
}  // namespace bahnwerk
