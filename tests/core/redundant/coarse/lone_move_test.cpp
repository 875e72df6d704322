#include "core/redundant/coarse/lone_move.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/motion/axes/spline_motion.hpp"
#include "core/motion/law/path_motion.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"

namespace bahnwerk {
namespace {

LoneMove move_of(const Contour& contour, const CoarseFineMachine& machine) {
  const JointTask task = test::joint_task(contour, machine);
  return lone_move(*task.path, machine, task.feeds.front()).value();
}

double lasts(const CoarseFineMachine& machine, double dx, double dy, double feed = unlimited) {
  return move_of(test::straight(dx, dy, feed), machine).head.duration();
}

/// Coarse axes, strokes and fine axes at many times, and where the pieces meet.
void expect_held(const Contour& contour, const CoarseFineMachine& machine) {
  const JointTask task = test::joint_task(contour, machine);
  LoneMove move = lone_move(*task.path, machine, task.feeds.front()).value();
  const PathMotion head(task.path, move.head);
  const SplineMotion coarse(move.coarse);
  ASSERT_EQ(head.pieces(), coarse.pieces());
  ASSERT_EQ(head.duration(), coarse.duration());
  for (std::size_t i = 0; i < head.pieces(); ++i)
    for (int n = 0; n <= 8; ++n) {
      const double t = head.begin(i) + (head.end(i) - head.begin(i)) * n / 8;
      const MotionState x = head.in_piece(i, t), c = coarse.in_piece(i, t);
      EXPECT_LE(head.along(i, t).v, task.feeds.front() * (1 + 1e-9));
      for (std::size_t k = 0; k < machine.axes.size(); ++k) {
        const CoarseFineAxis& a = machine.axes[k];
        EXPECT_LE(std::abs(x[0][k] - c[0][k]), a.stroke * (1 + 1e-9) + 1e-9);
        EXPECT_LE(std::abs(c[1][k]), a.coarse.velocity * (1 + 1e-9));
        EXPECT_LE(std::abs(c[2][k]), a.coarse.acceleration * (1 + 1e-9));
        EXPECT_LE(std::abs(x[1][k] - c[1][k]), a.fine.velocity * (1 + 1e-9) + 1e-9);
        EXPECT_LE(std::abs(x[2][k] - c[2][k]), a.fine.acceleration * (1 + 1e-9) + 1e-6);
        EXPECT_LE(std::abs(c[3][k]), a.coarse.jerk * (1 + 1e-6));
        EXPECT_LE(std::abs(x[3][k] - c[3][k]), a.fine.jerk * (1 + 1e-6) + 1);
      }
    }
  const MotionState end = coarse.in_piece(head.pieces() - 1, head.duration());
  for (std::size_t k = 0; k < machine.axes.size(); ++k) {
    EXPECT_NEAR(end[1][k], 0, 1e-11 * machine.axes[k].coarse.velocity);
    if (machine.limited_order() == 3) {
      EXPECT_NEAR(end[2][k], 0, 1e-14 * machine.axes[k].coarse.acceleration);
    }
  }
  for (std::size_t i = 1; i < head.pieces(); ++i) {
    const double t = head.begin(i), places = 1e-14 * contour.path.length();
    for (const Motion* motion : {static_cast<const Motion*>(&head), static_cast<const Motion*>(&coarse)}) {
      const MotionState before = motion->in_piece(i - 1, t), after = motion->in_piece(i, t);
      for (std::size_t k = 0; k < machine.axes.size(); ++k) {
        EXPECT_NEAR(before[0][k], after[0][k], places);
        EXPECT_NEAR(before[1][k], after[1][k], 1e-11 * machine.axes[k].coarse.velocity);
      }
    }
  }
  EXPECT_NEAR(head.along(head.pieces() - 1, head.duration()).v, 0, 1e-7);
  EXPECT_NEAR(move.head.pieces().back().s_end, contour.path.length(), 1e-9);
}

TEST(LoneMove, TakesWhatTheCoarseAxesNeedForAllButTwoStrokes) {
  CoarseFineMachine machine = test::md1();
  for (CoarseFineAxis& axis : machine.axes) axis.stroke = 15;
  EXPECT_NEAR(lasts(machine, 290, 0), 2 * std::sqrt(260.0 / 8000), 1e-9);
  EXPECT_NEAR(lasts(machine, 1030, 0), 1000.0 / 1600 + 1600.0 / 8000, 1e-9);
  for (CoarseFineAxis& axis : machine.axes) axis = coarse_alone(axis);
  EXPECT_NEAR(lasts(machine, 290, 0), 2 * std::sqrt(290.0 / 8000), 1e-9);
}

/// A slow feed, with strokes that the push to it uses in part, in full, and not at all.
TEST(LoneMove, HoldsASlowFeedWithEveryStroke) {
  double before = HUGE_VAL;
  for (const double stroke : {0.0, 0.5, 5.0, 15.0, 17.5, 19.0, 19.99, 20.0, 22.0, 30.0, 60.0}) {
    SCOPED_TRACE(stroke);
    const CoarseFineAxis axis{"x", {1800, 16000, 3418851.8}, {2000, 60000, 15370936.3}, stroke};
    CoarseFineMachine machine{{axis, axis}, 0.001};
    machine.axes[1].name = "y";
    const Contour contour = test::straight(48.2996, 48.2996, 19.446867615109927);
    expect_held(contour, machine);
    const double now = move_of(contour, machine).head.duration();
    EXPECT_LE(now, before * (1 + 1e-9));
    before = now;
  }
}

/// Positions of some metres are rounded to 1e-12 mm and a little: a stroke of 1 µm has to leave that open.
TEST(LoneMove, HoldsAStrokeOfAMicrometreFarFromTheOrigin) {
  CoarseFineMachine machine = test::md2();
  for (CoarseFineAxis& axis : machine.axes) axis.stroke = 0.001;
  ContourBuilder b(2, {38.267, 18.454, 0});
  b.block(Mode::cut, 78);
  b.line({2624.3615, 18.454, 0});
  const Contour contour = b.finish();
  machine = test::with_jerk(machine, 30);
  const JointTask task = test::joint_task(contour, machine);
  LoneMove move = lone_move(*task.path, machine, task.feeds.front()).value();
  const PathMotion head(task.path, move.head);
  const SplineMotion coarse(move.coarse);
  for (std::size_t i = 0; i < head.pieces(); ++i)
    for (int n = 0; n <= 4000; ++n) {
      const double t = head.begin(i) + (head.end(i) - head.begin(i)) * n / 4000;
      ASSERT_LE(std::abs(head.in_piece(i, t)[0][0] - coarse.in_piece(i, t)[0][0]), 0.001) << t;
    }
}

/// With strokes that do not matter both drive as hard as they can all the time.
TEST(LoneMove, TakesWhatBothNeedTogetherWithinTheStroke) {
  EXPECT_NEAR(lasts(test::md1(), 30, 0), 2 * std::sqrt(30.0 / 68000), 1e-9);
  EXPECT_NEAR(lasts(test::md1(), 0, -30), 2 * std::sqrt(30.0 / 68000), 1e-9);
  const double rate = std::sqrt(0.5);
  EXPECT_NEAR(lasts(test::md1(), 20, 20), 2 * std::sqrt(20 / rate / (68000 / rate)), 1e-9);
}

/// s = J T³/32 from rest to rest.
TEST(LoneMove, KnowsTheJerk) {
  CoarseFineMachine machine = test::with_jerk(test::md2(), 20);
  for (CoarseFineAxis& axis : machine.axes) axis.stroke = 4;
  EXPECT_NEAR(lasts(machine, 48, 0), std::cbrt(32 * 40 / (20 * 16000.0)), 1e-8);
}

/// 100 mm at 400 mm/s: without fine axes 100/400 + 400/16000. Two pushes of 1 mm leave 98 mm to the feed; the fine axes
/// go back by 1 mm between them. With more stroke than the pushes need both accelerate together, and with jerk a push
/// is an eighth of the feed times the time of the change of speed.
TEST(LoneMove, IsPushedToItsFeedAtBothEnds) {
  CoarseFineMachine machine = test::md2();
  for (CoarseFineAxis& axis : machine.axes) axis.stroke = 0.5;
  EXPECT_NEAR(lasts(machine, 100, 0, 400), 98.0 / 400 + 400.0 / 16000, 1e-9);
  EXPECT_NEAR(lasts(machine, 0, -100, 400), 98.0 / 400 + 400.0 / 16000, 1e-9);
  expect_held(test::straight(60, -80, 400), machine);
  EXPECT_NEAR(lasts(test::md2(), 100, 0, 400), 100.0 / 400 + 400.0 / 76000, 1e-9);
  machine = test::with_jerk(machine, 20);
  EXPECT_NEAR(lasts(machine, 100, 0, 400), 98.0 / 400 + 2 * std::sqrt(400 / (20 * 16000.0)), 1e-9);
  expect_held(test::straight(100, 0, 400), machine);
}

/// Moves whose feed is what counts, with strokes about as long as what the coarse axes need to get to it.
TEST(LoneMove, HoldsEveryLimitAtAFeed) {
  Random random(353);
  for (int i = 0; i < 60; ++i) {
    CoarseFineMachine machine = i % 2 == 0 ? test::md1() : test::md2();
    const double feed = std::pow(10, random.uniform(1, 3.2)), reach = feed * feed / 16000;
    for (CoarseFineAxis& axis : machine.axes) {
      axis.stroke = reach * std::pow(10, random.uniform(-2, 0.5));
      axis.fine.acceleration = std::pow(10, random.uniform(3.5, 5.5));
      axis.fine.velocity = random.uniform(50, 3000);
    }
    if (i % 3 == 0) machine = test::with_jerk(machine, random.uniform(20, 300));
    const double way = 2 * reach * std::pow(10, random.uniform(-0.3, 1)), angle = random.uniform(0, 6.28);
    const Contour contour = test::straight(way * std::cos(angle), way * std::sin(angle), feed);
    expect_held(contour, machine);
    double before = unlimited;
    for (const double more : {0.25, 0.5, 0.9, 1.0, 1.5, 4.0}) {
      CoarseFineMachine other = machine;
      for (CoarseFineAxis& axis : other.axes) axis.stroke *= more;
      const double now = move_of(contour, other).head.duration();
      EXPECT_LE(now, before * (1 + 1e-8)) << "stroke times " << more << " at feed " << feed;
      before = now;
    }
  }
}

TEST(LoneMove, HoldsEveryLimit) {
  Random random(351);
  for (int i = 0; i < 60; ++i) {
    CoarseFineMachine machine = i % 2 == 0 ? test::md1() : test::md2();
    for (CoarseFineAxis& axis : machine.axes) {
      axis.stroke = std::pow(10, random.uniform(-3, 2.7));
      axis.fine.velocity = random.uniform(500, 3000);
      if (i % 5 == 0 && axis.name == "y") axis = coarse_alone(axis);
    }
    if (i % 3 == 0) machine = test::with_jerk(machine, random.uniform(20, 300));
    const double way = std::pow(10, random.uniform(0, 3.4)), angle = random.uniform(0, 6.28);
    expect_held(
        test::straight(way * std::cos(angle), way * std::sin(angle), i % 4 == 0 ? random.uniform(50, 2000) : unlimited),
        machine);
  }
}

TEST(LoneMove, MoreOfAnythingIsNeverSlower) {
  Random random(352);
  for (int i = 0; i < 60; ++i) {
    CoarseFineMachine machine = i % 2 == 0 ? test::md1() : test::md2();
    if (i % 3 == 0) machine = test::with_jerk(machine, random.uniform(20, 300));
    const double way = std::pow(10, random.uniform(0, 3.4)), angle = random.uniform(0, 6.28);
    const double feed = i % 4 == 0 ? random.uniform(50, 2000) : unlimited;
    const auto time = [&](const CoarseFineMachine& m) {
      return lasts(m, way * std::cos(angle), way * std::sin(angle), feed);
    };
    double before = 1e9;
    for (const double stroke : {0.0, 0.001, 0.3, 2.0, 9.0, 30.0, 31.0, 120.0, 500.0}) {
      CoarseFineMachine other = machine;
      for (CoarseFineAxis& axis : other.axes) {
        axis.stroke = stroke;
        if (!(stroke > 0)) axis = coarse_alone(axis);
      }
      const double now = time(other);
      EXPECT_LE(now, before * (1 + 1e-8)) << "stroke " << stroke << " way " << way << " feed " << feed;
      before = now;
    }
    for (Limits CoarseFineAxis::*stage : {&CoarseFineAxis::coarse, &CoarseFineAxis::fine}) {
      before = 1e9;
      for (const double factor : {0.25, 0.5, 0.8, 1.0, 1.5, 2.0}) {
        CoarseFineMachine other = machine;
        for (CoarseFineAxis& axis : other.axes) (axis.*stage).acceleration *= factor;
        const double now = time(other);
        EXPECT_LE(now, before * (1 + 1e-8)) << "acceleration " << factor << " way " << way << " feed " << feed;
        before = now;
      }
    }
  }
}

TEST(LoneMove, IsOneStraightSegment) {
  const JointTask task = test::joint_task(test::slot(20, 5, 100), test::md1());
  EXPECT_FALSE(lone_move(*task.path, task.machine, 100));
}

}  // namespace
}  // namespace bahnwerk
