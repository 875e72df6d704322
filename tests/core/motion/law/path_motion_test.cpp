#include "core/motion/law/path_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/geometry/curve/arc.hpp"

namespace bahnwerk {
namespace {

constexpr double radius = 5, length = radius * std::numbers::pi / 2;

/// A quarter of a circle from rest to rest with |a| = length in two seconds.
std::shared_ptr<const PathMotion> quarter_circle() {
  const auto tool = std::make_shared<Path>();
  tool->append(std::make_shared<Arc>(Arc::through({radius, 0, 0}, {0, radius, 0}, {0, 0, 0}, {0, 0, 1}, true)), 0);
  TimeLaw law;
  law.append({0, 1, 0, length / 2, 0, length, 0, 0});
  law.append({0, 1, length / 2, length, length, -length, 0, 0});
  return std::make_shared<const PathMotion>(std::make_shared<CartesianAxisPath>(tool, 2), law);
}

TEST(PathMotion, OnACircleTheAccelerationHasATangentialAndACentripetalPart) {
  const auto motion = quarter_circle();
  for (const double t : {0.2, 0.7, 1.0, 1.6}) {
    const double v = t <= 1 ? length * t : length * (2 - t), a = t < 1 ? length : -length;
    const double s = t <= 1 ? length * t * t / 2 : length - length * (2 - t) * (2 - t) / 2, angle = s / radius;
    const std::size_t piece = t < 1 ? 0 : 1;
    const MotionState x = motion->in_piece(piece, t);
    EXPECT_NEAR(x[0][0], radius * std::cos(angle), 1e-9);
    EXPECT_NEAR(x[1][1], v * std::cos(angle), 1e-9);
    EXPECT_NEAR(x[2][0], -a * std::sin(angle) - v * v / radius * std::cos(angle), 1e-8);
    EXPECT_NEAR(x[2][1], a * std::cos(angle) - v * v / radius * std::sin(angle), 1e-8);
    double written[6];
    motion->write_driven(piece, motion->along(piece, t), written);
    EXPECT_NEAR(written[0], x[0][0], 1e-12);
    EXPECT_NEAR(written[3], x[1][1], 1e-12);
    EXPECT_NEAR(written[5], x[2][1], 1e-12);
  }
}

TEST(PathMotion, EndsAtRestExactlyAtTheEndOfThePath) {
  const auto motion = quarter_circle();
  EXPECT_EQ(motion->duration(), 2);
  EXPECT_EQ(motion->pieces(), 2u);
  const MotionState end = motion->final_state();
  EXPECT_NEAR(end[0][0], 0, 1e-14);
  EXPECT_EQ(end[0][1], radius);
  EXPECT_EQ(end[1][0], 0);
  EXPECT_EQ(end[2][1], 0);
}

TEST(PathMotion, PlacesStayWithinTheirPiece) {
  const auto motion = quarter_circle();
  EXPECT_EQ(motion->along(0, -1).s, 0);
  EXPECT_EQ(motion->along(0, 5).s, length / 2);
  EXPECT_EQ(motion->along(1, 5).s, length);
}

}  // namespace
}  // namespace bahnwerk
