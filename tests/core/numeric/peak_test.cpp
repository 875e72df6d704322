// The true maximum of a function over an interval: every case is compared with the calculus answer or a dense scan.
#include "core/numeric/peak.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace bahnwerk {
namespace {

double sweep_one(const std::function<double(double)>& f, double a, double b, double scale, bool open = false,
                 PeakSweep* out = nullptr) {
  PeakSweep sweep({scale});
  sweep.sweep(a, b, open, 7, [&](PeakSamples& samples) {
    for (int i = 0; i < samples.rule.points; ++i) samples.values[i] = f(samples.at(i));
    return true;
  });
  if (out) *out = sweep;
  return sweep[0].value;
}

TEST(ChebyshevRule, InterpolatesPolynomialsExactly) {
  for (const ChebyshevRule* rule : {&lobatto_rule(5), &lobatto_rule(9), &lobatto_rule(13), &open_rule()}) {
    const int n = rule->points;
    for (int power = 0; power < n; ++power) {
      // t^p in Bernstein form: b_j = C(j,p)/C(n−1,p).
      for (int j = 0; j < n; ++j) {
        double b = 0, expected = 1;
        for (int i = 0; i < n; ++i) b += rule->bernstein[j][i] * std::pow(rule->node[i], power);
        for (int q = 0; q < power; ++q) expected *= double(j - q) / double(n - 1 - q);
        EXPECT_NEAR(b, expected, n > 9 ? rule->rounding : 2e-13) << n << " " << power << " " << j;
        double integral = 0;
        for (int i = 0; i < n; ++i) integral += rule->integral[j][i] * std::pow(rule->node[i], power);
        EXPECT_NEAR(integral, std::pow(rule->node[j], power + 1) / (power + 1), 1e-14);
      }
      double whole = 0;
      for (int i = 0; i < n; ++i) whole += rule->whole[i] * std::pow(rule->node[i], power);
      EXPECT_NEAR(whole, 1.0 / (power + 1), 1e-14);
    }
  }
}

TEST(PolynomialPeak, FindsInteriorExtremum) {
  // p(t) = 4t(1−t) − 0.2: 0.8 at 1/2, Bernstein −0.2, 1.8, −0.2.
  double c[] = {-0.2, 1.8, -0.2};
  const PolynomialPeak p = polynomial_peak(c, 3, 0);
  EXPECT_NEAR(p.value, 0.8, 1e-15);
  EXPECT_NEAR(p.at, 0.5, 1e-8);
}

TEST(PolynomialPeak, ReturnsTheFloorWhenNothingExceedsIt) {
  double c[] = {-0.2, 1.8, -0.2};
  EXPECT_EQ(polynomial_peak(c, 3, 2).at, -1);
}

TEST(PolynomialPeak, RandomPolynomialsAgainstDenseScan) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int round = 0; round < 3000; ++round) {
    const int n = 2 + round % 8;
    double c[9], copy[9];
    for (int i = 0; i < n; ++i) copy[i] = c[i] = uniform(random) * (round % 3 ? 1 : std::pow(10, -3 * i));
    const PolynomialPeak p = polynomial_peak(copy, n, 0);
    auto at = [&](double t) {
      double b[9];
      for (int i = 0; i < n; ++i) b[i] = c[i];
      for (int r = n - 1; r > 0; --r)
        for (int i = 0; i < r; ++i) b[i] = (1 - t) * b[i] + t * b[i + 1];
      return std::abs(b[0]);
    };
    double scan = 0;
    for (int i = 0; i <= 1000; ++i) scan = std::max(scan, at(i / 1000.0));
    EXPECT_GE(p.value, scan * (1 - 2e-13));
    EXPECT_LE(p.value, scan + 1e-3 * (scan + 1));
    EXPECT_NEAR(p.value, at(p.at), 1e-14);
  }
}

TEST(PeakSweep, SmoothFunctionsAtKnownMaxima) {
  EXPECT_NEAR(sweep_one([](double x) { return std::sin(x); }, 0, 2, 1), 1, 1e-11);
  EXPECT_NEAR(sweep_one([](double x) { return std::sin(x); }, 0, 1e4, 1), 1, 1e-11);
  EXPECT_NEAR(sweep_one([](double x) { return 3 / (1 + 1e4 * (x - 0.3) * (x - 0.3)); }, 0, 1, 1), 3, 1e-10);
  EXPECT_NEAR(sweep_one([](double x) { return x * std::exp(-x); }, 0, 10, 1), std::exp(-1), 1e-11);
  EXPECT_NEAR(sweep_one([](double x) { return -1000 - x; }, 0, 1e-9, 1000), 1000 + 1e-9, 1e-9);
}

