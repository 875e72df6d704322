#include "core/geometry/spline/link.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

#include "core/geometry/spline/end_conditions.hpp"
#include "core/geometry/spline/spline_arc.hpp"
#include "tests/core/geometry/spline/spline_support.hpp"

namespace bahnwerk {
namespace {

struct Neighbours {
  BezierPiece before, after;
};

/// A line or an arc before, a line or an arc after, all five coordinates in motion; of at least 30 mm, within 200 mm:
/// what rounding of control points leaves of the derivatives of order 4 depends on that.
Neighbours random_neighbours(Random& random, std::size_t k) {
  const auto one = [&] {
    const auto from = testing::random_pose(random);
    if (random.chance(0.5)) return BezierPiece::line(from, testing::random_pose(random));
    return spline_arc(from, {}, {random.uniform(-1, 1), random.uniform(-1, 1), 1}, random.uniform(0.3, 1.5),
                      {0, 0, 3, random.uniform(-1, 1), random.uniform(-1, 1)}, k)
        .front();
  };
  const auto long_one = [&] {
    for (;;) {
      const BezierPiece piece = one();
      if (norm(place(piece.at(0)[1])) >= 30) return piece;
    }
  };
  return {long_one(), long_one()};
}
LinkShape random_shape(Random& random, std::size_t size) {
  LinkShape shape;
  for (auto* betas : {&shape.before, &shape.after}) {
    (*betas)[0] = random.uniform(0.5, 2);
    for (std::size_t j = 1; j < 4; ++j) (*betas)[j] = random.uniform(-1, 1);
  }
  if (random.chance(0.5))
    for (std::size_t i = 0; i < size; ++i) shape.weights.push_back(random.uniform(0.7, 1.5));
  return shape;
}

/// What a jump is relative to: the derivatives on both sides, or where they vanish those of a circle as large as the
/// parametric speed (mm per unit).
double joint_scale(const BezierPiece& before, const BezierPiece& after, std::size_t n) {
  const double speed = std::min(norm(place(before.at(1)[1])), norm(place(after.at(0)[1])));
  return testing::size(by_length(before.at(1))[n]) + testing::size(by_length(after.at(0))[n]) +
         std::pow(speed, 1 - static_cast<double>(n));
}

TEST(Link, JoinsWithTheContinuityAskedForAndNoMore) {
  Random random(1);
  for (std::size_t k = 1; k <= 4; ++k)
    for (int i = 0; i < 100; ++i) {
      const auto [before, after] = random_neighbours(random, k);
      const auto piece = link(k, {before.at(1), after.at(0)}, random_shape(random, link_points(k)));
      for (std::size_t n = 0; n <= k; ++n) {
        EXPECT_LE(testing::jump(before, piece, n, joint_scale(before, piece, n)), 1e-8) << k << ' ' << n;
        EXPECT_LE(testing::jump(piece, after, n, joint_scale(piece, after, n)), 1e-8) << k << ' ' << n;
      }
      if (k < 4) {
        EXPECT_GE(testing::jump(before, piece, k + 1, joint_scale(before, piece, k + 1)), 1e-4) << k;
      }
    }
}

TEST(Link, BetaOfOneIsParametricContinuity) {  // [Herrmann (4.54)]
  Random random(2);
  const auto [before, after] = random_neighbours(random, 3);
  const auto path = link(3, {before.at(1), after.at(0)}, {});
  for (std::size_t n = 0; n <= 3; ++n) {
    EXPECT_LE(testing::distance(path.at(0)[n], before.at(1)[n]), 1e-10 * (1 + testing::size(before.at(1)[n])));
    EXPECT_LE(testing::distance(path.at(1)[n], after.at(0)[n]), 1e-10 * (1 + testing::size(after.at(0)[n])));
  }
}

// Changing w₃ and w₄ of a finished link, as the source does, breaks G³ at arcs; a link made with them keeps it.
TEST(Link, WeightsKeepContinuityAtArcs) {
  const auto arc = spline_arc({100, 0, 0, 0, 0}, {}, {0, 0, 1}, 1.0).front();
  const auto end = arc.at(1)[0];
  const auto line = BezierPiece::line({end[0] - 60, end[1] + 5, 0}, {end[0] - 60, end[1] - 40, 0});
  const LinkEnds ends{arc.at(1), line.at(0)};
  LinkShape shape{{1, 0, 0, 0}, {1, 0, 0, 0}, {1, 1, 1, 2, 2, 1, 1, 1}};
  const auto kept = link(3, ends, shape);
  shape.weights.clear();
  auto points = link(3, ends, shape).points();
  for (const std::size_t i : {3, 4})
    for (double& c : points[i]) c *= 2;
  const BezierPiece broken(points);
  const auto rate = by_length(arc.at(1))[3];
  EXPECT_LE(testing::distance(by_length(kept.at(0))[3], rate), 1e-12);
  EXPECT_LE(testing::distance(by_length(broken.at(0))[2], by_length(arc.at(1))[2]), 1e-12);
  EXPECT_GE(testing::distance(by_length(broken.at(0))[3], rate), 1e-5);
}

/// The source's weights, which continue the homogeneous derivatives of the neighbours; `before` and `after` are the
/// neighbour's weight and its derivatives at the joint [Herrmann (4.57)].
std::vector<double> inherited_weights(const Series& before, const Series& after, const LinkShape& shape) {
  constexpr std::size_t continuity = 3, degree = 2 * continuity + 1;
  std::vector<double> weights(link_points(continuity));
  for (const bool last : {false, true}) {
    const Series own = composed(last ? after : before, inverse_change(last ? shape.after : shape.before));
    std::array<double, spline_orders> from_end;
    for (std::size_t n = 0; n < spline_orders; ++n) from_end[n] = (last && n % 2 == 1 ? -1 : 1) * own.derivative(n);
    for (std::size_t i = 0; i <= continuity; ++i) weights[last ? degree - i : i] = end_point(from_end, degree, i);
  }
  return weights;
}

TEST(Link, InheritedWeightsContinueTheHomogeneousCurve) {  // [Herrmann (4.57)]
  const auto arc = spline_arc({50, 0, 0, 0, 0}, {}, {0, 0, 1}, 1.2).front();
  const auto line = BezierPiece::line({0, 90, 20, 0, 0}, {-30, 90, 40, 0, 0});
  LinkShape shape{{1.2, 0.3, -0.5, 0}, {0.9, 0.1, 0.2, 0}, {}};
  const auto jet = arc.homogeneous_at(1);
  const Series weight = Series::from(jet[0][5], jet[1][5], jet[2][5], jet[3][5], jet[4][5]);
  shape.weights = inherited_weights(weight, 1, shape);
  const auto piece = link(3, {arc.at(1), line.at(0)}, shape);
  // F(n, β, link) of all homogeneous coordinates is the neighbour's derivative (4.49).
  const auto link_jet = piece.homogeneous_at(0);
  const double b1 = 1.2, b2 = 0.3, b3 = -0.5;
  for (std::size_t d = 0; d < 6; ++d) {
    EXPECT_NEAR(link_jet[1][d] * b1, jet[1][d], 1e-9);
    EXPECT_NEAR(link_jet[2][d] * b1 * b1 + link_jet[1][d] * b2, jet[2][d], 1e-9);
    EXPECT_NEAR(link_jet[3][d] * b1 * b1 * b1 + 3 * link_jet[2][d] * b1 * b2 + link_jet[1][d] * b3, jet[3][d], 1e-8);
  }
  // They follow β, as far as below zero.
  const LinkShape bent{{0.3, 0.3, 8, 0}, {1, 0, 0, 0}, {}};
  const auto negative = inherited_weights(weight, 1, bent);
  EXPECT_LT(negative[3], 0);
  EXPECT_THROW(link(3, {arc.at(1), line.at(0)}, {bent.before, bent.after, negative}), std::invalid_argument);
  // Of two lines they are 1.
  for (const double w : inherited_weights(1, 1, shape)) EXPECT_NEAR(w, 1, 1e-12);
}

TEST(Link, GradientsByBetaAreThoseOfDifferences) {
  Random random(5);
  for (std::size_t k = 1; k <= 4; ++k)
    for (int i = 0; i < 10; ++i) {
      const auto [before, after] = random_neighbours(random, k);
      const LinkEnds ends{before.at(1), after.at(0)};
      const auto shape = random_shape(random, link_points(k));
      // Any linear function of the control points.
      std::vector<Vec> by_points;
      for (std::size_t p = 0; p < link_points(k); ++p)
        by_points.push_back({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
      const auto value = [&](const LinkShape& of) {
        const auto points = link(k, ends, of).points();
        double sum = 0;
        for (std::size_t p = 0; p < points.size(); ++p)
          sum += dot(by_points[p], {points[p][0], points[p][1], points[p][2]});
        return sum;
      };
      std::vector<double> gradient(2 * k);
      link_gradient(k, ends, shape, by_points, gradient);
      double scale = 1;
      for (const double g : gradient) scale = std::max(scale, std::abs(g));
      for (std::size_t j = 0; j < 2 * k; ++j) {
        auto low = shape, high = shape;
        const double h = 1e-5;
        (j < k ? low.before[j] : low.after[j - k]) -= h;
        (j < k ? high.before[j] : high.after[j - k]) += h;
        EXPECT_NEAR(gradient[j], (value(high) - value(low)) / (2 * h), 1e-6 * scale) << k << ' ' << j;
      }
    }
}

TEST(Link, RefusesWhatIsNoLink) {
  const auto line = BezierPiece::line({}, {1});
  const LinkEnds ends{line.at(1), BezierPiece::line({2, 2}, {3, 3}).at(0)};
  std::vector<Vec> by_points(8);
  std::vector<double> gradient(5);
  EXPECT_THROW(link(0, ends, {}), std::invalid_argument);
  EXPECT_THROW(link(5, ends, {}), std::invalid_argument);
  EXPECT_THROW(link(3, ends, {{0, 0, 0, 0}, {1, 0, 0, 0}, {}}), std::invalid_argument);
  EXPECT_THROW(link(3, ends, {{1, 0, 0, 0}, {1, 0, 0, 0}, {1, 1}}), std::invalid_argument);
  EXPECT_THROW(link_gradient(3, ends, {}, by_points, gradient), std::invalid_argument);
}

}  // namespace
}  // namespace bahnwerk
