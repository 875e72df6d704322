// One step of the polynomial interpolator against appendix B, written out, and against chords of known curves.
#include "core/motion/interpolation/quartic_step.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/curve/rational.hpp"
#include "core/numeric/random.hpp"
#include "tests/core/motion/interpolation/moved.hpp"

namespace bahnwerk {
namespace {

/// (4.65) as it stands: numerator and denominator developed, the distance from the point at u.
double developed_distance(Vec z0, const QuotientJet& jet, double step) {
  const Vec place = (1 / jet.n0) * z0, d1 = jet.z1 + jet.n1 * place, d2 = jet.z2 + jet.n2 * place;  // Z′, Z″ themselves
  const Vec z = z0 + step * d1 + (step * step / 2) * d2;
  const double n = jet.n0 + step * jet.n1 + step * step / 2 * jet.n2;
  return norm((1 / n) * z - place);
}

TEST(QuarticStep, TheDevelopedCurveIsAsFarAsWanted) {
  Random random(7);
  int none = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto vec = [&](double size) {
      return Vec{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
    };
    QuotientJet jet{vec(30), vec(100), random.uniform(0.3, 3), random.uniform(-2, 2), random.uniform(-4, 4)};
    const double length = std::pow(10, random.uniform(-6, 0)) * norm(jet.z1) / jet.n0;
    const auto step = quartic_step(jet, length, 1);
    if (!step) {
      // Nowhere within the bound is it so far.
      ++none;
      for (int k = 1; k <= 1000; ++k) ASSERT_LT(developed_distance(vec(1), jet, k * 1e-3), length * (1 + 1e-9));
      continue;
    }
    EXPECT_GT(*step, 0);
    EXPECT_NEAR(developed_distance(vec(5), jet, *step), length, 1e-9 * length + 1e-13) << i;
  }
  EXPECT_GT(none, 10);
}

TEST(QuarticStep, ItIsTheFirstPlaceThatIsSoFar) {
  // A parabola that turns back: (Δu − Δu²)² = 0.04 also at 0.72 and 1.17.
  const QuotientJet jet{{1, 0, 0}, {-2, 0, 0}, 1, 0, 0};
  EXPECT_NEAR(quartic_step(jet, 0.2, 10).value(), (1 - std::sqrt(0.2)) / 2, 1e-15);
  EXPECT_NEAR(quartic_step(jet, 0.249999, 10).value(), 0.5 - 1e-3, 1e-9);            // two roots close to each other
  EXPECT_FALSE(quartic_step(jet, 0.3, 1).has_value());                               // its farthest place is 0.25 away
  EXPECT_NEAR(quartic_step(jet, 0.3, 10).value(), (1 + std::sqrt(2.2)) / 2, 1e-14);  // behind where it began
  EXPECT_FALSE(quartic_step(jet, 0.2, 0.27).has_value());
}

TEST(QuarticStep, ChordsOfConicsAreExact) {
  // Numerator and denominator of a conic are quadratic: its development is itself.
  const auto path = test::path_of({test::quarter_ellipse(30, 12)});
  const PieceSeries series(*path);
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const double u = random.uniform(0, 0.9), length = std::pow(10, random.uniform(-7, 0));
    const auto step = quartic_step(series.at(0, u), length, 1 - u);
    ASSERT_TRUE(step.has_value());
    const Curve& curve = (*path)[0].curve();
    EXPECT_NEAR(norm(curve.at(u + *step).value - curve.at(u).value), length, 1e-13 * 30) << u << ' ' << length;
  }
}

}  // namespace
}  // namespace bahnwerk
