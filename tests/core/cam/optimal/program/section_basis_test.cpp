#include "core/cam/optimal/program/section_basis.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bahnwerk::cam {
namespace {

double value_of(const SectionBasis& basis, const std::vector<double>& c, std::size_t piece, double v,
                std::size_t order) {
  std::vector<double> weights(basis.degree() + 1);
  basis.weights(piece, v, order, weights.data());
  double sum = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * c[piece + k];
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

/// The weights are a partition of one, and linear coefficients at the Greville abscissae give the identity.
TEST(SectionBasis, ReproducesStraightLines) {
  const SectionBasis basis(4, 3);
  std::vector<double> line(basis.size());
  for (std::size_t j = 0; j < line.size(); ++j) {
    double sum = 0;
    for (std::size_t k = 1; k <= 4; ++k) sum += std::min(3.0, std::max(0.0, static_cast<double>(j + k) - 4));
    line[j] = sum / 4 / 3;
  }
  for (std::size_t piece = 0; piece < 3; ++piece)
    for (const double v : {0.0, 0.3, 1.0}) {
      EXPECT_NEAR(value_of(basis, line, piece, v, 0), (static_cast<double>(piece) + v) / 3, 1e-14);
      EXPECT_NEAR(value_of(basis, line, piece, v, 1), 1, 1e-13);
      EXPECT_NEAR(value_of(basis, line, piece, v, 2), 0, 1e-12);
    }
}

TEST(SectionBasis, BernsteinFormIsTheSamePolynomial) {
  const SectionBasis basis(6, 4);
  const std::vector<double> c = some_coefficients(basis.size());
  std::vector<double> b(7), values(7);
  for (std::size_t piece = 0; piece < 4; ++piece) {
    basis.bernstein(piece, c.data(), b.data());
    for (const double v : {0.0, 0.21, 0.77, 1.0}) {
      SectionBasis::bernstein_values(6, v, values.data());
      double sum = 0;
      for (std::size_t k = 0; k < 7; ++k) sum += values[k] * b[k];
      EXPECT_NEAR(sum, value_of(basis, c, piece, v, 0), 1e-14);
    }
    std::vector<double> slope = b;
    differentiate_bernstein(slope);
    EXPECT_NEAR(4 * slope.front(), value_of(basis, c, piece, 0, 1), 1e-12);
  }
}

TEST(SectionBasis, DerivativesAboveTheDegreeAreZero) {
  const SectionBasis basis(3, 2);
  std::vector<double> weights(4, 1);
  basis.weights(0, 0.4, 4, weights.data());
  for (const double weight : weights) EXPECT_EQ(weight, 0);
}

}  // namespace
}  // namespace bahnwerk::cam
