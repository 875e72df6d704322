// The verifier on laws made by hand: what is right passes, and every kind of fault is caught by the check that names
// it.
#include "core/verify/verifier.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "core/base/errors.hpp"
#include "tests/core/verify/reference.hpp"

namespace bahnwerk {
namespace {

using reference::law_through;
using reference::machine;
using reference::Maker;
using reference::Stop;

constexpr double corner_angle = 0.1 * std::numbers::pi / 180;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Verification verdict(const Contour& contour, const Machine& m, const TimeLaw& law, bool jerk = false) {
  SilentProgress silent;
  return verify_motion({contour, m, law, corner_angle, jerk}, silent);
}
const Check& find(const Verification& v, const std::string& name) {
  for (const Check& c : v.checks)
    if (c.name == name) return c;
  ADD_FAILURE() << "no check named " << name;
  static const Check none;
  return none;
}
/// Exactly the named checks fail.
void expect_failed(const Verification& v, const std::vector<std::string>& names) {
  EXPECT_EQ(v.passed, names.empty());
  for (const Check& c : v.checks) {
    const bool expected = std::find(names.begin(), names.end(), c.name) != names.end();
    EXPECT_EQ(!c.passed, expected) << c.name << " " << c.value << " against " << c.limit << " at " << c.at;
  }
}
TimeLaw edited(const TimeLaw& law, std::size_t i, const std::function<void(LawPiece&)>& edit) {
  TimeLaw other;
  for (std::size_t k = 0; k < law.pieces().size(); ++k) {
    LawPiece p = law.pieces()[k];
    if (k == i) edit(p);
    other.append(p);
  }
  return other;
}

// 100 mm along x: 16000 mm/s² up to 1200 mm/s (45 mm), 10 mm at that speed, down again.
struct Trapezoid : testing::Test {
  Contour contour = Maker().line({100, 0}).done();
  TimeLaw law = law_through(contour.path, {{0, 0}, {45, 1200}, {55, 1200}, {100, 0}});
};

TEST_F(Trapezoid, Passes) {
  const Verification v = verdict(contour, machine(2, 1200, 16000), law);
  expect_failed(v, {});
  EXPECT_NEAR(find(v, "velocity x").value, 1200, 1e-9);
  EXPECT_NEAR(find(v, "acceleration x").value, 16000, 1e-9);
  EXPECT_NEAR(find(v, "velocity x").at, 0.075, 1e-9);
  EXPECT_EQ(find(v, "velocity y").value, 0);
  EXPECT_EQ(find(v, "velocity x").unit, "mm/s");
}

TEST_F(Trapezoid, LimitsHoldToAPartInABillion) {
  expect_failed(verdict(contour, machine(2, 1200 / (1 + 1e-10), 16000 / (1 + 1e-10)), law), {});
  expect_failed(verdict(contour, machine(2, 1200 / (1 + 1e-8), 16000), law), {"velocity x"});
  expect_failed(verdict(contour, machine(2, 1200, 16000 / (1 + 1e-8)), law), {"acceleration x"});
}

TEST_F(Trapezoid, UnlimitedAxesAreNotChecked) {
  const Verification v = verdict(contour, machine(2, unlimited, 16000), law);
  expect_failed(v, {});
  for (const Check& c : v.checks) EXPECT_EQ(c.name.find("velocity x"), std::string::npos);
}

TEST_F(Trapezoid, FeedExceededByAMillionth) {
  contour.blocks[0].feed = 1200;
  EXPECT_EQ(find(verdict(contour, machine(2, 1800, 16000), law), "path velocity (feed 1200)").value, 1200);
  contour.blocks[0].feed = 1200 / (1 + 1e-6);
  const Verification v = verdict(contour, machine(2, 1800, 16000), law);
  EXPECT_FALSE(v.passed);
  EXPECT_EQ(std::count_if(v.checks.begin(), v.checks.end(), [](const Check& c) { return !c.passed; }), 1);
}

TEST_F(Trapezoid, AccelerationAPartInAMillionTooHighInOnePiece) {
  const TimeLaw wrong = law_through(contour.path, {{0, 0}, {45 / 1.000001, 1200}, {55, 1200}, {100, 0}});
  expect_failed(verdict(contour, machine(2, 1200, 16000), wrong), {"acceleration x"});
}

TEST_F(Trapezoid, VelocityJump) {
  const TimeLaw wrong = edited(law, 1, [](LawPiece& p) { p.v = 1199.9, p.duration = 10 / 1199.9; });
  expect_failed(verdict(contour, machine(2, 1200, 16000), wrong), {"continuity of velocity"});
  const Verification v = verdict(contour, machine(2, 1200, 16000), wrong);
  EXPECT_NEAR(find(v, "continuity of velocity").value, 0.1, 1e-9);
}

TEST_F(Trapezoid, PositionGap) {
  expect_failed(verdict(contour, machine(2, 1200, 16000),
                        edited(law, 1, [](LawPiece& p) { p.s += 1e-7, p.duration -= 1e-7 / 1200; })),
                {"continuity of position"});
  expect_failed(verdict(contour, machine(2, 1200, 16000), edited(law, 1, [](LawPiece& p) { p.duration *= 1 + 1e-7; })),
                {"continuity of position"});
}

/// Tolerances are those of rounding, at every speed: a law that is wrong by a little more fails.
TEST(Verifier, TolerancesFollowTheSpeedOfTheMotion) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  for (const double scale : {1e-4, 1e-2, 1.0, 1e2, 1e5}) {
    for (const double length : {1e-3, 1.0, 1e6}) {
      SCOPED_TRACE(testing::Message() << scale << " mm/s over " << length << " mm");
      const Contour line = Maker().line({length, 0}).done();
      const Machine m = machine(2, 2 * scale, 100 * scale * scale / length);
      const TimeLaw law = law_through(line.path, {{0, 0}, {0.25 * length, scale}, {0.75 * length, scale}, {length, 0}});
      expect_failed(verdict(line, m, law), {});
      // What a check allows is 32 ε of the terms that enter, of one piece or of two: some ten times as much fails, a
      // tenth of it passes.
      const auto expect = [&](const std::string& name, std::size_t piece,
                              const std::function<void(LawPiece&, double)>& edit) {
        const auto by = [&](double part) {
          return verdict(line, m, edited(law, piece, [&](LawPiece& p) { edit(p, part * 1000 * eps); }));
        };
        EXPECT_FALSE(find(by(1), name).passed) << name << ' ' << find(by(1), name).value;
        expect_failed(by(0.01), {});
      };
      expect("start at rest", 0, [&](LawPiece& p, double e) { p.v = e * scale; });
      expect("continuity of velocity", 1, [&](LawPiece& p, double e) { p.v += e * scale; });
      expect("end at rest", 2, [&](LawPiece& p, double e) { p.a *= 1 - e; });
      expect("forward motion", 2, [&](LawPiece& p, double e) { p.a *= 1 + e; });
      expect("continuity of position", 1, [&](LawPiece& p, double e) { p.duration *= 1 + e; });
      expect("continuity of position", 1, [&](LawPiece& p, double e) { p.s += e * length; });
      expect("pieces within segments", 2, [&](LawPiece& p, double e) { p.s_end += e * length; });
      expect("path covered", 2, [&](LawPiece& p, double e) { p.s_end -= e * length; });
    }
  }
}

TEST_F(Trapezoid, StartsOrEndsInMotion) {
  expect_failed(verdict(contour, machine(2, 1200, 16000),
                        law_through(contour.path, {{0, 1e-3}, {45, 1200}, {55, 1200}, {100, 0}})),
                {"start at rest"});
  expect_failed(verdict(contour, machine(2, 1200, 16000),
                        law_through(contour.path, {{0, 0}, {45, 1200}, {55, 1200}, {100, 1e-3}})),
                {"end at rest"});
}

TEST_F(Trapezoid, StopsShortOrOverruns) {
  expect_failed(
      verdict(contour, machine(2, 1200, 17000), law_through(contour.path, {{0, 0}, {45, 1200}, {55, 1200}, {99, 0}})),
      {"path covered"});
  const TimeLaw over = law_through(contour.path, {{0, 0}, {45, 1200}, {55, 1200}, {100.5, 0}});
  expect_failed(verdict(contour, machine(2, 1200, 16000), over), {"path covered", "pieces within segments"});
  const Verification none = verdict(contour, machine(2, 1200, 16000), TimeLaw{});
  expect_failed(none, {"path covered"});
}

TEST_F(Trapezoid, NotANumberFailsWithoutACrash) {
  for (std::size_t piece = 0; piece < 3; ++piece)
    for (double LawPiece::*field :
         {&LawPiece::duration, &LawPiece::s, &LawPiece::s_end, &LawPiece::v, &LawPiece::a, &LawPiece::j})
      for (double poison : {not_a_number, unlimited, -unlimited}) {
        const Verification v = verdict(contour, machine(2, 1200, 16000),
                                       edited(law, piece, [&](LawPiece& p) { p.*field = poison; }), true);
        EXPECT_FALSE(v.passed);
        EXPECT_FALSE(find(v, "velocity x").passed);
      }
}

TEST_F(Trapezoid, PieceWithoutASegment) {
  EXPECT_FALSE(find(verdict(contour, machine(2, 1200, 16000), edited(law, 1, [](LawPiece& p) { p.segment = 7; })),
                    "pieces within segments")
                   .passed);
}

TEST_F(Trapezoid, RunsBackwards) {
  // Out to 50 mm, back by 10 mm, on to the end: never below the limits, but not forward.
  TimeLaw law2;
  law2.append({0, 0.1, 0, 50, 1000, -10000, 0, 0});
  law2.append({0, 0.1, 50, 50, 0, -1000, 0, 0});
  const Verification v = verdict(contour, machine(2, 1200, 16000), law2);
  EXPECT_FALSE(find(v, "forward motion").passed);
  EXPECT_NEAR(find(v, "forward motion").value, 100, 1e-9);
}

TEST_F(Trapezoid, JerkedPieces) {
  // From rest to rest over 100 mm with jerk ±3.2e5: four phases of T = (100/2/3.2e5)^(1/3); v = jT²; a = jT.
  const double j = 3.2e5, T = std::cbrt(50 / j);
  TimeLaw law3;
  LawState x;
  for (const double sign : {1.0, -1.0, -1.0, 1.0}) {
    LawPiece p{0, T, x.s, 0, x.v, x.a, sign * j, 0};
    x = p.at(T);
    p.s_end = x.s;
    law3.append(p);
  }
  Machine m = machine(2, j * T * T, j * T);
  m.axes[0].jerk = j;
  expect_failed(verdict(contour, m, law3, true), {});
  m.axes[0].jerk = j * (1 - 1e-8);
  expect_failed(verdict(contour, m, law3, true), {"jerk x"});
  expect_failed(verdict(contour, m, law3, false), {});
  m = machine(2, j * T * T * (1 - 1e-8), j * T * (1 - 1e-8));
  expect_failed(verdict(contour, m, law3), {"velocity x", "acceleration x"});
}

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
  expect_failed(verdict(contour, m, steady, true), {"acceleration step at joints", "continuity of acceleration"});
  m.axes[1].jerk *= 1 - 1e-8;
  expect_failed(verdict(contour, m, steady, true),
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

TEST(Verifier, GapInThePath) {
  Contour torn;
  torn.path.append(std::make_shared<Line>(Vec{0, 0, 0}, Vec{40, 0, 0}), 0);
  torn.path.append(std::make_shared<Line>(Vec{40, 1e-5, 0}, Vec{80, 1e-5, 0}), 1);
  torn.blocks.push_back({Mode::cut, unlimited, 0, 2});
  const Verification v = verdict(torn, machine(2, 1800, 16000), law_through(torn.path, {{0, 0}, {40, 500}, {80, 0}}));
  expect_failed(v, {"continuity of position", "distance from contour"});
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

TEST(Verifier, StopsWhenAsked) {
  struct Stopping final : Progress {
    void report(std::string_view, double, std::string_view) override {
      if (++calls == 3) throw Stopped(StopReason::cancelled);
    }
    int calls = 0;
  };
  const Contour circle = reference::circle_between_lines();
  std::vector<Stop> stops;
  for (int i = 0; i <= 20000; ++i) stops.push_back({circle.path.length() * i / 20000, i % 20000 ? 50.0 : 0.0});
  Stopping progress;
  const TimeLaw law = law_through(circle.path, stops);
  const Machine m = machine(2, 1800, 16000);
  EXPECT_THROW(verify_motion({circle, m, law, corner_angle}, progress), Stopped);
}

}  // namespace
}  // namespace bahnwerk
