#include "core/geometry/spline/smoothness.hpp"

#include <gtest/gtest.h>

#include "core/geometry/spline/spline_arc.hpp"
#include "tests/core/geometry/spline/spline_support.hpp"

namespace bahnwerk {
namespace {

/// A slot and the arc of a winding head.
LinkEnds stator_ends() {
  const auto slot = BezierPiece::line({40, 0, -30, 0, 0}, {40, 0, 30, 0, 0});
  const auto head = spline_arc({52, 6, 40, 0, 1.5}, {}, {0, 0, 1}, 1.2, {0, 0, 0, 1.2, 0}).front();
  return {slot.at(1), head.at(0)};
}

TEST(Smoothness, IsWhatFineSumsSay) {
  const SmoothnessRule rule(3, 200);
  const LinkShape shape{{1.5, 0.4, -1, 0}, {1.2, 0.2, 0.3, 0}, {1, 1.2, 0.8, 1.5, 0.7, 1, 1, 1.3}};
  const auto path = link(3, stator_ends(), shape);
  const auto curvature = [&](double v) {
    const auto jet = path.at(v);
    return norm(cross(place(jet[1]), place(jet[2]))) / std::pow(norm(place(jet[1])), 3);
  };
  const int n = 200000;
  double integral = 0, variation = 0, turned = 0;
  for (int i = 0; i < n; ++i) {
    const double v = (i + 0.5) / n;
    integral += curvature(v) / n;
    turned += curvature(v) * norm(place(path.at(v)[1])) / n;
    variation += std::abs(curvature((i + 1.0) / n) - curvature(static_cast<double>(i) / n));
  }
  EXPECT_NEAR(smoothness(rule, stator_ends(), shape, {1, 0, false, 1e-9}), integral, 1e-6 * integral);
  EXPECT_NEAR(smoothness(rule, stator_ends(), shape, {1, 0, true, 1e-9}), turned, 1e-6 * turned);
  EXPECT_NEAR(smoothness(rule, stator_ends(), shape, {0, 1, false, 1e-9}), variation, 1e-3 * variation);
}

TEST(Smoothness, GradientsAreThoseOfDifferences) {
  Random random(1);
  for (std::size_t k = 1; k <= 4; ++k)
    for (int i = 0; i < 10; ++i) {
      const SmoothnessRule rule(k, 31 + static_cast<std::size_t>(i));
      const auto ends = stator_ends();
      LinkShape shape{{random.uniform(0.8, 2), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)},
                      {random.uniform(0.8, 2), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)},
                      {}};
      if (i % 3 == 0)
        for (std::size_t p = 0; p < link_points(k); ++p) shape.weights.push_back(random.uniform(0.5, 2));
      const SmoothnessWeights weights{1, 8, random.chance(0.5), 1e-3};
      const auto check = [&](auto&& f) {
        std::vector<double> gradient(2 * k);
        f(shape, gradient);
        for (std::size_t j = 0; j < 2 * k; ++j) {
          const double h = 1e-5;
          const auto moved = [&](double step) {
            auto other = shape;
            (j < k ? other.before[j] : other.after[j - k]) += step;
            return f(other, std::span<double>());
          };
          const double quotient = (8 * (moved(h) - moved(-h)) - (moved(2 * h) - moved(-2 * h))) / (12 * h);
          double scale = 1e-3;
          for (const double g : gradient) scale = std::max(scale, std::abs(g));
          EXPECT_NEAR(gradient[j], quotient, 1e-6 * scale) << k << ' ' << j;
        }
      };
      check([&](const LinkShape& s, std::span<double> g) { return smoothness(rule, ends, s, weights, g); });
      check([&](const LinkShape& s, std::span<double> g) { return control_distance(k, ends, s, g); });
    }
}

TEST(Smoothness, StraightLinkHasNone) {
  const LinkEnds ends{BezierPiece::line({}, {1}).at(1), BezierPiece::line({3}, {4}).at(0)};
  EXPECT_NEAR(smoothness(SmoothnessRule(3), ends, {}, {}), 0, 1e-12);
}

}  // namespace
}  // namespace bahnwerk
