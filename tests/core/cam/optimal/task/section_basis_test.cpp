#include "core/cam/optimal/task/section_basis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace bahnwerk::cam {
namespace {

double value_of(const SectionBasis& basis, const std::vector<double>& c, std::size_t piece, double v,
                std::size_t order) {
  std::vector<double> weights(basis.size());
  basis.weights(piece, v, order, weights.data());
  double sum = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * c[k];
  return sum;
}

std::vector<double> some_coefficients(std::size_t count) {
  std::vector<double> c(count);
  for (std::size_t i = 0; i < count; ++i) c[i] = std::sin(1.7 * static_cast<double>(i) + 0.3);
  return c;
}

TEST(SectionBasis, PiecesJoinUpToOneLessThanTheDegree) {
  for (const int degree : {3, 5, 9})
    for (const int pieces : {2, 3, 7}) {
      const SectionBasis basis(degree, pieces);
      const std::vector<double> c = some_coefficients(basis.size());
      for (std::size_t piece = 0; piece + 1 < basis.pieces(); ++piece) {
        double scale = 1;
        for (std::size_t r = 0; r < static_cast<std::size_t>(degree); ++r, scale *= degree * pieces)
          EXPECT_NEAR(value_of(basis, c, piece, 1, r), value_of(basis, c, piece + 1, 0, r), 1e-12 * scale)
              << degree << pieces << r;
        EXPECT_GT(std::abs(value_of(basis, c, piece, 1, static_cast<std::size_t>(degree)) -
                           value_of(basis, c, piece + 1, 0, static_cast<std::size_t>(degree))),
                  1e-3);
      }
    }
}

TEST(SectionBasis, PiecesOfAnyLengthJoinUpToOneLessThanTheDegree) {
  const std::vector<double> breaks{0, 0.001, 0.2, 0.25, 0.9, 1};
  for (const int degree : {3, 4, 6}) {
    const SectionBasis basis(degree, breaks);
    const std::vector<double> c = some_coefficients(basis.size());
    for (std::size_t piece = 0; piece + 1 < basis.pieces(); ++piece)
      for (std::size_t r = 0; r < 3; ++r)
        EXPECT_NEAR(value_of(basis, c, piece, 1, r), value_of(basis, c, piece + 1, 0, r), 1e-12) << degree << r;
    std::vector<double> b(static_cast<std::size_t>(degree) + 1);
    for (std::size_t piece = 0; piece < basis.pieces(); ++piece) {
      basis.bernstein(piece, c.data(), 0, b.data());
      EXPECT_NEAR(b.back(), value_of(basis, c, piece, 1, 0), 1e-14);
      // The second difference of published coefficients is the acceleration, but for their own last digits.
      const double h = basis.length(piece), n = degree;
      EXPECT_NEAR((b[2] - 2 * b[1] + b[0]) * n * (n - 1) / (h * h), value_of(basis, c, piece, 0, 2),
                  1e-12 + 16 * n * n * 2.3e-16 / (h * h));
    }
  }
}

/// The states are the derivatives at the begin; with constant third derivatives the spline is a cubic.
TEST(SectionBasis, ReproducesCubics) {
  const SectionBasis basis(5, 3);
  std::vector<double> c(basis.size(), 6);
  c[0] = 1, c[1] = -2, c[2] = 4;
  for (std::size_t piece = 0; piece < 3; ++piece)
    for (const double v : {0.0, 0.3, 1.0}) {
      const double u = (static_cast<double>(piece) + v) / 3;
      EXPECT_NEAR(value_of(basis, c, piece, v, 0), 1 - 2 * u + 2 * u * u + u * u * u, 1e-14);
      EXPECT_NEAR(value_of(basis, c, piece, v, 1), -2 + 4 * u + 3 * u * u, 1e-14);
      EXPECT_NEAR(value_of(basis, c, piece, v, 2), 4 + 6 * u, 1e-14);
      EXPECT_NEAR(value_of(basis, c, piece, v, 3), 6, 1e-13);
      EXPECT_NEAR(value_of(basis, c, piece, v, 4), 0, 1e-11);
    }
}

TEST(SectionBasis, BernsteinFormIsTheSameDerivative) {
  const SectionBasis basis(6, 4);
  const std::vector<double> c = some_coefficients(basis.size());
  std::vector<double> b(7), values(7);
  for (std::size_t order = 0; order <= 3; ++order)
    for (std::size_t piece = 0; piece < 4; ++piece) {
      basis.bernstein(piece, c.data(), order, b.data());
      for (const double v : {0.0, 0.21, 0.77, 1.0}) {
        SectionBasis::bernstein_values(6 - order, v, values.data());
        double sum = 0;
        for (std::size_t k = 0; k + order < 7; ++k) sum += values[k] * b[k];
        EXPECT_NEAR(sum, value_of(basis, c, piece, v, order), 1e-13);
      }
    }
}

TEST(SectionBasis, HasAsManySitesAsSplines) {
  for (const int degree : {3, 7})
    for (std::size_t order = 0; order <= 3; ++order) {
      const std::vector<double> sites = SectionBasis(degree, 4).sites(order);
      EXPECT_EQ(sites.size(), static_cast<std::size_t>(degree) - order + 4);
      EXPECT_TRUE(std::is_sorted(sites.begin(), sites.end()));
    }
}

TEST(SectionBasis, DerivativesAboveTheDegreeAreZero) {
  const SectionBasis basis(3, 2);
  std::vector<double> weights(basis.size(), 1);
  basis.weights(0, 0.4, 4, weights.data());
  for (const double weight : weights) EXPECT_EQ(weight, 0);
}

}  // namespace
}  // namespace bahnwerk::cam