TEST(PeakSweep, SeesAPeakBetweenTheSamples) {
  // Rises above the limit by 1e-8 only within a hundredth of the interval.
  const double peak = sweep_one([](double x) { return 1 + 1e-8 - 1e-4 * (x - 0.377) * (x - 0.377); }, 0, 1, 1);
  EXPECT_NEAR(peak, 1 + 1e-8, 1e-13);
}

TEST(PeakSweep, NarrowBumpBesideAHigherPeakIsStillSeen) {
  const auto f = [](double x) { return 0.9 * std::cos(x) + 0.5 * std::exp(-std::pow((x - 1.234) / 0.01, 2)); };
  double scan = 0;
  for (int i = 0; i <= 2000000; ++i) scan = std::max(scan, std::abs(f(i * 1e-6)));
  EXPECT_NEAR(sweep_one(f, 0, 2, 1), scan, 1e-10);
}

TEST(PeakSweep, NeverEvaluatesOpenEnds) {
  // 0/0 at the left end, limit 2.
  PeakSweep sweep({1.0});
  EXPECT_NEAR(sweep_one([](double x) { return std::sin(2 * x) / x; }, 0, 1, 1, true, &sweep), 2, 1e-10);
  EXPECT_TRUE(sweep[0].finite);
}

TEST(PeakSweep, NotANumberIsReportedAndEndsTheSearch) {
  PeakSweep sweep({1.0});
  sweep_one([](double x) { return x > 0.5 ? std::numeric_limits<double>::quiet_NaN() : x; }, 0, 1, 1, false, &sweep);
  EXPECT_FALSE(sweep[0].finite);
  sweep.raise(0, 5, 0, 0);
  EXPECT_FALSE(sweep[0].finite);
}

TEST(PeakSweep, AJumpIsBoundedFromOutsideAndTerminates) {
  const double peak = sweep_one([](double x) { return x < 0.123456 ? 1.0 : 2.0; }, 0, 1, 1);
  EXPECT_GE(peak, 2);
  EXPECT_LE(peak, 60);
}

TEST(PeakSweep, NoiseTerminates) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  PeakSweep sweep({1.0});
  EXPECT_GE(sweep_one([&](double) { return uniform(random); }, 0, 1, 1, false, &sweep), 0.99);
  EXPECT_LT(sweep.evaluations(), 1000000u);
}

TEST(PeakSweep, FaintNoiseIsCheapAndCostsNoAccuracy) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-2e-11, 2e-11);
  PeakSweep sweep({1.0});
  EXPECT_NEAR(sweep_one([&](double x) { return std::cos(x) + uniform(random); }, -0.1, 1, 1, false, &sweep), 1, 5e-10);
  EXPECT_TRUE(sweep[0].finite);
}

TEST(PeakSweep, ACoarserResolutionDoesNotLookIntoNoise) {
  const auto evaluations = [](double resolution) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-1e-9, 1e-9);
    PeakSweep sweep({1.0}, resolution);
    for (std::size_t tag = 0; tag < 100; ++tag)
      sweep.sweep(0, 1, false, tag, [&](PeakSamples& samples) {
        for (int i = 0; i < samples.rule.points; ++i) samples.values[i] = 1 + uniform(random);
        return true;
      });
    EXPECT_NEAR(sweep[0].value, 1, 2e-7);
    return sweep.evaluations();
  };
  EXPECT_EQ(evaluations(1e-7), 500u);
  EXPECT_GT(evaluations(1e-11), 1000u);
}

TEST(PeakSweep, AWildFunctionLeavesEnoughForTheOthers) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1e-3, 1e-3);
  PeakSweep sweep({1.0});
  bool wild = true;
  const auto sample = [&](PeakSamples& samples) {
    for (int i = 0; i < samples.rule.points; ++i) samples.values[i] = wild ? uniform(random) : std::sin(samples.at(i));
    return true;
  };
  for (int i = 0; i < 5; ++i) sweep.sweep(0, 1, false, 0, sample);
  wild = false;
  sweep.sweep(0, 100, false, 1, sample);
  EXPECT_NEAR(sweep[0].value, 1, 1e-10);
  EXPECT_EQ(sweep[0].tag, 1u);
}

