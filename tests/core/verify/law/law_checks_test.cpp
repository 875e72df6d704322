// The verifier on laws made by hand along lines: what is right passes, and every kind of fault is caught by the check
// that names it. Corners and curves: verifier_test.cpp.
#include "core/verify/law/law_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/verify/law/verifier.hpp"
#include "tests/core/check_names.hpp"
#include "tests/core/verify/verdicts.hpp"

namespace bahnwerk {
namespace {

using reference::corner_angle;
using reference::edited;
using reference::expect_failed;
using reference::find;
using reference::law_through;
using reference::machine;
using reference::Maker;
using reference::not_a_number;
using reference::Stop;
using reference::verdict;

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
  EXPECT_EQ(check_unit(find(v, "velocity x")), "mm/s");
}

TEST_F(Trapezoid, LimitsHoldToAPartInABillion) {
  expect_failed(verdict(contour, machine(2, 1200 / (1 + 1e-10), 16000 / (1 + 1e-10)), law), {});
  expect_failed(verdict(contour, machine(2, 1200 / (1 + 1e-8), 16000), law), {"velocity x"});
  expect_failed(verdict(contour, machine(2, 1200, 16000 / (1 + 1e-8)), law), {"acceleration x"});
}

TEST_F(Trapezoid, UnlimitedAxesAreNotChecked) {
  const Verification v = verdict(contour, machine(2, unlimited, 16000), law);
  expect_failed(v, {});
  for (const Check& c : v.checks) EXPECT_EQ(check_name(c).find("velocity x"), std::string::npos);
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
        const Verification v =
            verdict(contour, machine(2, 1200, 16000), edited(law, piece, [&](LawPiece& p) { p.*field = poison; }), 3);
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
  expect_failed(verdict(contour, m, law3, 3), {});
  m.axes[0].jerk = j * (1 - 1e-8);
  expect_failed(verdict(contour, m, law3, 3), {"jerk x"});
  expect_failed(verdict(contour, m, law3, false), {});
  m = machine(2, j * T * T * (1 - 1e-8), j * T * (1 - 1e-8));
  expect_failed(verdict(contour, m, law3), {"velocity x", "acceleration x"});
}

TEST(Verifier, GapInThePath) {
  Contour torn;
  torn.path.append(std::make_shared<Line>(Vec{0, 0, 0}, Vec{40, 0, 0}), 0);
  torn.path.append(std::make_shared<Line>(Vec{40, 1e-5, 0}, Vec{80, 1e-5, 0}), 1);
  torn.blocks.push_back({Mode::cut, unlimited, 0, 2});
  const Verification v = verdict(torn, machine(2, 1800, 16000), law_through(torn.path, {{0, 0}, {40, 500}, {80, 0}}));
  expect_failed(v, {"continuity of position", "distance from contour"});
}

TEST(Verifier, StopsWhenAsked) {
  struct Stopping final : ProgressSink {
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
