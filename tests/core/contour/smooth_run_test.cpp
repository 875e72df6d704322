// Runs longer than one window of the spline.
#include "core/contour/blend/smooth_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/contour/blend/reversed_run.hpp"
#include "core/contour/blend/smooth_scale.hpp"
#include "core/contour/polyline.hpp"
#include "core/machine/machine.hpp"
#include "tests/core/silent_scope.hpp"

namespace bahnwerk::blending {
namespace {

constexpr double tolerance = 0.005;

/// Chords of 0.05 mm of a winding curve, rounded to 1 µm; at some of them it goes back where it came from.
std::vector<Vec> chords(int n, const std::vector<int>& reversals = {}) {
  std::vector<Vec> points;
  Vec at;
  double turned = 0;
  for (int i = 0; i <= n; ++i) {
    points.push_back({std::round(at.x * 1e3) * 1e-3, std::round(at.y * 1e3) * 1e-3, 0});
    if (std::find(reversals.begin(), reversals.end(), i) != reversals.end()) turned += std::numbers::pi;
    const double heading = turned + 2 * std::sin(0.004 * i) + std::sin(0.0011 * i);
    at += 0.05 * Vec{std::cos(heading), std::sin(heading), 0};
  }
  return points;
}

struct Smoothable {
  explicit Smoothable(const std::vector<Vec>& points) : contour(polyline(2, points, false, unlimited)) {
    auto list = element_runs(contour.path, 0, contour.path.size(), std::vector<std::size_t>(contour.path.size(), 0),
                             {1e-6, 4.0}, silent_scope());
    EXPECT_EQ(list.size(), 1u);
    stretch = list[0];
  }
  SmoothedRun smoothed(double a, double b, bool rests = false) const {
    return smooth_run(stretch, {a, b, false, false}, {}, {{0.97 * tolerance, tolerance}, 2, rests}, silent_scope());
  }
  Contour contour;
  ElementRun stretch;
};

/// Largest |f'''| between two places, f over the length of the contour.
double roughest(const SmoothedRun& run, double from, double to) {
  double most = 0;
  for (std::size_t k = 0; k < run.pieces.size(); ++k) {
    const double h = run.breaks[k + 1] - run.breaks[k], u0 = run.pieces[k]->begin(), du = run.pieces[k]->end() - u0;
    if (run.breaks[k] < from || run.breaks[k + 1] > to) continue;
    for (const double x : {0.0, 0.25, 0.5, 0.75, 1.0})
      most = std::max(most, norm(run.pieces[k]->at(u0 + x * du).d3) * std::pow(du / h, 3));
  }
  return most;
}

TEST(SmoothRun, WindowsJoinWithThreeDerivatives) {
  const Smoothable long_run(chords(20000));
  const double length = long_run.stretch.length();
  const SmoothedRun run = long_run.smoothed(0, length);
  ASSERT_TRUE(run.done);
  ASSERT_GT(run.pieces.size(), 3000u);  // several windows
  ASSERT_EQ(run.breaks.size(), run.pieces.size() + 1);
  EXPECT_EQ(run.breaks.front(), 0);
  EXPECT_EQ(run.breaks.back(), length);
  for (std::size_t k = 0; k < run.pieces.size(); ++k) {
    const double h = run.breaks[k + 1] - run.breaks[k], u0 = run.pieces[k]->begin(), du = run.pieces[k]->end() - u0;
    for (const double x : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0})
      EXPECT_LE(norm(run.pieces[k]->at(u0 + x * du).value - point_of(long_run.stretch, run.breaks[k] + x * h)),
                tolerance);
    if (k == 0) continue;
    const double before = run.breaks[k] - run.breaks[k - 1],
                 span = run.pieces[k - 1]->end() - run.pieces[k - 1]->begin();
    const Jet a = run.pieces[k - 1]->at(run.pieces[k - 1]->end()), b = run.pieces[k]->at(u0);
    EXPECT_LE(norm(a.value - b.value), 1e-11);
    EXPECT_LE(norm(a.d1 * (span / before) - b.d1 * (du / h)), 1e-10);
    EXPECT_LE(norm(a.d2 * std::pow(span / before, 2) - b.d2 * std::pow(du / h, 2)), 1e-8);
    EXPECT_LE(norm(a.d3 * std::pow(span / before, 3) - b.d3 * std::pow(du / h, 3)), 1e-6);
  }
}

TEST(SmoothRun, BackwardsItBecomesTheSameCurve) {
  for (const int n : {400, 5000}) {  // one window, and several
    std::vector<Vec> points = chords(n);
    const Smoothable there(points);
    std::reverse(points.begin(), points.end());
    const Smoothable back(points);
    const double length = there.stretch.length();
    const SmoothedRun a = there.smoothed(0, length), b = back.smoothed(0, length);
    ASSERT_TRUE(a.done && b.done);
    const std::size_t count = a.pieces.size();
    ASSERT_EQ(b.pieces.size(), count);
    for (std::size_t k = 0; k < count; ++k) {
      const Rational &p = *a.pieces[k], &q = *b.pieces[count - 1 - k];
      EXPECT_NEAR(a.breaks[k], length - b.breaks[count - k], 1e-9);
      for (const double x : {0.0, 0.3, 0.8})
        EXPECT_LE(
            norm(p.at(p.begin() + x * (p.end() - p.begin())).value - q.at(q.end() - x * (q.end() - q.begin())).value),
            1e-8);
    }
  }
}

TEST(SmoothRun, ACutBetweenWindowsBendsNothing) {
  // Round and round on a circle every place is like any other.
  std::vector<Vec> points;
  for (int i = 0; i <= 24000; ++i) {
    const Vec p = 10 * Vec{std::cos(0.005 * i), std::sin(0.005 * i), 0};
    points.push_back({std::round(p.x * 1e3) * 1e-3, std::round(p.y * 1e3) * 1e-3, 0});
  }
  const Smoothable circle(points);
  const SmoothedRun run = circle.smoothed(0, circle.stretch.length());
  ASSERT_TRUE(run.done);
  ASSERT_GT(run.pieces.size(), 3000u);  // several windows
  const double usual = roughest(run, run.breaks[100], run.breaks[900]);
  EXPECT_LE(roughest(run, run.breaks[900], run.breaks[run.pieces.size() - 100]), 1.01 * usual);
}

TEST(SmoothRun, RestsWhereItCannotBeSmoothed) {
  const std::vector<int> places{700, 9000, 17000};
  const Smoothable reversing(chords(20000, places));
  const SmoothedRun run = reversing.smoothed(0, reversing.stretch.length());
  ASSERT_TRUE(run.done);
  std::size_t rests = 0;
  for (std::size_t k = 1; k < run.pieces.size(); ++k) {
    ASSERT_TRUE(run.pieces[k - 1] && run.pieces[k]);
    const Jet a = run.pieces[k - 1]->at(run.pieces[k - 1]->end()), b = run.pieces[k]->at(run.pieces[k]->begin());
    EXPECT_LE(norm(a.value - b.value), 1e-11);
    if (norm(a.d1 / norm(a.d1) - b.d1 / norm(b.d1)) < 1e-6) continue;
    ++rests;
    EXPECT_TRUE(std::any_of(places.begin(), places.end(), [&](int place) {
      return std::abs(run.breaks[k] - reversing.stretch.elements[static_cast<std::size_t>(place)].begin) < 1;
    })) << run.breaks[k];
  }
  EXPECT_GE(rests, places.size());
  EXPECT_LE(rests, 2 * places.size());
}

TEST(SmoothRun, TellsWhereAShortOneCannotBeSmoothed) {
  const Smoothable reversing(chords(1000, {700}));
  const SmoothedRun run = reversing.smoothed(0, reversing.stretch.length());
  ASSERT_FALSE(run.done);
  ASSERT_FALSE(run.failure_positions.empty());
  for (const double s : run.failure_positions) EXPECT_LT(std::abs(s - reversing.stretch.elements[700].begin), 1);
  EXPECT_TRUE(reversing.smoothed(0, reversing.stretch.length(), true).done);
}

}  // namespace
}  // namespace bahnwerk::blending
