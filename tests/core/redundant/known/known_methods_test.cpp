// The source's known methods: every split is valid, each does what it is known for, none is as fast as the joint plan.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/progress.hpp"
#include "core/motion/law/dwell.hpp"
#include "core/numeric/random.hpp"
#include "core/redundant/known/filters.hpp"
#include "core/redundant/known/follow_up.hpp"
#include "core/redundant/known/geometric.hpp"
#include "core/redundant/known/lag_compensation.hpp"
#include "core/redundant/methods/method_table.hpp"
#include "core/redundant/redundancy.hpp"
#include "tests/core/cases.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"
#include "tests/core/redundant/frames.hpp"
#include "tests/core/redundant/split_excess.hpp"

namespace bahnwerk {
namespace {

constexpr RedundancyMethod known[] = {RedundancyMethod::geometric, RedundancyMethod::filter,
                                      RedundancyMethod::follow_up, RedundancyMethod::lag_compensation};

RedundancyResult plan(const RedundancyTask& task, RedundancyMethod method, const RedundancyOptions& options = {}) {
  SilentProgress progress;
  return redundancy_row(method).plan(task, options, progress, 0, 1);
}

void expect_valid(const RedundancyTask& task, const RedundancyResult& r) {
  const test::SplitExcess e = test::split_excess(task, r);
  EXPECT_LE(e.limits, 1e-4);  // what the plan makes up for
  EXPECT_LE(e.jump, 1e-9);
  EXPECT_LE(e.rest, 1e-6);
  EXPECT_LE(e.time, 1e-12 * r.head->duration());
}

TEST(KnownMethods, AreValidAndNoneIsFasterThanTheJointPlan) {
  for (const CoarseFineMachine& machine : {test::md1(), test::md2()}) {
    const RedundancyTask task = test::redundancy_task(test::holes(4, 3, 12, 2), machine);
    const double joint = plan(task, RedundancyMethod::joint).head->duration();
    for (const RedundancyMethod method : known) {
      SCOPED_TRACE(name_of<RedundancyMethod>(method, redundancy_methods));
      const RedundancyResult r = plan(task, method);
      expect_valid(task, r);
      EXPECT_GT(r.head->duration(), joint * (1 - 1e-9));
    }
  }
}

TEST(KnownMethods, FollowingUpTheCoarseAxesStandWhereTheFineOnesCut) {
  const RedundancyTask task = test::redundancy_task(test::holes(3, 2, 60, 5), test::md2());
  const RedundancyResult r = plan(task, RedundancyMethod::follow_up);
  expect_valid(task, r);
  std::size_t cut = 0;
  for (std::size_t i = 0; i < r.head->pieces(); ++i) {
    const LawPiece& p = r.head->law().pieces()[i];
    if (p.segment % 2 == 0 || !(p.duration > 0)) continue;  // a line, then a circle
    const MotionState g = r.coarse->evaluate(p.t0 + 0.5 * p.duration);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(g.velocity[k], 0, 1e-7);
    ++cut;
  }
  EXPECT_GE(cut, 6u);
}

TEST(KnownMethods, FollowingUpTheCoarseAxesAloneCutWhatDoesNotFit) {
  const RedundancyTask task = test::redundancy_task(test::holes(2, 2, 150, 50), test::md2());
  const RedundancyResult r = plan(task, RedundancyMethod::follow_up);
  expect_valid(task, r);
  for (double t = 0; t < r.head->duration(); t += 0.001) {
    const double x = r.head->evaluate(t).position[0] - r.coarse->evaluate(t).position[0];
    EXPECT_NEAR(x, 0, 1e-6);
  }
}

TEST(KnownMethods, GeometricallySplitAllAxesStopAtCorners) {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::cut, 400);
  for (const Vec& p : {Vec{30, 0, 0}, Vec{30, 30, 0}, Vec{0, 30, 0}, Vec{5, 5, 0}}) b.line(p);
  const RedundancyTask task = test::redundancy_task(b.finish(), test::md2());
  const RedundancyResult r = plan(task, RedundancyMethod::geometric);
  expect_valid(task, r);
  int corners = 0;
  for (std::size_t i = 1; i < r.head->pieces(); ++i) {
    const LawPiece& p = r.head->law().pieces()[i];
    if (p.segment == r.head->law().pieces()[i - 1].segment) continue;
    ++corners;
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(r.coarse->evaluate(p.t0).velocity[k], 0, 1e-6);
  }
  EXPECT_EQ(corners, 3);
}

TEST(KnownMethods, TheCoarseCurveStaysWithinTheStroke) {
  const RedundancyTask task = test::redundancy_task(test::holes(4, 4, 80, 30), test::md2());
  SilentProgress progress;
  const auto curve = coarse_curve(*task.path, task.machine, progress);
  EXPECT_GE(curve->pitch(), 0.98 * 20);
  for (double s = 0; s < task.path->length(); s += 0.1) {
    const std::size_t i = task.path->tool().find(s);
    const AxisJet q = curve->at(i, s, {});
    const AxisArray x = task.path->at(i, s).value;
    for (std::size_t k = 0; k < 2; ++k) ASSERT_LE(std::abs(x[k] - q.value[k]), 20) << s;
    if (s > 1 && s + 1 < task.path->length()) {  // derivatives
      const AxisJet more = curve->at(i, s + 1e-4, {}), less = curve->at(i, s - 1e-4, {});
      for (std::size_t k = 0; k < 2; ++k) {
        ASSERT_NEAR(q.d1[k], (more.value[k] - less.value[k]) / 2e-4, 1e-6);
        ASSERT_NEAR(q.d2[k], (more.d1[k] - less.d1[k]) / 2e-4, 1e-5);
        ASSERT_LE(std::abs(q.d1[k]), 1 + 1e-12);
      }
    }
  }
}

/// [Bock 3.3]: the filter makes the motion longer by twice its group delay, and in that time the head stands.
TEST(KnownMethods, AFilterMakesTheHeadWaitForItsGroupDelayAtBothEnds) {
  const RedundancyTask task = test::redundancy_task(test::holes(2, 2, 12, 2), test::md2());
  RedundancyOptions options;
  for (const std::size_t taps : {31u, 61u}) {
    options.taps = taps;
    const RedundancyResult r = plan(task, RedundancyMethod::filter, options);
    expect_valid(task, r);
    const double delay = 0.001 * static_cast<double>(taps - 1) / 2, T = r.head->duration();
    for (const double at : {0.0, 0.5, 0.99}) {
      EXPECT_EQ(r.head->evaluate(at * delay).velocity[0], 0);
      EXPECT_EQ(r.head->evaluate(T - at * delay).velocity[0], 0);
    }
    EXPECT_GT(std::abs(r.coarse->evaluate(0.99 * delay).velocity[0]), 0);
  }
}

TEST(KnownMethods, OvershootAndCirclesOfTheCompensatedLag) {
  for (const double fine : {0.001, 0.004, 0.015}) {
    const double coarse = 0.02;
    double most = 0;  // of 1 − e(t), e as in the corrected step response
    for (double t = 0; t < 0.5; t += 1e-6)
      most = std::fmax(most, (fine * std::exp(-t / coarse) - coarse * std::exp(-t / fine)) / (coarse - fine));
    EXPECT_NEAR(step_overshoot(coarse, fine), most, 1e-9);
    EXPECT_GT(circle_gain(coarse, fine, 40, false), 1);
    EXPECT_LT(circle_gain(coarse, fine, 40, true), 1);
    EXPECT_NEAR(circle_gain(coarse, fine, 40, true), 1 / std::hypot(1, 40 * fine), 1e-15);
  }
}

/// The simulated tool goes round a circle as its transfer function says.
TEST(KnownMethods, ASimulatedCircleGrowsByTheGainOfTheTransferFunction) {
  ContourBuilder b(2, {10, 0, 0});
  b.block(Mode::cut, 300);
  for (int i = 0; i < 6; ++i) b.arc({10, 0, 0}, {0, 0, 0}, true);
  const RedundancyTask task = test::redundancy_task(b.finish(), test::md2());
  const RedundancyResult r = plan(task, RedundancyMethod::lag_compensation);
  expect_valid(task, r);
  ASSERT_EQ(r.lags.size(), 2u);
  const double grown = 10 * (circle_gain(0.02, 0.002, 30, false) - 1),
               shrunk = 10 * (1 - circle_gain(0.02, 0.002, 30, true));
  EXPECT_GE(r.lags[0].contour_error, grown * 0.99);
  EXPECT_GE(r.lags[1].contour_error, shrunk * 0.99);
  EXPECT_LT(r.lags[1].contour_error, r.lags[0].contour_error);
}

/// [Bock chapter 5]: never longer, and what the source's methods leave is found.
TEST(KnownMethods, RetimedTheyAreValidAndShorter) {
  for (const CoarseFineMachine& machine : {test::md1(), test::md2()}) {
    const RedundancyTask task = test::redundancy_task(test::holes(4, 3, 12, 2), machine);
    RedundancyOptions options;
    options.reparametrise = true;
    SilentProgress progress;
    for (const RedundancyMethod method : known) {
      SCOPED_TRACE(name_of<RedundancyMethod>(method, redundancy_methods));
      const RedundancyResult before = plan(task, method);
      options.method = method;
      const RedundancyResult after = plan_redundant(task, options, progress);
      expect_valid(task, after);
      EXPECT_LE(after.head->duration(), before.head->duration());
      // The filters' reference limits were lowered for the worst place, and hold elsewhere, too.
      if (method == RedundancyMethod::filter || method == RedundancyMethod::lag_compensation) {
        EXPECT_LT(after.head->duration(), 0.9 * before.head->duration());
      }
    }
  }
}

/// Dwells stay pieces of their own, and the head comes to rest exactly, however short the last way is.
TEST(KnownMethods, RetimedMotionsRestWhereTheyDid) {
  Random random(16);
  for (int n = 0; n < 4; ++n) {
    SCOPED_TRACE(n);
    const Contour contour = test::random_contour(random, 60, 4, 4);
    const RedundancyTask task = test::redundancy_task(contour, n % 2 ? test::md1() : test::md2());
    RedundancyOptions options;
    options.method = RedundancyMethod::filter;  // the head also waits at both ends
    options.reparametrise = true;
    SilentProgress progress;
    const RedundancyResult r = plan_redundant(task, options, progress);
    std::size_t dwelt = 0, lasting = 0;
    for (const Rest& rest : contour.rests) lasting += rest.seconds > 0;
    const auto& pieces = r.head->law().pieces();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      dwelt += dwells(pieces[i]);
      const bool stops = i + 1 == pieces.size() || pieces[i + 1].v == 0;
      const LawPiece& p = pieces[i];
      const LawState end = p.at(p.duration);
      if (stops) {
        EXPECT_LE(std::abs(end.v), 1e-14 * (p.v + (std::abs(p.a) + std::abs(end.a)) * p.duration)) << i;
      }
    }
    EXPECT_EQ(dwelt, lasting + 2);
  }
}

