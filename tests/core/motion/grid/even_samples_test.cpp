#include "core/motion/grid/even_samples.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace bahnwerk {
namespace {

template <class F>
std::array<double, 5> samples(F f) {
  std::array<double, 5> list{};
  for (std::size_t i = 0; i < 5; ++i) list[i] = f(-1 + 0.5 * static_cast<double>(i));
  return list;
}

TEST(EvenSamples, PeakOfAParabolaIsFoundBetweenSamples) {
  const EvenSamples<double> found(samples([](double x) { return 3 - (x - 0.2) * (x - 0.2); }), 0.0);
  EXPECT_LT(found.most, 3);
  EXPECT_NEAR(found.between, 3, 1e-14);
  EXPECT_NEAR(found.third, 0, 1e-14);
  EXPECT_GE(found.peak(), 3);
}

TEST(EvenSamples, BelowWorthNothingIsLookedForBetween) {
  const auto f = samples([](double x) { return 3 - (x - 0.2) * (x - 0.2); });
  const EvenSamples<double> found(f, 3);
  EXPECT_EQ(found.between, found.most);
  EXPECT_EQ(found.third, 0);
}

TEST(EvenSamples, PeakWithItsReserveCoversWavesUpToAQuarterPeriod) {
  for (int k = 0; k < 200; ++k) {
    const double phase = 0.0314 * k;
    const auto f = samples([&](double x) { return std::sin(0.785 * x + phase); });
    double peak = 0;
    for (int i = -1000; i <= 1000; ++i) peak = std::max(peak, std::abs(std::sin(0.785e-3 * i + phase)));
    EXPECT_GE(EvenSamples<double>(f, 0.0).peak(), peak * (1 - 1e-3)) << phase;
    EXPECT_LE(EvenSamples<double>(f, 0.0).peak(), peak * 1.01) << phase;
  }
}

}  // namespace
}  // namespace bahnwerk
