// The bounds of interpolation errors hold against the errors themselves, found densely, and are worth having.
#include "core/verify/law/channel_bounds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <random>

#include "core/geometry/path/path.hpp"
#include "core/numeric/peak.hpp"
#include "tests/core/verify/law/random_rational.hpp"

namespace bahnwerk::verify {
namespace {

using Channels = std::array<double, 3>;  // v², a, j² of x

/// Largest |f − interpolant| per channel over [0, 1], and the largest |f|.
std::pair<Channels, Channels> errors(const ChebyshevRule& rule, const std::function<Channels(double)>& f) {
  std::array<Channels, ChebyshevRule::max_points> at;
  for (int i = 0; i < rule.points; ++i) at[i] = f(rule.node[i]);
  Channels worst{}, most{};
  for (int k = 0; k <= 60; ++k) {
    const double t = k / 60.0, x = std::acos(2 * t - 1);
    const Channels truth = f(t);
    for (std::size_t c = 0; c < 3; ++c) {
      double p = 0;
      for (int j = 0; j < rule.points; ++j) {
        double coefficient = 0;
        for (int i = 0; i < rule.points; ++i) coefficient += rule.chebyshev[j][i] * at[i][c];
        p += coefficient * std::cos(j * x);
      }
      worst[c] = std::max(worst[c], std::abs(p - truth[c]));
      most[c] = std::max(most[c], std::abs(truth[c]));
    }
  }
  return {worst, most};
}

Channels channels(const PathPoint& h, const LawState& x) {
  const double v = h.d1.x * x.v, a = h.d2.x * x.v * x.v + h.d1.x * x.a,
               j = h.d3.x * x.v * x.v * x.v + 3 * h.d2.x * x.v * x.a + h.d1.x * x.j;
  return {v * v, a, j * j};
}

struct Tally {
  std::size_t bounds = 0, useful = 0;
  void hold(const ChannelBounds& bound, const std::pair<Channels, Channels>& found, double noise) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (!std::isfinite(bound[c])) continue;
      EXPECT_LE(found.first[c], bound[c] + noise * found.second[c]) << "channel " << c;
      ++bounds;
      useful += bound[c] < 1e-4 * found.second[c];
    }
  }
};

TEST(ChannelBounds, HoldOverTheParameter) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> uniform(0, 1);
  Tally tally;
  for (int round = 0; round < 400; ++round) {
    const Rational curve = test::random_rational(random, round);
    const Segment segment(std::make_shared<Rational>(curve), 0, 0);
    CurveDiscs discs(curve);
    for (const ChebyshevRule* rule : {&lobatto_rule(5), &lobatto_rule(9), &lobatto_rule(13), &open_rule()}) {
      const double half = 0.5 * std::pow(10, -2.5 * uniform(random)), middle = half + (1 - 2 * half) * uniform(random);
      const double s0 = segment.travelled(middle - half), way = segment.travelled(middle + half) - s0;
      const double b0 = 1e4 * uniform(random), b1 = 1e4 * uniform(random), a = (b1 - b0) / (2 * way);
      const auto f = [&](double t) {
        const double u = middle + (2 * t - 1) * half, b = b0 + 2 * a * (segment.travelled(u) - s0);
        return channels(segment.at_parameter(u), {0, std::sqrt(b), a, 0});
      };
      const ChannelBounds bound =
          bounds_over_parameter(std::max(b0, b1), a, half, discs.about(middle), rule->points, false);
      tally.hold(bound, errors(*rule, f), 1e-9);
      if (testing::Test::HasFailure()) FAIL() << "round " << round << ", " << rule->points << " points";
    }
  }
  EXPECT_GT(tally.bounds, 1500u);
  EXPECT_GT(tally.useful, 700u);
}

TEST(ChannelBounds, HoldOverTime) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Tally tally;
  for (int round = 0; round < 600; ++round) {
    const Rational curve = test::random_rational(random, round);
    const Segment segment(std::make_shared<Rational>(curve), 0, 0);
    CurveDiscs discs(curve);
    const double T = 0.02 * std::pow(10, 1.5 * uniform(random));
    const double v = segment.length() / T * std::pow(10, -2 + uniform(random));
    const LawPiece middle{0,
                          2 * T,
                          segment.length() * (0.5 + 0.3 * uniform(random)),
                          0,
                          v,
                          v / T * uniform(random),
                          v / (T * T) * uniform(random),
                          0,
                          v / (T * T * T) * uniform(random)};
    for (const ChebyshevRule* rule : {&lobatto_rule(5), &lobatto_rule(9), &lobatto_rule(13)}) {
      const auto f = [&](double t) {
        const LawState x = middle.at((2 * t - 1) * T);
        return channels(segment.at_parameter(segment.parameter_at(x.s)), x);
      };
      const ChannelBounds bound =
          bounds_over_time(middle, T, discs.about(segment.parameter_at(middle.s)), rule->points);
      tally.hold(bound, errors(*rule, f), 1e-8);
      if (testing::Test::HasFailure()) FAIL() << "round " << round << ", " << rule->points << " points";
    }
  }
  EXPECT_GT(tally.bounds, 1500u);
  EXPECT_GT(tally.useful, 300u);
}

TEST(ChannelBounds, NothingIsKnownWhereTheDiscDoesNotCoverTheInterval) {
  const Rational curve = Rational::from_power_basis({{0, 1}, {0, 0, 1}});
  CurveDiscs discs(curve);
  for (const double bound : bounds_over_parameter(1, 1, 0.5, discs.about(0.5), 9, false))
    EXPECT_TRUE(std::isinf(bound));
  for (const double bound : bounds_over_time({0, 2, 0.5, 1, 1, 1, 1}, 1, discs.about(0.5), 9))
    EXPECT_TRUE(std::isinf(bound));
}

/// A disc a little smaller leaves a little less known, wherever its border lies between powers of two.
TEST(ChannelBounds, UseAllOfTheDisc) {
  CurveDisc disc{0, 1, 1, 1e-2, 1e-4, 1, 1};
  for (const LawPiece& piece : {LawPiece{0, 2e-3, 0, 0.2, 100, 10, 0}, LawPiece{0, 2e-3, 0, 0, 0, 0, 1e8},
                                LawPiece{0, 2e-3, 0, 0, 0, 0, 0, 0, 1e11}}) {
    double before = 0;
    for (disc.radius = 1; disc.radius < 2.1; disc.radius += 0.05) {
      const double bound = bounds_over_time(piece, 1e-3, disc, 9)[0];
      ASSERT_TRUE(std::isfinite(bound)) << disc.radius;
      if (before > 0) {
        EXPECT_LT(bound, before) << disc.radius;
        EXPECT_GT(bound, before / 3) << disc.radius;
      }
      before = bound;
    }
  }
}

TEST(ChannelBounds, ALawIsTheSameAboutAnotherPlace) {
  const LawPiece piece{0, 2, 1, 9, 2, 3, -4, 0, 5}, other = moved(piece, 0.7);
  EXPECT_NEAR(other.at(0.5).s, piece.at(1.2).s, 1e-14);
  EXPECT_NEAR(other.at(0.5).j, piece.at(1.2).j, 1e-14);
}

}  // namespace
}  // namespace bahnwerk::verify
