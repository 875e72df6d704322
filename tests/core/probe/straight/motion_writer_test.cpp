#include "core/probe/straight/motion_writer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk::probe {
namespace {

TEST(MotionWriter, EachPieceGoesOnWhereTheOneBeforeEnds) {
  const ProbeProblem problem = probe_cases::problem({{1, 2}, {5, 2}}, 0.1);
  MotionWriter writer(problem);
  writer.add(0.5, {4, 0}, {}, {}, {});
  EXPECT_EQ(writer.position(), (Vec{3, 2}));
  const std::array<Vec, 3> coefficients{Vec{99, 99}, Vec{4, 0}, Vec{0, 8}};
  writer.add(0.25, coefficients);
  EXPECT_EQ(writer.time(), 0.75);
  EXPECT_EQ(writer.position(), (Vec{4, 2.5})) << "the constant term is where it is";
  const MotionWriter::State end = writer.carry();
  EXPECT_EQ(end.x, writer.position());
  EXPECT_EQ(end.v, (Vec{4, 4}));
  EXPECT_EQ(end.a, (Vec{0, 16}));
  writer.phase(ProbePhaseKind::hold, 0, 0.75, 0);
  const ProbeMotion motion = writer.finish();
  EXPECT_EQ(motion.times, (std::vector<double>{0, 0.75}));
  ASSERT_EQ(motion.motion->pieces(), 2u);
  EXPECT_EQ(motion.motion->evaluate(0.25)[0][0], 2);
  EXPECT_EQ(motion.motion->duration(), 0.75);
  EXPECT_EQ(motion.phases.size(), 1u);
}

TEST(MotionWriter, APieceThatIsLostInTheTimesRoundingIsNoPiece) {
  const ProbeProblem problem = probe_cases::problem({{0, 0}, {1, 0}}, 0);
  MotionWriter writer(problem);
  writer.add(1000, {1e-3, 0}, {}, {}, {});
  writer.add(1e-14, {1, 0}, {}, {}, {});
  writer.add(0, {1, 0}, {}, {}, {});
  EXPECT_EQ(writer.time(), 1000);
  EXPECT_EQ(writer.finish().motion->pieces(), 1u);
}

TEST(MotionWriter, TimesAddUpAsIfTheyWereNotRounded) {
  const ProbeProblem problem = probe_cases::problem({{0, 0}, {1, 0}}, 0);
  MotionWriter writer(problem);
  for (int i = 0; i < 100000; ++i) writer.add(0.1, {}, {}, {}, {});
  EXPECT_NEAR(writer.time(), 10000, 2e-12);
}

TEST(MotionWriter, DurationsOfCarriedPiecesSumUpToTheTime) {
  const ProbeProblem p = probe_cases::problem({{0, 0}, {1, 0}}, 0.05);
  MotionWriter writer(p);
  for (int i = 0; i < 20000; ++i) {
    writer.add(0.1 / 3 + 1e-3 * (i % 7), {1e-3, 0, 0}, {}, {}, {});
    if (i % 2 == 0) writer.carry();
  }
  const ProbeMotion motion = writer.finish();
  TimeSum sum;
  for (const double duration : motion.durations) sum.add(duration);
  EXPECT_NEAR(sum.value(), motion.duration(), 2.5e-16 * motion.duration());
  EXPECT_GT(motion.duration(), 700);
}

TEST(MotionWriter, OnlyRoundingIsPutRight) {
  const ProbeProblem problem = probe_cases::problem({{0, 0}, {0.3, 0}}, 0);
  MotionWriter writer(problem);
  for (int i = 0; i < 3; ++i) writer.add(1, {0.1, 0}, {}, {}, {});
  EXPECT_NE(writer.position().x, 0.3);
  writer.aim({0.3, 0});
  EXPECT_EQ(writer.position().x, 0.3);
  writer.aim({0.3001, 0});
  EXPECT_EQ(writer.position().x, 0.3);
}

}  // namespace
}  // namespace bahnwerk::probe
