// The verifier on arcs, free-form curves and corners: true peaks with their moments, rests where they are needed.
#include "core/verify/law/verifier.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/core/verify/verdicts.hpp"

namespace bahnwerk {
namespace {

using reference::expect_failed;
using reference::find;
using reference::law_through;
using reference::machine;
using reference::Maker;
using reference::Stop;
using reference::verdict;

// A quarter of the circle of 10 mm between two lines, at constant speed: every axis meets v²/r at an end of the arc.
struct Turn : testing::Test {
  Contour contour = Maker().line({50, 0}).arc({60, 10}, {50, 10}, true).line({60, 60}).done();
  double quarter = 5 * std::numbers::pi, length = 100 + 5 * std::numbers::pi;
  double v = 300, a = 300 * 300 / 10.0;
  TimeLaw law = law_through(contour.path, {{0, 0}, {50, v}, {50 + quarter / 3, v}, {50 + quarter, v}, {length, 0}});
};

TEST_F(Turn, CentripetalAccelerationIsMetAndNotPassed) {
  expect_failed(verdict(contour, machine(2, v, a), law), {});
  expect_failed(verdict(contour, machine(2, v / (1 + 1e-10), a / (1 + 1e-10)), law), {});
  expect_failed(verdict(contour, machine(2, v, a / (1 + 1e-8)), law), {"acceleration x", "acceleration y"});
  EXPECT_NEAR(find(verdict(contour, machine(2, v, a), law), "acceleration y").value, a, 1e-7);
}

TEST_F(Turn, PeakInsideAPieceIsFoundWithItsMoment) {
  // While speeding up along the arc the acceleration of x = −sinθ·b/r + cosθ·a peaks inside; b = b0 + 2 a s.
  const double gain = 2000, v1 = std::sqrt(v * v + 2 * gain * quarter);
  const TimeLaw faster = law_through(contour.path, {{0, 0}, {50, v}, {50 + quarter, v1}, {length, 0}});
  double peak_y = 0, s_y = 0, peak_vx = 0;
  for (int i = 0; i <= 1000000; ++i) {
    const double s = quarter * i / 1e6, theta = s / 10, b = v * v + 2 * gain * s;
    const double y = std::abs(std::cos(theta) * b / 10 + std::sin(theta) * gain);
    if (y > peak_y) peak_y = y, s_y = s;
    peak_vx = std::max(peak_vx, std::cos(theta) * std::sqrt(b));
  }
  const Verification verdict2 = verdict(contour, machine(2, 1e4, 1e5), faster);
  EXPECT_NEAR(find(verdict2, "acceleration y").value, peak_y, 1e-6);
  EXPECT_NEAR(find(verdict2, "velocity x").value, std::max(peak_vx, v), 1e-7);
  const double t = 50 * 2 / v + 2 * s_y / (v + std::sqrt(v * v + 2 * gain * s_y));
  EXPECT_NEAR(find(verdict2, "acceleration y").at, t, 1e-5);
}

TEST_F(Turn, EveryMotionThatExceedsALimitIsNamed) {
  // The same turn three times, from rest to rest: 1 % too quick, as quick as may be, and half a percent too quick.
  Maker maker;
  std::vector<Stop> stops{{0, 0}};
  const std::array quick{1.01, 1.0, 1.005};
  for (std::size_t k = 0; k < quick.size(); ++k) {
    const double o = 60 * static_cast<double>(k), s = stops.back().s;
    maker.line({o + 50, o}).arc({o + 60, o + 10}, {o + 50, o + 10}, true).line({o + 60, o + 60});
    stops.insert(stops.end(), {{s + 50, quick[k] * v}, {s + 50 + quarter, quick[k] * v}, {s + length, 0}});
  }
  const Contour three = maker.done();
  TimeLaw law3 = law_through(three.path, stops);
  const Verification r = verdict(three, machine(2, 2 * v, a), law3);
  EXPECT_FALSE(r.passed);
  EXPECT_NEAR(find(r, "acceleration x").value, 1.01 * 1.01 * a, 1e-7 * a);  // the worst of all
  EXPECT_LT(find(r, "acceleration x").at, 1);
  ASSERT_EQ(r.too_fast.size(), 2u);
  EXPECT_NEAR(r.too_fast[0].factor, 1.01 * 1.01, 1e-9);
  EXPECT_NEAR(r.too_fast[1].factor, 1.005 * 1.005, 1e-9);
  std::vector<TimeLaw::Slowing> slower;
  for (const TooFast& place : r.too_fast) slower.push_back({place.at, place.factor});
  law3.slow_sections(slower);
  const Verification mended = verdict(three, machine(2, 2 * v, a), law3);
  expect_failed(mended, {});
  EXPECT_TRUE(mended.too_fast.empty());
}

TEST_F(Turn, WholeCircleInOnePiece) {
  const Contour circle = reference::circle_between_lines();
  const double round = 20 * std::numbers::pi;
  const TimeLaw once = law_through(circle.path, {{0, 0}, {50, v}, {50 + round, v}, {100 + round, 0}});
  const Verification r = verdict(circle, machine(2, v, a), once);
  expect_failed(r, {});
  EXPECT_NEAR(find(r, "acceleration x").value, a, 1e-8 * a * 1e-3);
  EXPECT_NEAR(find(r, "velocity y").value, v, 1e-8);
}

TEST_F(Turn, JerkOnAnArc) {
  Machine m = machine(2, 1e4, 1e5);
  m.axes[0].jerk = m.axes[1].jerk = v * v * v / 100;
  const TimeLaw steady = law_through(contour.path, {{0, 0}, {50, v}, {50 + quarter, v}, {length, 0}});
  // Where the arc begins at speed, and where acceleration gives way to steady speed, the acceleration jumps.
  expect_failed(verdict(contour, m, steady, 3), {"acceleration step at joints", "continuity of acceleration"});
  m.axes[1].jerk *= 1 - 1e-8;
  expect_failed(verdict(contour, m, steady, 3),
                {"jerk y", "acceleration step at joints", "continuity of acceleration"});
}

TEST_F(Turn, CubicPiecesOnAnArcAgreeWithADenseScan) {
  // The same path with jerk: s = 50 mm on the line in one cubic, then a cubic along the arc, then a stop.
  TimeLaw cubic;
  LawPiece in{0, 0.3, 0, 50, 0, 0, 0, 0};
  in.j = 50 * 6 / (0.3 * 0.3 * 0.3);
  cubic.append(in);
  const LawState x = in.at(0.3);
  LawPiece on{0, 0.04, 50, 0, x.v, -4000, 60000, 1};
  on.s_end = on.at(0.04).s;
  cubic.append(on);
  double peak = 0;
  for (int i = 0; i <= 1000000; ++i) {
    const LawState y = on.at(0.04 * i / 1e6);
    const double theta = (y.s - 50) / 10;
    peak = std::max(peak, std::abs(std::cos(theta) * y.v * y.v / 10 + std::sin(theta) * y.a));
  }
  const Verification r = verdict(contour, machine(2, 1e4, 1e6), cubic);
  EXPECT_NEAR(find(r, "acceleration y").value, peak, 1e-7 * peak);
  EXPECT_GE(find(r, "acceleration y").value, peak * (1 - 1e-11));
}

TEST_F(Turn, BlocksWithTheirOwnFeeds) {
  Contour two =
      Maker().block(400).line({50, 0}).block(200).arc({60, 10}, {50, 10}, true).block(400).line({60, 60}).done();
  const Verification r = verdict(two, machine(2, 1e4, 1e5), law);
  expect_failed(r, {"path velocity (feed 200)"});
  EXPECT_EQ(find(r, "path velocity (feed 200)").value, v);
}

TEST(Verifier, CornerNeedsRest) {
  const Contour corner = Maker().line({40, 0}).line({40, 30}).done();
  const Machine m = machine(2, 1800, 16000);
  expect_failed(verdict(corner, m, law_through(corner.path, {{0, 0}, {20, 500}, {40, 0}, {55, 500}, {70, 0}})), {});
  const Verification v =
      verdict(corner, m, law_through(corner.path, {{0, 0}, {20, 500}, {40, 0.01}, {55, 500}, {70, 0}}));
  expect_failed(v, {"corner rest"});
  EXPECT_NEAR(find(v, "corner rest").value, 0.01, 1e-12);
}

TEST(Verifier, SmallTangentJumpsAreAllowedTheirVelocityStep) {
  const double angle = 1e-3;  // below the corner angle; step in y: sin(angle)·v ≤ 16 mm/s at 1 ms
  const Contour bend = Maker().line({40, 0}).line({40 + 40 * std::cos(angle), 40 * std::sin(angle)}).done();
  const Machine m = machine(2, 1e5, 16000, 1e-5);  // allows 0.16 mm/s
  const double allowed = 0.16 / std::sin(angle);
  auto law = [&](double v) { return law_through(bend.path, {{0, 0}, {40, v}, {80, 0}}); };
  expect_failed(verdict(bend, m, law(allowed)), {});
  expect_failed(verdict(bend, m, law(allowed * (1 + 1e-8))), {"velocity step at joints"});
  EXPECT_NEAR(find(verdict(bend, m, law(allowed)), "velocity step at joints").limit, 0.16, 1e-15);
}

TEST(Verifier, CuspNeedsRestAndRestIsEnough) {
  // h = (u², u³) about its cusp, as a Bézier curve from (1, −1) to (1, 1): split there by the path.
  const Contour cusp = Maker(2, {1, -1, 0}).bezier({{-1.0 / 3, 1, 0}, {-1.0 / 3, -1, 0}, {1, 1, 0}}).done();
  ASSERT_EQ(cusp.path.size(), 2u);
  const double half = cusp.path[0].s1(), all = cusp.path.length();
  const Machine m = machine(2, 1e3, 1e4);
  auto law = [&](double v) {
    return law_through(
        cusp.path, {{0, 0}, {half / 2, 30}, {0.99 * half, 4}, {half, v}, {1.01 * half, 4}, {1.5 * half, 30}, {all, 0}});
  };
  const Verification resting = verdict(cusp, m, law(0));
  expect_failed(resting, {});
  // Against a scan of every piece; next to the cusp b grows linearly in s while the curvature grows like 1/√s.
  double peak = 0;
  const TimeLaw followed = law(0);
  for (const LawPiece& p : followed.pieces())
    for (int i = 1; i < 200000; ++i) {
      const double f = i / 2e5, v1 = p.v + p.a * p.duration, b = p.v * p.v + (v1 * v1 - p.v * p.v) * f;
      const PathPoint h = cusp.path[p.segment].at(p.s + (p.s_end - p.s) * f);
      peak = std::max(peak, std::abs(h.d2.y * b + h.d1.y * p.a));
    }
  EXPECT_NEAR(find(resting, "acceleration y").value, peak, 1e-5 * peak);
  EXPECT_GE(find(resting, "acceleration y").value, peak * (1 - 1e-11));
  const Verification moving = verdict(cusp, m, law(1e-3));
  EXPECT_FALSE(find(moving, "cusp rest").passed);
}

TEST(Verifier, FreeFormPeaksAgreeWithADenseScan) {
  std::mt19937_64 random(11);
  for (int round = 0; round < 12; ++round) {
    const Contour contour = reference::random_contour(random, 4, true);
    std::vector<Stop> stops;
    for (std::size_t i = 0; i < contour.path.size(); ++i)
      for (int k = 0; k < 7; ++k)
        stops.push_back({contour.path[i].s0() + contour.path[i].length() * k / 7,
                         stops.empty() ? 0 : 20.0 + double(random() % 80)});
    stops.push_back({contour.path.length(), 0});
    const TimeLaw law = law_through(contour.path, stops);
    const Verification v = verdict(contour, machine(2, 1e4, 1e5), law);
    double peaks[4] = {};
    for (const LawPiece& p : law.pieces())
      for (int i = 0; i <= 3000; ++i) {
        const LawState x = p.at(p.duration * i / 3000);
        const PathPoint h = contour.path[p.segment].at(std::min(x.s, p.s_end));
        for (std::size_t k = 0; k < 2; ++k) {
          peaks[k] = std::max(peaks[k], std::abs(h.d1[k] * x.v));
          peaks[2 + k] = std::max(peaks[2 + k], std::abs(h.d2[k] * x.v * x.v + h.d1[k] * x.a));
        }
      }
    const char* names[] = {"velocity x", "velocity y", "acceleration x", "acceleration y"};
    for (int k = 0; k < 4; ++k) {
      EXPECT_GE(find(v, names[k]).value, peaks[k] * (1 - 1e-9) - 1e-5) << round << names[k];
      EXPECT_LE(find(v, names[k]).value, peaks[k] * (1 + 1e-4)) << round << names[k];
    }
    EXPECT_TRUE(find(v, "arc length").passed) << find(v, "arc length").value;
    EXPECT_TRUE(find(v, "distance from contour").passed);
  }
}

TEST(Verifier, ThreeDimensionsAndTinyArcs) {
  const Contour contour = Maker(3).line({30, 40, 120}).done();
  const TimeLaw law = law_through(contour.path, {{0, 0}, {65, 650}, {130, 0}});
  const Verification v = verdict(contour, machine(3, 600, 3000), law);
  expect_failed(v, {});
  EXPECT_NEAR(find(v, "velocity z").value, 600, 1e-9);
  EXPECT_NEAR(find(v, "acceleration z").value, 3000, 1e-9);

  const double r = 1e-6, q = r * std::numbers::pi / 2;
  const Contour tiny = Maker().line({1e4, 0}).arc({1e4 + r, r}, {1e4, r}, true).line({1e4 + r, 10}).done();
  const double speed = std::sqrt(16000 * tiny.path[1].length() / (q / r));
  const TimeLaw through =
      law_through(tiny.path, {{0, 0}, {tiny.path[1].s0(), speed}, {tiny.path[1].s1(), speed}, {tiny.path.length(), 0}});
  const Verification w = verdict(tiny, machine(2, 1800, 16001), through);
  EXPECT_TRUE(find(w, "acceleration x").passed) << find(w, "acceleration x").value;
  EXPECT_GT(find(w, "acceleration x").value, 15990);
}

/// A line of `way` mm, a rounding of 0.04 mm that all but turns back, and a line of the same way: passed at 1.6 mm/s.
Verification past_a_reversal(double way) {
  constexpr double size = 0.02, turn = 165 * std::numbers::pi / 180, stretch = 0.9 + 0.03 * turn;
  const Vec out{std::cos(turn), std::sin(turn), 0};
  std::vector<Vec> points;
  for (const double share : {6.0, 4.0, 2.0})
    points.insert(points.begin(), {way + size - (1 - share * stretch / 7) * size, 0, 0});
  for (const double share : {6.0, 4.0, 2.0, 0.0})
    points.push_back(Vec{way + size, 0, 0} + (1 - share * stretch / 7) * size * out);
  const Contour contour = Maker().line({way, 0}).bezier(points).line(Vec{way + size, 0, 0} + (size + way) * out).done();
  const double end = contour.path.length(), ramp = 0.5;
  return verdict(
      contour, machine(2, 1e3, 16000),
      law_through(contour.path,
                  {{0, 0}, {ramp, 1.6}, {way, 1.6}, {contour.path[1].s1(), 1.6}, {end - ramp, 1.6}, {end, 0}}));
}

TEST(Verifier, PeaksAreAsSharpFarAlongThePath) {
  const Verification near = past_a_reversal(1);
  expect_failed(near, {});
  for (const double way : {30.0, 1e3, 3e4}) {
    const Verification far = past_a_reversal(way);
    expect_failed(far, {});
    for (const char* name : {"acceleration x", "acceleration y"})
      EXPECT_NEAR(find(far, name).value, find(near, name).value, (1e-9 + 1e-12 * way) * find(near, name).value)
          << way << name;
  }
}

}  // namespace
}  // namespace bahnwerk
