#include "core/probe/straight/motion_writer.hpp"

#include "tests/core/probe/probe_cases.hpp"

namespace bahnwerk {
namespace {

using namespace probe_cases;

TEST(MotionWriter, DurationsOfCarriedPiecesSumUpToTheTime) {
  const ProbeProblem p = problem({{0, 0}, {1, 0}}, 0.05);
  probe::MotionWriter writer(p);
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

TEST(MotionWriter, PiecesContinueWhereTheOneBeforeEnds) {
  const ProbeProblem p = problem({{2, 3}, {4, 3}}, 0.05);
  probe::MotionWriter writer(p);
  writer.add(0.5, {4, 0, 0}, {}, {}, {});
  EXPECT_EQ(writer.position(), (Vec{4, 3, 0}));
  const probe::MotionWriter::State state = writer.carry();
  EXPECT_EQ(state.v, (Vec{4, 0, 0}));
  writer.add(1e-20, {4, 0, 0}, {}, {}, {});  // lost in the rounding of the time
  EXPECT_EQ(writer.finish().motion->pieces(), 1u);
}

}  // namespace
}  // namespace bahnwerk
