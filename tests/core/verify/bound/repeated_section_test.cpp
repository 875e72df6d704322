// One bound for sections that are the same but for their place; what a difference may be worth.
#include "core/verify/bound/repeated_section.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/verify/bound/lower_bound.hpp"
#include "tests/core/motion/sheet.hpp"
#include "tests/core/verify/reference.hpp"

namespace bahnwerk {
namespace {

using reference::Maker;
using verify::repeat_margin;

constexpr double corner_angle = 2e-3;
const Machine plain{{{"x", 1800, 16000, unlimited}, {"y", 1500, 9000, unlimited}}, 0.001},
    smooth{{{"x", 1800, 16000, 1e6}, {"y", 1500, 9000, 5e5}}, 0.001};

double bound(const Contour& contour, const Machine& machine) {
  Progress silent;
  return lower_bound(contour, machine, corner_angle, silent).value;
}
/// Of the curve [0, n) against [n, 2 n).
double margin(const AxisPath& path, const Machine& machine, const std::vector<double>& feeds, std::size_t n) {
  Progress silent;
  ProgressScope progress(silent, "test");
  return repeat_margin(path, machine, feeds, {0, n, n}, progress);
}
double margin(const Contour& contour, const Machine& machine) {
  const CartesianAxisPath path(contour.path, 2);
  const std::size_t n = contour.path.size() / 2;
  return margin(path, machine, contour.feeds(), n);
}
/// Two full circles; nothing leads from one to the other.
Contour circles(Vec a, double r, Vec b, double R) {
  Contour one = Maker(2, a + Vec{r, 0, 0}).arc(a + Vec{r, 0, 0}, a, true).done();
  const Vec begin = b + Vec{R, 0, 0};
  one.path.append(std::make_shared<Arc>(Arc::through(begin, begin, b, {0, 0, 1}, true)), 1);
  one.blocks.back().last = 2;
  return one;
}

TEST(RepeatedSection, TheSameToTheLastBitCostsNothing) {
  EXPECT_EQ(margin(circles({0, 0}, 2.5, {10, 30}, 2.5), plain), 0);
  EXPECT_EQ(margin(circles({0, 0}, 2.5, {10, 30}, 2.5), smooth), 0);
}

TEST(RepeatedSection, RoundingCostsNextToNothing) {
  for (const Machine& machine : {plain, smooth}) {
    const double most = margin(circles({0.3, 0.7}, 1.7, {910.16, 30.1}, 1.7), machine);
    EXPECT_GT(most, 0);
    EXPECT_LT(most, 1e-10);
  }
}

TEST(RepeatedSection, OtherCurvesDoNotMatch) {
  EXPECT_EQ(margin(circles({0, 0}, 2.5, {10, 30}, 2.6), plain), unlimited);
  const Contour two = circles({}, 2.5, {10, 30}, 2.5);
  const CartesianAxisPath axes(two.path, 2);
  EXPECT_EQ(margin(axes, plain, {100, 101}, 1), unlimited);
  EXPECT_EQ(margin(axes, plain, {100, 100}, 1), 0);
}

// Known without a limit of jerk along one axis: nothing is known of the jerk along the path.
TEST(RepeatedSection, OneAxisWithoutJerkMatchesOnlyExactly) {
  Machine half = smooth;
  half.axes[1].jerk = unlimited;
  EXPECT_EQ(margin(circles({0, 0}, 2.5, {10, 30}, 2.5), half), 0);
  EXPECT_EQ(margin(circles({0.3, 0.7}, 1.7, {910.16, 30.1}, 1.7), half), unlimited);
}

// Curves that differ by 1e-8: their shortest times may not differ by more than the margin says, nor is it useless.
TEST(RepeatedSection, TheMarginCoversWhatADifferenceDoes) {
  for (const double off : {1e-8, -1e-8})
    for (const Machine& machine : {plain, smooth}) {
      const double one = bound(Maker(2, {2.5, 0}).arc({2.5, 0}, {0, 0}, true).done(), machine);
      const double R = 2.5 * (1 + off), other = bound(Maker(2, {R, 0}).arc({R, 0}, {0, 0}, true).done(), machine);
      const double most = margin(circles({0, 0}, 2.5, {10, 30}, R), machine);
      EXPECT_LT(std::abs(other - one), most * one);
      EXPECT_LT(most, 1e-4);
    }
}

// A sheet's bound is that of its holes, each alone, and of the moves between them.
TEST(RepeatedSection, ASheetTakesAsLongAsItsHoles) {
  for (const test::Hole hole : {test::Hole::circle, test::Hole::slot, test::Hole::free_form})
    for (const Machine& machine : {plain, smooth}) {
      constexpr int n = 30;
      const double one = bound(test::sheet(hole, 0, 1), machine), all = bound(test::sheet(hole, 0, n), machine);
      double moves = 0;
      for (int i = 1; i < n; ++i) {
        const Vec from = test::centre(i - 1), to = test::centre(i);
        moves += bound(Maker(2, from).line(to).done(), machine);
      }
      EXPECT_NEAR(all, n * one + moves, 2e-11 * all);
      EXPECT_LE(all, (n * one + moves) * (1 + 1e-12));
    }
}

}  // namespace
}  // namespace bahnwerk
