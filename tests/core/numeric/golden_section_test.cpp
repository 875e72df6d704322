#include "core/numeric/golden_section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace bahnwerk {
namespace {

TEST(GoldenSection, FindsTheLargestValueWhereverItLies) {
  for (int i = 0; i <= 100; ++i) {
    const double top = -3 + 0.07 * i;
    const auto found = golden_section([&](double x) { return 5 - std::abs(x - top) * (1 + (x > top)); }, -3, 4, 1e-9);
    EXPECT_NEAR(found.at, top, 1e-9) << i;
    EXPECT_NEAR(found.value, 5, 4e-9) << i;
  }
}

TEST(GoldenSection, TakesWhatIsImpossibleAsLess) {
  const auto found =
      golden_section([](double x) { return x < 2 ? -std::numeric_limits<double>::infinity() : -x; }, 0, 10, 1e-8);
  EXPECT_NEAR(found.at, 2, 1e-8);
}

TEST(GoldenSection, EvaluatesOncePerStep) {
  int calls = 0;
  golden_section([&](double x) { return ++calls, -x * x; }, -1, 1, 1e-6);
  EXPECT_LE(calls, 2 + static_cast<int>(std::ceil(std::log(1e-6 / 2) / std::log(0.618))) + 1);
}

}  // namespace
}  // namespace bahnwerk