/// Where the caller asks, fewer samples are taken where they may settle an interval, and nowhere else.
TEST(PeakSweep, FewSamplesOnlyWhereTheyMayDo) {
  const auto evaluations = [](double below, bool ask) {
    PeakSweep sweep({1.0});
    sweep.raise(0, 1, 0, 0);
    for (std::size_t k = 1; k <= 100; ++k)
      sweep.sweep(0, 1, false, k, [&](PeakSamples& samples) {
        const int points = samples.rule.points;
        samples.missing[0] = points == 5 ? 0.1 : points == 9 ? 0.01 : 1e-12;
        if (ask && samples.more && !sweep.promising(samples.missing)) return samples.empty = true, false;
        std::fill_n(samples.values, samples.rule.points, 1 - below);
        return true;
      });
    EXPECT_EQ(sweep[0].value, 1);
    return sweep.evaluations();
  };
  EXPECT_EQ(evaluations(0.7, true), 13u + 99u * 5u);  // nothing is known of the first one's neighbours
  EXPECT_EQ(evaluations(0.05, true), 13u + 99u * 9u);
  EXPECT_EQ(evaluations(0.001, true), 100u * 13u);
  EXPECT_GT(evaluations(0.05, false), 100u * 9u);
}

/// Bernstein coefficients of an arch lie above it: where the arch stays below the peak so far nothing is halved for
/// their sake, unless what may be missing reaches it.
TEST(PeakSweep, AnArchBelowThePeakIsNotHalved) {
  const auto evaluations = [](double missing) {
    PeakSweep sweep({1.0});
    sweep.raise(0, 1, 0, 0);
    sweep.sweep(0, 1, false, 1, [&](PeakSamples& samples) {
      for (int i = 0; i < samples.rule.points; ++i) {
        const double x = 2 * samples.at(i) - 1;
        samples.values[i] = 0.999 - 0.5 * x * x;
      }
      samples.missing[0] = missing * (samples.end - samples.begin);
      return true;
    });
    EXPECT_LE(sweep[0].value, 1.0 + 1e-11);
    return sweep.evaluations();
  };
  EXPECT_EQ(evaluations(0.0009), 5u);
  EXPECT_GT(evaluations(0.0011), 14u);
}

TEST(PeakSweep, RoundingOfSamplesIsAdded) {
  for (const double rounding : {0.0, 1e-9}) {
    PeakSweep sweep({1.0}, 1e-8, rounding);
    sweep.sweep(0, 1, false, 0, [](PeakSamples& samples) {
      for (int i = 0; i < samples.rule.points; ++i) samples.values[i] = 3 * samples.at(i);
      samples.missing[0] = 0;
      return true;
    });
    // That of the coefficients alone is less than 1e-12, which peaks are resolved to.
    const double counted = rounding > 0 ? rounding + lobatto_rule(5).rounding : 0;
    EXPECT_NEAR(sweep[0].value, 3 * (1 + counted), 1e-14);
  }
}

TEST(PeakSweep, SeveralChannelsAndTheTagOfThePeak) {
  PeakSweep sweep({1, 1, 1});
  for (std::size_t k = 0; k < 10; ++k)
    sweep.sweep(double(k), double(k) + 1, false, k, [](PeakSamples& samples) {
      for (int i = 0; i < samples.rule.points; ++i) {
        const double x = samples.at(i);
        samples.values[i] = std::sin(x);
        samples.values[samples.rule.points + i] = std::exp(-x / 3) * x;
        samples.values[2 * samples.rule.points + i] = 4.25;
      }
      return true;
    });
  EXPECT_NEAR(sweep[0].value, 1, 1e-11);
  EXPECT_NEAR(sweep[1].value, 3 * std::exp(-1.0), 1e-11);
  EXPECT_NEAR(sweep[1].at, 3, 1e-4);
  EXPECT_EQ(sweep[2].value, 4.25);
  EXPECT_EQ(sweep[2].tag, 0u);
}

}  // namespace
}  // namespace bahnwerk