TEST(KnownMethods, RandomContoursAreValid) {
  Random random(11);
  std::map<RedundancyMethod, double> total;  // times the fastest motion of the head
  const int contours = testing::cases(20);
  for (int n = 0; n < contours; ++n) {
    const Contour contour = test::random_contour(random, 100, 2, 5);
    const RedundancyTask task = test::redundancy_task(contour, random.below(2) ? test::md1() : test::md2());
    for (const RedundancyMethod method : known) {
      SCOPED_TRACE(std::to_string(n) + std::string(" ") +
                   std::string(name_of<RedundancyMethod>(method, redundancy_methods)));
      const RedundancyResult r = plan(task, method);
      expect_valid(task, r);
      EXPECT_GE(r.head->duration(), r.fastest * (1 - 1e-9));
      total[method] += r.head->duration() / r.fastest;
    }
  }
  // What each costs in the mean: the head waits for nothing, for the filter's blocks, for the coarse axes' lag.
  EXPECT_NEAR(total[RedundancyMethod::geometric], contours, 1e-6 * contours);
  EXPECT_NEAR(total[RedundancyMethod::follow_up], contours, 1e-6 * contours);
  EXPECT_LT(total[RedundancyMethod::filter], 1.8 * contours);
  EXPECT_LT(total[RedundancyMethod::lag_compensation], 2.2 * contours);
}

