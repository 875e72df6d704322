#include "core/base/number_text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace bahnwerk {
namespace {

TEST(NumberText, RoundsToTheDigitsAskedFor) {
  EXPECT_EQ(number_text(3.08312, 4), "3.083");
  EXPECT_EQ(number_text(450, 4), "450");
  EXPECT_EQ(number_text(-0.00012345678, 4), "-0.0001235");
}

TEST(NumberText, NumbersThatDifferAreToldApartInEitherOrder) {
  EXPECT_EQ(number_text(3.0831, 3.083, 4), "3.0831");
  EXPECT_EQ(number_text(3.083, 3.0831, 4), "3.083");
  EXPECT_EQ(number_text(90.0000003, 90, 6), "90.0000003");
  EXPECT_EQ(number_text(90, 90.0000003, 6), "90");
  EXPECT_EQ(number_text(3.14, 2.5, 4), "3.14");
  EXPECT_EQ(number_text(2, 2, 4), "2");
  const double next = 1 + std::numeric_limits<double>::epsilon();
  EXPECT_NE(number_text(next, 1, 4), number_text(1, next, 4));
}

}  // namespace
}  // namespace bahnwerk
