// The jerk in space of a motion along a path.
#include "core/verify/law/total_jerk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"
#include "core/geometry/curve/rational.hpp"
#include "core/numeric/random.hpp"
#include "tests/core/cases.hpp"

namespace bahnwerk {
namespace {

Path path_of(std::shared_ptr<const Curve> curve) {
  Path path;
  path.append(std::move(curve), 0);
  return path;
}

verify::Worst peak(const Path& path, const TimeLaw& law) {
  Progress silent;
  ProgressScope progress(silent, "test");
  return verify::total_jerk(path, law, progress);
}

LawPiece over(const Path& path, double v) {
  LawPiece piece;
  piece.v = v, piece.s_end = path.length(), piece.duration = path.length() / v;
  return piece;
}

TEST(TotalJerk, IsTheLawsJerkOnALine) {
  const Path path = path_of(std::make_shared<Line>(Vec{1, 2, 3}, Vec{3, 5, 9}));
  LawPiece piece = over(path, 10);
  piece.j = -60, piece.snap = 100;  // the jerk is largest at the begin
  TimeLaw law;
  law.append(piece);
  EXPECT_NEAR(peak(path, law).value, 60, 1e-5);
  EXPECT_NEAR(peak(path, law).at, 0, 1e-6);
}

/// h‴ = −h′/r²: evenly round it is v³/r², and with a changing speed √((j − v³/r²)² + (3 v a/r)²).
TEST(TotalJerk, IsKnownOnACircle) {
  constexpr double r = 4, v = 10;
  const Path path = path_of(std::make_shared<Arc>(Vec{1, 1, 5}, Vec{1, 0, 0}, Vec{0, 1, 0}, r, 3.0));
  TimeLaw law;
  law.append(over(path, v));
  EXPECT_NEAR(peak(path, law).value, v * v * v / (r * r), 1e-4);
  TimeLaw braking;
  LawPiece piece = over(path, v);
  piece.a = -4;
  piece.duration = (v - std::sqrt(v * v - 8 * path.length())) / 4;
  braking.append(piece);
  EXPECT_NEAR(peak(path, braking).value, std::hypot(v * v * v / (r * r), 3 * v * 4 / r), 1e-4);
}

TEST(TotalJerkProperty, IsNoLessThanAnySampleAndNoMoreThanItNeedBe) {
  Random random(9);
  for (int n = 0; n < testing::cases(100); ++n) {
    std::vector<Vec> points;
    for (int i = 0; i < 6; ++i)
      points.push_back({3.0 * i + random.uniform(-1, 1), random.uniform(-3, 3), random.uniform(-3, 3)});
    const Path path = path_of(std::make_shared<Rational>(Rational::bezier(points)));
    LawPiece piece;
    piece.v = random.uniform(5, 20), piece.a = random.uniform(-5, 5);
    piece.j = random.uniform(-50, 50), piece.snap = random.uniform(-200, 200);
    piece.duration = 0.2;
    piece.s_end = piece.at(piece.duration).s;
    ASSERT_LT(piece.s_end, path.length());
    TimeLaw law;
    law.append(piece);
    double most = 0;
    constexpr int samples = 4000;
    for (int i = 0; i <= samples; ++i) {
      const LawState x = piece.at(piece.duration * i / samples);
      const PathPoint p = path[0].at(x.s);
      most = std::max(most, norm((x.v * x.v * x.v) * p.d3 + (3 * x.v * x.a) * p.d2 + x.j * p.d1));
    }
    const double found = peak(path, law).value;
    EXPECT_GE(found, most * (1 - 1e-10)) << n;
    EXPECT_LE(found, most * (1 + 1e-4)) << n;
  }
}

TEST(TotalJerk, NothingMovesInAnEmptyLaw) {
  EXPECT_EQ(peak(path_of(std::make_shared<Line>(Vec{0, 0}, Vec{1, 0})), TimeLaw{}).value, 0);
}

}  // namespace
}  // namespace bahnwerk
