#include "core/numeric/optimise/least_squares.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

// What makes y the minimum: Aᵀ(b − Ay) is 0 where y is free or positive, and ≤ 0 where y = 0.
void expect_optimal(const MatrixXd& a, const VectorXd& b, Index free, const VectorXd& y, double tolerance) {
  const VectorXd slope = a.transpose() * (b - a * y);
  for (Index k = 0; k < y.size(); ++k) {
    if (k >= free) {
      EXPECT_GE(y[k], 0);
    }
    EXPECT_LE(slope[k], tolerance);
    if (k < free || y[k] > 0) {
      EXPECT_GE(slope[k], -tolerance);
    }
  }
}

TEST(NonNegativeLeastSquares, RandomOnesWithDependentColumns) {
  Random random(5);
  for (int k = 0; k < 300; ++k) {
    const auto rows = static_cast<Index>(1 + random.below(15)), columns = static_cast<Index>(1 + random.below(25));
    const auto free = static_cast<Index>(random.below(static_cast<std::uint64_t>(columns)));
    MatrixXd a = MatrixXd::NullaryExpr(rows, columns, [&] { return random.normal(); });
    const VectorXd b = VectorXd::NullaryExpr(rows, [&] { return random.normal(); });
    for (Index j = 0; j < columns; ++j) {
      if (random.chance(0.1)) a.col(j).setZero();
      if (random.chance(0.2))
        a.col(j) = -2 * a.col(static_cast<Index>(random.below(static_cast<std::uint64_t>(columns))));
    }
    expect_optimal(a, b, free, non_negative_least_squares(a, b, free, [] {}), 1e-11);
  }
}

TEST(NonNegativeLeastSquares, AcceptsAProblemWithoutColumns) {
  EXPECT_EQ(non_negative_least_squares(MatrixXd(3, 0), VectorXd::Ones(3), 0, [] {}).size(), 0);
}

TEST(NonNegativeLeastSquares, StopsWhereItIsTold) {
  EXPECT_THROW(non_negative_least_squares(MatrixXd::Identity(3, 3), VectorXd::Ones(3), 0,
                                          [] { throw std::runtime_error("stop"); }),
               std::runtime_error);
}

}  // namespace
}  // namespace bahnwerk
