#include "core/probe/probe_motion.hpp"

#include <gtest/gtest.h>

namespace bahnwerk {
namespace {

ProbeMotion two_pieces() {
  ProbeMotion m;
  m.motion = std::make_shared<const SplineMotion>(
      std::vector<SplineMotion::Piece>{{0.5, {{0, 1, 2, 3}, {1, 0, 0, 0, 4}}}, {2, {{1, 2}, {3, 1, 1}}}});
  m.times = {0, 0.75, 2};
  m.phases = {{ProbePhaseKind::accelerate, 0, 0.5, 0}, {ProbePhaseKind::turn, 0.5, 2, 1}};
  return m;
}

TEST(ProbeMotion, SlowedKeepsThePathAndDividesDerivatives) {
  const ProbeMotion m = two_pieces(), s = slowed(m, 2);
  EXPECT_EQ(s.duration(), 4);
  EXPECT_EQ(s.times, (std::vector<double>{0, 1.5, 4}));
  EXPECT_EQ(s.phases[1].begin, 1);
  EXPECT_EQ(s.phases[1].end, 4);
  for (const double t : {0.0, 0.3, 0.49, 0.5, 1.1, 2.0}) {
    const MotionState a = m.motion->evaluate(t), b = s.motion->evaluate(2 * t);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_DOUBLE_EQ(b.position[k], a.position[k]);
      EXPECT_DOUBLE_EQ(b.velocity[k], a.velocity[k] / 2);
      EXPECT_DOUBLE_EQ(b.acceleration[k], a.acceleration[k] / 4);
      EXPECT_DOUBLE_EQ(b.jerk[k], a.jerk[k] / 8);
      EXPECT_DOUBLE_EQ(b.snap[k], a.snap[k] / 16);
    }
  }
}

TEST(ProbeMotion, SlowedEndsExactlyWhereItIsTold) {
  const ProbeMotion s = slowed(two_pieces(), 1.05, 2.1);
  EXPECT_EQ(s.duration(), 2.1);
  EXPECT_EQ(s.times.back(), 2.1);
}

}  // namespace
}  // namespace bahnwerk
