// The lower bound against closed forms, against a dense solution by another method, and against motions that exist.
#include "core/verify/bound/lower_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/contour/polyline.hpp"
#include "core/motion/acceleration/acceleration_limited.hpp"
#include "core/verify/verifier.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/verify/reference.hpp"

namespace bahnwerk {
namespace {

using reference::dense_optimum;
using reference::machine;
using reference::Maker;

constexpr double corner_angle = 0.1 * std::numbers::pi / 180;

double bound(const Contour& contour, const Machine& m) {
  Progress silent;
  return lower_bound(contour, m, corner_angle, silent).value;
}

TEST(LowerBound, LineReachesTheClosedForm) {
  // Below the top speed: t = 2 √(s/a).
  EXPECT_NEAR(bound(Maker().line({100, 0}).done(), machine(2, 1800, 16000)), 2 * std::sqrt(100 / 16000.0), 1e-12);
  // At it: t = s/v + v/a.
  EXPECT_NEAR(bound(Maker().line({400, 0}).done(), machine(2, 1800, 16000)), 400 / 1800.0 + 1800 / 16000.0, 1e-12);
  EXPECT_NEAR(bound(Maker().block(900).line({400, 0}).done(), machine(2, 1800, 16000)), 400 / 900.0 + 900 / 16000.0,
              1e-12);
  // Inclined 3-4-5: path limits V/0.8, A/0.8; in space as well.
  EXPECT_NEAR(bound(Maker().line({300, 400}).done(), machine(2, 800, 8000)), 500 / 1000.0 + 0.1, 1e-12);
  EXPECT_NEAR(bound(Maker(3).line({30, 40, 120}).done(), machine(3, 600, 3000)), 130 / 650.0 + 650 / 3250.0, 1e-12);
  EXPECT_NEAR(bound(Maker().line({1e4, 0}).done(), machine(2, 1800, 16000)), 1e4 / 1800 + 0.1125, 1e-11);
}

TEST(LowerBound, NeverAboveTheClosedForm) {
  EXPECT_LE(bound(Maker().line({100, 0}).done(), machine(2, 1800, 16000)), 2 * std::sqrt(100 / 16000.0));
  EXPECT_LE(bound(Maker().line({400, 0}).done(), machine(2, 1800, 16000)), 400 / 1800.0 + 1800 / 16000.0);
}

TEST(LowerBound, SplitLineAndCorner) {
  const double one = bound(Maker().line({100, 0}).done(), machine(2, 1800, 16000));
  EXPECT_NEAR(
      bound(Maker().line({0.3, 0}).line({37, 0}).line({99.9999, 0}).line({100, 0}).done(), machine(2, 1800, 16000)),
      one, 1e-11);
  EXPECT_NEAR(bound(Maker().line({40, 0}).line({40, 30}).done(), machine(2, 1800, 16000)),
              2 * std::sqrt(40 / 16000.0) + 2 * std::sqrt(30 / 16000.0), 1e-11);
  // A reversal is a corner too.
  EXPECT_NEAR(bound(Maker().line({40, 0}).line({0, 0}).done(), machine(2, 1800, 16000)), 4 * std::sqrt(40 / 16000.0),
              1e-11);
}

TEST(LowerBound, FeedChangesBetweenBlocks) {
  // 1000 mm/s over 200 mm, then 500 mm/s over 200 mm: brakes before the joint.
  const double a = 10000, first = 0.1 + (200 - 50 - (1e6 - 25e4) / (2 * a)) / 1000 + 500 / a,
               second = (200 - 12.5) / 500 + 0.05;
  EXPECT_NEAR(bound(Maker().block(1000).line({200, 0}).block(500).line({400, 0}).done(), machine(2, unlimited, a)),
              first + second, 1e-11);
}

TEST(LowerBound, SmallTangentJumpLimitsTheSpeed) {
  const double angle = 1e-3, allowed = 0.16 / std::sin(angle);  // A · cycle = 0.16 mm/s
  const Contour q2 = Maker().line({40, 0}).line({40 + 40 * std::cos(angle), 40 * std::sin(angle)}).done();
  const double a = 16000, peak2 = (allowed * allowed) / 2 + a * 40, half = (2 * std::sqrt(peak2) - allowed) / a;
  EXPECT_NEAR(bound(q2, machine(2, unlimited, a, 1e-5)), 2 * half, 1e-7);
}

TEST(LowerBound, CircleBetweenLinesAgainstTheDenseSolution) {
  struct Case {
    double vx, vy, ax, ay, feed;
  };
  for (const Case& c : {Case{unlimited, unlimited, 16000, 16000, unlimited}, Case{300, 300, 16000, 16000, unlimited},
                        Case{1800, 1800, 16000, 16000, 200}, Case{1800, 1800, 16000, 5000, unlimited},
                        Case{100, 400, 2000, 16000, 350}}) {
    Machine m = machine(2, 1, 1);
    m.axes[0].velocity = c.vx, m.axes[1].velocity = c.vy, m.axes[0].acceleration = c.ax, m.axes[1].acceleration = c.ay;
    const Contour contour = reference::circle_between_lines(10, c.feed);
    const double low = bound(contour, m), coarse = dense_optimum(contour, m, corner_angle, 20000),
                 fine = dense_optimum(contour, m, corner_angle, 40000);
    EXPECT_LE(low, fine + 2 * std::abs(fine - coarse) + 1e-9 * fine)
        << c.ax << " " << low / fine - 1 << " " << coarse / fine - 1;
    EXPECT_GE(low, fine * (1 - 1e-6)) << c.ax << " " << c.ay << " " << c.feed;
  }
}

TEST(LowerBound, RandomContoursAgainstTheDenseSolution) {
  for (unsigned i = 0; i < 60; ++i) {
    std::mt19937_64 random(1000 + i);
    const Contour contour =
        reference::random_contour(random, 1 + static_cast<int>(i % 8), i % 2, i % 7 == 3 ? 150 : unlimited);
    Machine m = machine(2, i % 3 ? unlimited : 300, 16000);
    if (i % 5 == 1) m.axes[0].acceleration = 3000;
    if (i % 11 == 1) m.axes[1].velocity = 40;
    const double low = bound(contour, m), coarse = dense_optimum(contour, m, corner_angle, 4000),
                 fine = dense_optimum(contour, m, corner_angle, 8000), error = 3 * std::abs(fine - coarse);
    EXPECT_LE(low, fine + error + 1e-9 * fine) << i;
    EXPECT_GE(low, fine * (1 - 2e-5) - error) << i;
  }
}

TEST(LowerBound, MaximumVelocityCurveThatFallsBehindALine) {
  // From the line on the curvature grows: the motion touches the maximum velocity curve between two nodes of the first
  // grid, to either side of which it is slower than the curve.
  std::mt19937_64 random(2493);
  const Contour contour = reference::random_contour(random, 6, true);
  const Machine m = machine(2, unlimited, 16000);
  const double low = bound(contour, m), fine = dense_optimum(contour, m, corner_angle, 32000);
  EXPECT_LE(low, fine * (1 + 1e-6));
  EXPECT_GE(low, fine * (1 - 1e-6));
}

TEST(LowerBound, BelowMotionsThatTheJudgeAccepts) {
  for (unsigned i = 0; i < 40; ++i) {
    std::mt19937_64 random(77 + i);
    const Contour contour = reference::random_contour(random, 1 + static_cast<int>(i % 5), true);
    // Speed v all along, reached within each first and last millimetre: take the peaks as the machine's limits.
    const double v = 10.0 + double(random() % 100), length = contour.path.length();
    std::vector<reference::Stop> stops{{0, 0}};
    const double ramp =
        std::min({1.0, contour.path[0].length() / 2, contour.path[contour.path.size() - 1].length() / 2});
    stops.push_back({ramp, v});
    for (std::size_t k = 1; k < contour.path.size(); ++k) stops.push_back({contour.path[k].s0(), v});
    stops.push_back({length - ramp, v});
    stops.push_back({length, 0});
    const TimeLaw law = reference::law_through(contour.path, stops);
    Progress silent;
    Machine m = machine(2, 1e6, 1e12);
    for (int pass = 0; pass < 2; ++pass)  // peaks are resolved in relation to the limits: once more with the right ones
      for (const Check& c : verify_motion({contour, m, law, corner_angle}, silent).checks)
        for (std::size_t k = 0; k < 2; ++k) {
          if (check_name(c) == "velocity " + m.axes[k].name) m.axes[k].velocity = c.value;
          if (check_name(c) == "acceleration " + m.axes[k].name) m.axes[k].acceleration = c.value;
        }
    for (const Check& c : verify_motion({contour, m, law, corner_angle}, silent).checks)
      ASSERT_TRUE(c.passed) << i << " " << check_name(c) << " " << c.value << " against " << c.limit;
    EXPECT_LE(bound(contour, m), law.duration());
  }
}

TEST(LowerBound, LooserLimitsNeverRaiseIt) {
  for (unsigned i = 0; i < 40; ++i) {
    std::mt19937_64 random(500 + i);
    const Contour contour = reference::random_contour(random, 3, i % 2);
    const Machine m = machine(2, 200, 5000);
    const double base = bound(contour, m);
    for (std::size_t k = 0; k < 2; ++k) {
      Machine looser = m;
      looser.axes[k].velocity *= 1.3;
      EXPECT_LE(bound(contour, looser), base * (1 + 1e-7));
      looser = m;
      looser.axes[k].acceleration *= 1.3;
      EXPECT_LE(bound(contour, looser), base * (1 + 1e-7));
    }
  }
}

/// A line, a piece over which the slope of y is δ (1 − c (4u(1 − u))⁶), and a line: where the piece begins, ends and in
/// its middle the curvature is 0, so that samples there show a straight line. In between y falls back by as much as it
/// rises: c = 13!!/12!!.
Contour hidden_fall(double slope, double before, double piece, double after) {
  std::vector<double> x{0, piece}, y(14, 0.0);
  y[1] = piece * slope;
  const double c = 13.0 * 11 * 9 * 7 * 5 * 3 / (12.0 * 10 * 8 * 6 * 4 * 2), binomial[] = {1, 6, 15, 20, 15, 6, 1};
  for (std::size_t j = 0; j < 7; ++j)
    y[7 + j] = -piece * slope * c * 4096 * binomial[j] * (j % 2 ? -1 : 1) / static_cast<double>(7 + j);
  Contour contour;
  contour.path.append(std::make_shared<Line>(Vec{-before, -slope * before, 0}, Vec{}), 0);
  contour.path.append(std::make_shared<Rational>(Rational::from_power_basis({x, y})), 1);
  contour.path.append(std::make_shared<Line>(Vec{piece, 0, 0}, Vec{piece + after, slope * after, 0}), 2);
  contour.blocks.push_back({Mode::cut, unlimited, 0, 3});
  return contour;
}

TEST(LowerBound, AnAxisThatTurnsBackBetweenSamples) {
  // Along y, whose limit is the tighter one, the energy at the end of the piece may be that of all its ways there and
  // back; its ends are equally high.
  for (const double slope : {1e-7, 1e-6, 1e-5, 1e-3})
    for (const double stiff : {3.0, 10.0, 30.0}) {
      const Contour contour = hidden_fall(slope, 1, 10, 200);
      Machine m = machine(2, unlimited, 9000);
      m.axes[1].acceleration = 9000 * slope * stiff;
      const double low = bound(contour, m), coarse = dense_optimum(contour, m, corner_angle, 10000),
                   fine = dense_optimum(contour, m, corner_angle, 20000), error = 3 * std::abs(fine - coarse);
      EXPECT_LE(low, fine + error + 1e-9 * fine) << slope << " " << stiff << " " << low / fine - 1;
      EXPECT_GE(low, fine * (1 - 2e-5) - error) << slope << " " << stiff << " " << low / fine - 1;
    }
}

Contour scaled(double k) {
  return Maker()
      .line({30 * k, 0})
      .arc({40 * k, 10 * k}, {30 * k, 10 * k}, true)
      .bezier({{40 * k, 25 * k}, {60 * k, 5 * k}, {60 * k, 30 * k}})
      .line({60 * k, 45 * k})
      .done();
}

TEST(LowerBound, ScalesWithTheUnits) {
  const double in_mm = bound(scaled(1), machine(2, 400, 9000));
  // In metres: lengths, velocities, accelerations × 1e-3, the same time.
  EXPECT_NEAR(bound(scaled(1e-3), machine(2, 0.4, 9)), in_mm, 1e-9);
  // Twice as fast a clock: velocities × 2, accelerations × 4, half the time.
  EXPECT_NEAR(bound(scaled(1), machine(2, 800, 36000)), in_mm / 2, 1e-9);
}

TEST(LowerBound, TheSameBackwards) {
  const Contour forth = scaled(1);
  const Contour back = Maker(2, {60, 45, 0})
                           .line({60, 30})
                           .bezier({{60, 5}, {40, 25}, {40, 10}})
                           .arc({30, 0}, {30, 10}, false)
                           .line({0, 0})
                           .done();
  EXPECT_NEAR(bound(forth, machine(2, 400, 9000)), bound(back, machine(2, 400, 9000)), 1e-7);
}

TEST(LowerBound, ThreeAxes) {
  // The plane may lie in space without changing anything.
  const Contour flat = reference::circle_between_lines();
  EXPECT_NEAR(bound(flat, machine(3, 500, 16000)), bound(flat, machine(2, 500, 16000)), 1e-12);
  const Contour steep = Maker(3).line({0, 30, 40}).bezier({{0, 40, 53}, {10, 60, 60}, {30, 60, 60}}).done();
  const Contour helix = Maker(3, {10, 0, 0}).arc({0, 10, 3}, {0, 0, 0}, true).arc({10, 0, 12}, {0, 0, 3}, true).done();
  for (const Contour* contour : {&steep, &helix})
    for (const double z : {9000.0, 700.0}) {
      Machine m = machine(3, 500, 9000);
      m.axes[2].acceleration = z, m.axes[2].velocity = z / 100;
      const double low = bound(*contour, m), coarse = dense_optimum(*contour, m, corner_angle, 20000),
                   fine = dense_optimum(*contour, m, corner_angle, 40000);
      EXPECT_LE(low, fine + 3 * std::abs(fine - coarse));
      EXPECT_GE(low, fine * (1 - 1e-5));
    }
}

TEST(LowerBound, ExtremeInputsGiveFiniteBounds) {
  const double r = 1e-6;
  const Contour tiny = Maker().line({1e4, 0}).arc({1e4 + r, r}, {1e4, r}, true).line({1e4 + r, 10}).done();
  Maker many;
  for (int i = 0; i < 3000; ++i) many.line({double(i + 1), i % 2 ? 0.0 : 0.5});
  const Contour zigzag = many.done();
  const Contour cusp = Maker(2, {1, -1, 0}).bezier({{-1.0 / 3, 1, 0}, {-1.0 / 3, -1, 0}, {1, 1, 0}}).done();
  for (const Contour* contour : {&tiny, &zigzag, &cusp})
    for (double velocity : {1e-3, 100.0, 1e9, unlimited})
      for (double acceleration : {1e-3, 1e4, 1e9}) {
        const double t = bound(*contour, machine(2, velocity, acceleration));
        EXPECT_TRUE(std::isfinite(t) && t > 0) << velocity << " " << acceleration;
        EXPECT_GE(t, contour->path.length() / std::sqrt(2) / velocity * (1 - 1e-9));
      }
  Progress silent;
  EXPECT_EQ(lower_bound(Contour{}, machine(2, 1, 1), corner_angle, silent).value, 0);
}

TEST(LowerBound, LongAlmostStraightCurves) {
  // Few nodes, and most of the time at the velocity limit of one axis while another accelerates.
  for (const double bulge : {0.01, 0.1, 1.0}) {
    const Contour contour = Maker().bezier({{300, bulge}, {600, -bulge}, {1000, 100 * bulge}}).done();
    for (const double vy : {0.5, 5.0, 50.0}) {
      Machine m = machine(2, 900, 3000);
      m.axes[1].velocity = vy, m.axes[1].acceleration = 40;
      const double low = bound(contour, m), coarse = dense_optimum(contour, m, corner_angle, 20000),
                   fine = dense_optimum(contour, m, corner_angle, 40000), error = 3 * std::abs(fine - coarse);
      EXPECT_LE(low, fine + error) << bulge << " " << vy;
      EXPECT_GE(low, fine * (1 - 5e-6) - error) << bulge << " " << vy;
    }
  }
}

TEST(LowerBound, CuspAgainstTheDenseSolution) {
  const Contour cusp = Maker(2, {1, -1, 0}).bezier({{-1.0 / 3, 1, 0}, {-1.0 / 3, -1, 0}, {1, 1, 0}}).done();
  const Machine m = machine(2, 100, 5000);
  const double low = bound(cusp, m), coarse = dense_optimum(cusp, m, corner_angle, 50000),
               fine = dense_optimum(cusp, m, corner_angle, 100000);
  EXPECT_LE(low, fine + 3 * std::abs(fine - coarse));
  EXPECT_GE(low, fine * (1 - 2e-5) - 3 * std::abs(fine - coarse));
}

TEST(LowerBound, StopsWhenAsked) {
  struct Stopping final : ProgressSink {
    void report(std::string_view, double fraction, std::string_view) override {
      EXPECT_GE(fraction, 0.25);
      EXPECT_LE(fraction, 0.75);
      throw Stopped(StopReason::deadline);
    }
  } progress;
  EXPECT_THROW(lower_bound(reference::circle_between_lines(), machine(2, 1, 1), corner_angle,
                           Progress(progress).part(0.25, 0.75)),
               Stopped);
}

TEST(WithGap, IsPlannedOverBoundMinusOne) {
  EXPECT_NEAR(with_gap({2, 0, ""}, 2.5).gap, 0.25, 1e-15);
  EXPECT_EQ(with_gap({2, 0, ""}, 2).gap, 0);
  EXPECT_LT(with_gap({2, 0, ""}, 1.999).gap, -4e-4);
  EXPECT_EQ(with_gap({0, 0, ""}, 0).gap, 0);
}

TEST(LowerBound, LongSectionsAreCutAndStayBelow) {
  std::vector<Vec> points;
  constexpr int n = 450'000;
  for (int i = 0; i <= n; ++i) points.push_back({i * 1e-3, 0, 0});
  const double v = 1800, a = 16000, length = n * 1e-3, whole = length / v + v / a;
  const double proven = bound(polyline(2, points, false, unlimited), machine(2, v, a));
  EXPECT_LE(proven, whole);
  EXPECT_GE(proven, whole - 0.5 * v / a);  // what an open speed at the last cut can save
}

/// A winding curve in pieces of a quarter of a turn or less, each a cubic.
Contour winding(int pieces) {
  Maker maker(2, {0, 0, 0});
  const auto at = [](double t) { return Vec{2 * t, 3 * std::sin(t) + std::sin(2.7 * t), 0}; };
  const auto slope = [](double t) { return Vec{2, 3 * std::cos(t) + 2.7 * std::cos(2.7 * t), 0}; };
  constexpr double step = 0.05;
  for (int i = 0; i < pieces; ++i) {
    const double t = i * step;
    const Vec end = at(t + step);
    maker.bezier({at(t) + step / 3 * slope(t), end - step / 3 * slope(t + step), end});
  }
  return maker.done();
}

TEST(LowerBound, LongPathsAreSolvedInWindowsWithWiderCells) {
  const Machine m = machine(2, 500, 8000);
  const Contour few = winding(4000), many = winding(40'000);
  Progress silent;
  const double fine = bound(few, m), optimum = plan_acceleration_limited(few, m, {}, silent).law.duration();
  EXPECT_LE(fine, optimum);
  EXPECT_GT(fine, optimum * (1 - 1e-5));
  // The same again and again, but for how it begins and ends.
  const double coarse = bound(many, m), planned = plan_acceleration_limited(many, m, {}, silent).law.duration();
  EXPECT_LE(coarse, planned);
  EXPECT_GT(coarse, planned * (1 - 5e-4));
}

}  // namespace
}  // namespace bahnwerk