/// Along a straight tool path the coarse curve is slow at both ends and as quick as the tool between them.
TEST(KnownMethods, GeometricallySplitStraightMovesAreQuickerThanTheCoarseAxesAlone) {
  for (const CoarseFineMachine& machine : {test::md1(), test::md2()})
    for (const double length : {7.0, 90.0, 310.0, 620.0, 1900.0}) {
      SCOPED_TRACE(length);
      const RedundancyTask task = test::redundancy_task(test::straight(length, 0), machine);
      const RedundancyResult r = plan(task, RedundancyMethod::geometric);
      expect_valid(task, r);
      const double V = machine.axes[0].coarse.velocity, A = machine.axes[0].coarse.acceleration;
      EXPECT_LT(r.head->duration(), length > V * V / A ? length / V + V / A : 2 * std::sqrt(length / A));
    }
}

TEST(KnownMethods, PlansDoNotDependOnTheFrame) {
  for (const RedundancyMethod method : known)
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      SCOPED_TRACE(std::to_string(seed) + std::string(name_of<RedundancyMethod>(method, redundancy_methods)));
      const auto duration = [&](const test::Frame& frame) {
        return plan(test::redundancy_task(test::framed(seed, frame), test::md2()), method).head->duration();
      };
      const double here = duration({});
      for (const test::Frame& frame : test::other_frames) EXPECT_NEAR(duration(frame), here, 1e-6 * here);
      // A lag is not symmetric in time.
      if (method != RedundancyMethod::lag_compensation) {
        EXPECT_NEAR(duration(test::backwards), here, 1e-5 * here);
      }
    }
}

