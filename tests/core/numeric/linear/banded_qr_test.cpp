#include "core/numeric/linear/banded_qr.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

constexpr int unknowns = 2, reach = 3, rights = 2;
using System = BandedQr<unknowns, reach, rights, 12>;

TEST(BandedQr, SolvesWhatTheFullMatrixSaysAndLeavesWhatItCannotTake) {
  constexpr std::size_t nodes = 9;
  constexpr int rows_per_node = 4;
  const auto known = [](std::size_t n) { return n == 0 || n == 5; };
  Random random(2);
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(rows_per_node * nodes, unknowns * nodes);
  Eigen::MatrixXd right(full.rows(), rights);
  System system(nodes);
  system.clear();
  for (std::size_t n = 0; n < nodes; ++n) {
    for (int r = 0; r < rows_per_node; ++r) {
      auto row = system.add_row();
      const auto at = static_cast<Eigen::Index>(n) * rows_per_node + r;
      for (int c = 0; c < System::columns; ++c) {
        const std::size_t node = n + static_cast<std::size_t>(c / unknowns);
        if (node >= nodes || known(node)) continue;
        row(c) = full(at, static_cast<Eigen::Index>(n) * unknowns + c) = random.uniform(-1, 1);
      }
      for (int k = 0; k < rights; ++k) row(System::columns + k) = right(at, k) = random.uniform(-1, 1);
    }
    ASSERT_TRUE(system.close(n, known));
  }
  std::vector<std::array<double, unknowns>> x(nodes);
  system.solve({1, -0.5}, known, x);
  const Eigen::VectorXd wanted = right.col(0) - 0.5 * right.col(1);
  const Eigen::VectorXd expected = full.completeOrthogonalDecomposition().solve(wanted);
  for (std::size_t n = 0; n < nodes; ++n)
    for (int i = 0; i < unknowns; ++i) {
      const auto at = static_cast<Eigen::Index>(n) * unknowns + i;
      EXPECT_NEAR(x[n][static_cast<std::size_t>(i)], known(n) ? 0 : expected(at), 1e-12) << n;
    }
  const Eigen::MatrixXd taken = full * full.completeOrthogonalDecomposition().solve(right);
  EXPECT_NEAR(system.product(0, 1), taken.col(0).dot(taken.col(1)), 1e-12);
  EXPECT_NEAR(system.residual(1), (right - taken).col(1).squaredNorm(), 1e-12);
}

TEST(BandedQr, UnknownsThatNoRowSaysAreFound) {
  System system(2);
  system.clear();
  system.add_row()(0) = 1;
  EXPECT_FALSE(system.close(0, [](std::size_t) { return false; }));
}

}  // namespace
}  // namespace bahnwerk
