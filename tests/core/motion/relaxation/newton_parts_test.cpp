// Which parts of a Newton step places take: never more than they can, and gradually along the problem.
#include "core/motion/relaxation/newton_parts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace bahnwerk {
namespace {

constexpr std::size_t places = 400;

/// One place in the middle may take a tenth of a primal step, and half of a dual one.
NewtonParts held_up(bool even) {
  NewtonParts parts;
  parts.begin(places, even);
  for (std::size_t i = 0; i < places; ++i) parts.stop(i, NewtonParts::Both{0.5, 0.25});
  parts.stop(places / 2, NewtonParts::Both{10, 2});
  return parts;
}

TEST(NewtonParts, OnePlaceHoldsUpItsNeighboursAlone) {
  NewtonParts parts = held_up(false);
  parts.taken(0.995);
  EXPECT_NEAR(parts.primal(places / 2), 0.0995, 1e-15);
  EXPECT_NEAR(parts.dual(places / 2), 0.4975, 1e-15);
  EXPECT_EQ(parts.primal(0), 1);
  EXPECT_EQ(parts.dual(places - 1), 1);
  double sum = 0;
  for (std::size_t i = 0; i < places; ++i) {
    sum += parts.primal(i);
    if (i + 1 == places) break;
    EXPECT_LE(std::abs(parts.primal(i + 1) - parts.primal(i)), 0.02 + 1e-15) << i;
    EXPECT_LE(parts.primal(i + 1), 1.05 * parts.primal(i) + 1e-15) << i;
    EXPECT_LE(parts.primal(i), 1.05 * parts.primal(i + 1) + 1e-15) << i;
  }
  EXPECT_NEAR(parts.mean()[0], sum / places, 1e-14);
  EXPECT_GT(parts.mean()[0], 0.8);
}

TEST(NewtonParts, AllPlacesTakeOneStepLengthIfRequested) {
  NewtonParts parts = held_up(true);
  parts.taken(0.995);
  for (std::size_t i = 0; i < places; ++i) {
    EXPECT_NEAR(parts.primal(i), 0.0995, 1e-15);
    EXPECT_NEAR(parts.dual(i), 0.4975, 1e-15);
  }
}

TEST(NewtonParts, TellWhatIsNotANumber) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const bool even : {false, true})
    for (const std::size_t place : {std::size_t{0}, places / 3, places - 1}) {
      NewtonParts parts = held_up(even);
      parts.stop(place, NewtonParts::Both{none, none});
      parts.taken(0.995);
      EXPECT_TRUE(std::isnan(parts.mean()[0])) << even << ' ' << place;
      EXPECT_TRUE(std::isnan(parts.mean()[1])) << even << ' ' << place;
    }
}

TEST(NewtonParts, ProductsCountLessWhereLessOfThePredictorCanBeTaken) {
  for (const bool even : {false, true}) {
    NewtonParts parts = held_up(even);
    parts.predicted();
    EXPECT_NEAR(parts.of_product(places / 2), std::sqrt(0.1 * 0.5), 1e-15);
    EXPECT_NEAR(parts.of_product(0), even ? std::sqrt(0.1 * 0.5) : 1, 1e-15);
  }
}

}  // namespace
}  // namespace bahnwerk