/// Where an axis stands centred at rest it does so with every method, at both ends.
TEST(KnownMethods, FineAxesAreCentredAtBothEndsWhereTheyHaveToBe) {
  CoarseFineMachine machine = test::md2();
  for (CoarseFineAxis& axis : machine.axes) axis.centred = true;
  for (const std::uint64_t seed : {3u, 4u}) {
    const RedundancyTask task = test::redundancy_task(test::framed(seed, {}), machine);
    for (const auto& method : redundancy_methods) {
      if (method.value == RedundancyMethod::joint) continue;
      SCOPED_TRACE(method.name);
      const RedundancyResult r = plan(task, method.value);
      expect_valid(task, r);
      EXPECT_EQ(r.fallbacks, 0u);
      for (const double t : {0.0, r.head->duration()}) {
        const MotionState x = r.head->evaluate(t), c = r.coarse->evaluate(t);
        for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(x.position[k], c.position[k], 1e-8) << t;
      }
    }
  }
}

/// What no axis drives near a limit is found, wherever the motion begins and ends: 5.2.3.
TEST(KnownMethods, RetimedIterativePlansAreShorter) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    const RedundancyTask task = test::redundancy_task(test::framed(seed, {}), test::md2());
    RedundancyOptions options;
    options.method = RedundancyMethod::iterative;
    const RedundancyResult before = plan(task, RedundancyMethod::iterative);
    options.reparametrise = true;
    SilentProgress progress;
    const RedundancyResult after = plan_redundant(task, options, progress);
    expect_valid(task, after);
    EXPECT_LT(after.head->duration(), (seed == 2 ? 0.98 : 0.9998) * before.head->duration());
  }
}

/// The discrete prefilter answers a motion as its transfer function does: less the share T_f/T_c of the coarse lag.
TEST(KnownMethods, ThePrefilterTakesOffItsShareOfTheCoarseLag) {
  const double coarse = 0.02, fine = 0.003, step = 0.001;
  std::vector<double> x;
  for (int i = 0; i < 200; ++i) x.push_back(i < 50 ? 0 : std::sin(0.05 * (i - 50)) + 0.01 * (i - 50));
  const std::vector<double> lag = lagged(x, coarse, step);
  const Prefilter v = prefilter(coarse, fine, step);
  double y = x[0];
  for (std::size_t i = 1; i < x.size(); ++i) {
    y = v.b[0] * x[i] + v.b[1] * x[i - 1] - v.a1 * y;
    EXPECT_NEAR(y, x[i] - fine / coarse * (x[i] - lag[i]), 1e-12);
  }
  EXPECT_NEAR((v.b[0] + v.b[1]) / (1 + v.a1), v.numerator[0] / v.denominator[0], 1e-12);  // at rest
}

}  // namespace
}  // namespace bahnwerk
