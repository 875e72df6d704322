#include "core/redundant/known/filters.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

namespace bahnwerk {
namespace {

TEST(Filters, TheLowPassIsSymmetricAndAddsUpToOne) {
  for (const double cutoff : {1.0, 20.0, 200.0}) {
    const std::vector<double> h = low_pass(61, cutoff, 1e-3);
    EXPECT_NEAR(std::accumulate(h.begin(), h.end(), 0.0), 1, 1e-14);
    for (std::size_t j = 0; j < 30; ++j) EXPECT_DOUBLE_EQ(h[j], h[60 - j]);
  }
}

/// What it does to a swinging motion: nothing below the cut-off, almost all of it above.
TEST(Filters, TheLowPassLetsSlowSwingsPassAndTakesQuickOnes) {
  const std::vector<double> h = low_pass(201, 50, 1e-3);
  for (const auto& [frequency, least, most] : {std::array{5.0, 0.99, 1.01}, std::array{150.0, 0.0, 0.003}}) {
    std::vector<double> x(1001);
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] = std::cos(2 * M_PI * frequency * 1e-3 * (static_cast<double>(i) - 500));
    const double gain = std::abs(filtered(x, h)[500]);
    EXPECT_GE(gain, least) << frequency;
    EXPECT_LE(gain, most) << frequency;
  }
}

TEST(Filters, WhatStandsOrMovesEvenlyIsNotDelayed) {
  const std::vector<double> h = low_pass(21, 10, 1e-3);
  std::vector<double> x(100);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = 1e3 + (i < 50 ? 0.0 : 0.7 * (static_cast<double>(i) - 50));
  const std::vector<double> y = filtered(x, h);
  for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(y[i], 1e3);
  for (std::size_t i = 60; i < 89; ++i) EXPECT_NEAR(y[i], x[i], 1e-12);
}

/// T y′ + y = x.
TEST(Filters, ALagFollowsARampByItsTimeConstantAndDecaysByIt) {
  const double T = 0.02, step = 1e-3;
  std::vector<double> x(1000);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = 200 * step * static_cast<double>(std::min<std::size_t>(i, 500));
  const std::vector<double> y = lagged(x, T, step);
  for (std::size_t i = 0; i <= 500; i += 25) {
    const double t = step * static_cast<double>(i);
    EXPECT_NEAR(y[i], 200 * (t - T * (1 - std::exp(-t / T))), 1e-11);
  }
  const double lag = x[500] - y[500];
  for (std::size_t i = 500; i < 1000; i += 50)
    EXPECT_NEAR(x[i] - y[i], lag * std::exp(-step * static_cast<double>(i - 500) / T), 1e-11);
}

}  // namespace
}  // namespace bahnwerk
