#include "core/redundant/iterative/knot_choice.hpp"

#include <gtest/gtest.h>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

/// Inner knots as places of a choice over [0, places + 1].
std::vector<double> inner(const KnotChoice& c, std::size_t degree) {
  const std::vector<double> k = c.knots();
  return {k.begin() + static_cast<std::ptrdiff_t>(degree) + 1, k.end() - static_cast<std::ptrdiff_t>(degree) - 1};
}

TEST(KnotChoice, CountsWhatInterpolatesWithTheEnds) {
  // n = n_t + 2 control points, n + m + 1 knots, 2 (m + 1) of them at the ends [Bock 4.2.3].
  EXPECT_EQ(KnotChoice::interpolating(20, 3, 1), 18u);
  EXPECT_EQ(KnotChoice::interpolating(20, 3, 2), 9u);
  EXPECT_EQ(KnotChoice::interpolating(2, 4, 1), 0u);
}

TEST(KnotChoice, DividesTheWideGapWhereTheErrorIs) {
  KnotChoice c(40, 39, 3, 1, 6);
  EXPECT_TRUE(c.insert(5));
  EXPECT_EQ(inner(c, 3), std::vector<double>({20}));
  EXPECT_TRUE(c.insert(5));
  EXPECT_EQ(inner(c, 3), std::vector<double>({10, 20}));
  EXPECT_TRUE(c.insert(12));
  EXPECT_EQ(inner(c, 3), std::vector<double>({10, 15, 20}));
}

TEST(KnotChoice, ANarrowGapLeavesItToAWiderNeighbour) {
  KnotChoice c(40, 39, 3, 1, 6);
  for (const double t : {20.0, 10.0, 12.0}) c.insert(t);  // 20; its left neighbour 10; 15
  ASSERT_EQ(inner(c, 3), std::vector<double>({10, 15, 20}));
  EXPECT_TRUE(c.insert(16));  // four free places there: the right neighbour has nineteen
  EXPECT_EQ(inner(c, 3), std::vector<double>({10, 15, 20, 30}));
}

TEST(KnotChoice, AtAChosenPlaceTheWiderSideIsDivided) {
  KnotChoice c(40, 39, 3, 1, 6);
  c.insert(20), c.insert(10);
  EXPECT_TRUE(c.insert(20));
  EXPECT_EQ(inner(c, 3), std::vector<double>({10, 20, 30}));
}

TEST(KnotChoice, EndsWithAllPlaces) {
  Random random(2);
  KnotChoice c(1, 50, 4, 2, 6);
  int n = 0;
  while (c.insert(random.uniform())) ++n;
  EXPECT_EQ(n, 50);
  EXPECT_TRUE(c.full());
  EXPECT_FALSE(c.insert_in_widest());
  EXPECT_EQ(c.knots().size(), 110u);
}

TEST(KnotChoice, SeveralAtOnceOnlyFarApart) {
  KnotChoice c(1000, 999, 3, 1, 6);
  c.choose_evenly(99);
  ASSERT_EQ(c.chosen(), 99u);
  EXPECT_EQ(c.insert_apart({505, 515, 105, 995}, 4), 3u);  // 515 is next to 505
  EXPECT_EQ(c.chosen(), 102u);
  EXPECT_EQ(c.insert_apart({515}, 4), 1u);
}

/// The gap at the error has a neighbour four times as long: that one is divided, though the gap is wide enough itself.
TEST(KnotChoice, GradedGapsAreNoNeighboursOfMuchLongerOnes) {
  for (const double grading : {0.0, 1.5}) {
    KnotChoice c(400, 399, 3, 1, 6, grading);
    c.choose_nearest({40, 50, 60, 70, 80});  // 40, 10, 10, 10, 10, 320
    EXPECT_TRUE(c.insert(75));
    EXPECT_EQ(inner(c, 3), grading > 0 ? std::vector<double>({40, 50, 60, 70, 80, 240})
                                       : std::vector<double>({40, 50, 60, 70, 75, 80}));
    EXPECT_TRUE(c.insert(65));  // no neighbour is longer
    EXPECT_EQ(inner(c, 3)[3], 65);
  }
}

TEST(KnotChoice, ChoosesTheNearestPlacesOnce) {
  KnotChoice c(40, 39, 3, 1, 6);
  c.insert(5);
  c.choose_nearest({-1, 0.2, 3.4, 3.6, 19.9, 39.9, 50});
  EXPECT_EQ(inner(c, 3), std::vector<double>({3, 4, 20}));
}

TEST(KnotChoice, EvenChoices) {
  KnotChoice c(10, 9, 2, 1, 6);
  c.choose_evenly(4);
  EXPECT_EQ(inner(c, 2), std::vector<double>({2, 4, 6, 8}));
  c.choose_evenly(100);
  EXPECT_TRUE(c.full());
}

}  // namespace
}  // namespace bahnwerk
