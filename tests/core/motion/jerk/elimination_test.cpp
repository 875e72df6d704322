#include "core/motion/jerk/elimination.hpp"

#include <gtest/gtest.h>

#include <random>

namespace bahnwerk {
namespace {

using Row4 = std::array<double, 4>;

struct Dense {
  double m[4][4] = {};
  void add(double w, const Row4& g) {
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 4; ++k) m[i][k] += w * g[i] * g[k];
  }
};

void expect_same(const CellMatrix<double>& K, const Dense& d) {
  const double upper[4][4] = {
      {K.m00, K.m01, K.m02, K.m03}, {0, K.m11, K.m12, K.m13}, {0, 0, K.m22, K.m23}, {0, 0, 0, K.m33}};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = i; k < 4; ++k) EXPECT_NEAR(upper[i][k], d.m[i][k], 1e-12) << i << ' ' << k;
}

class Random {
 public:
  double operator()() { return any_(engine_); }
  Row4 row() { return {(*this)(), (*this)(), (*this)(), (*this)()}; }

 private:
  std::mt19937 engine_{5};
  std::uniform_real_distribution<double> any_{-1, 1};
};

TEST(Elimination, TheMatrixOfACellIsTheSumOfItsRows) {
  Random random;
  const Row4 left = random.row(), right = random.row(), both = random.row();
  Dense dense;
  RowSums<double> at_left, at_right, at_both;
  Row4 r{};
  for (int i = 0; i < 6; ++i) {
    const double w = 1 + random(), y = random(), t = random(), nb = random(), na = random();
    const auto place = [&](const Row4& q, const Row4& n, const auto& sums) {
      Row4 g;
      for (std::size_t k = 0; k < 4; ++k) g[k] = t * q[k] + n[k], r[k] -= y * g[k];
      dense.add(w, g);
      sums();
    };
    place(left, {nb, na, 0, 0}, [&] { at_left.add(w, y, t, nb, na); });
    place(right, {0, 0, nb, na}, [&] { at_right.add(w, y, t, nb, na); });
    place(both, {nb, 0, nb, 0}, [&] { at_both.add(w, y, t, nb); });
  }
  CellMatrix<double> K = CellMatrix<double>::of_left(left, at_left, {0, 0, 0, 0});
  K.add_right(right, at_right);
  K.add_both(both, at_both);
  expect_same(K, dense);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(K.r[k], r[k], 1e-12);
}

TEST(Elimination, OneRowStartsTheSumThatAddingItToNothingGives) {
  const RowSums<double> started = RowSums<double>::of(2, 3, 5, 7, 11);
  RowSums<double> added;
  added.add(2, 3, 5, 7, 11);
  EXPECT_EQ(started.tt, added.tt);
  EXPECT_EQ(started.ba, added.ba);
  EXPECT_EQ(started.yb, added.yb);
  EXPECT_EQ(started.aa, 2 * 11 * 11);
  EXPECT_EQ(RowSums<double>::of(2, 3, 5, 7).tb, 2 * 5 * 7);
}

/// The Newton system of two nodes: the block of the first, the cell between them, the block of the second.
struct TwoNodes {
  NodeBlock<double> first{4, 0.5, 3, 1, -2}, second{5, -0.25, 2, 0.5, 1.5};
  CellMatrix<double> cell;
  TwoNodes() { cell.m02 = 0.7, cell.m03 = -0.4, cell.m12 = 0.3, cell.m13 = 0.6; }
  /// Row i of the whole system times x, less its right-hand side.
  std::array<double, 4> rest(const Row4& x) const {
    const double m[4][4] = {{first.bb, first.ba, cell.m02, cell.m03},
                            {first.ba, first.aa, cell.m12, cell.m13},
                            {cell.m02, cell.m12, second.bb, second.ba},
                            {cell.m03, cell.m13, second.ba, second.aa}};
    std::array<double, 4> rest{-first.rb, -first.ra, -second.rb, -second.ra};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 4; ++k) rest[i] += m[i][k] * x[k];
    return rest;
  }
};

TEST(Elimination, TwoNodesAreSolvedAsTheWholeSystem) {
  const TwoNodes system;
  NodeBlock<double> after = system.second;
  const Elimination<double> e = eliminate(system.first, system.first.bb, system.first.aa, system.cell, after);
  const double det = after.bb * after.aa - after.ba * after.ba;
  Row4 x{};
  x[2] = (after.aa * after.rb - after.ba * after.ra) / det;
  x[3] = (after.bb * after.ra - after.ba * after.rb) / det;
  e.back(x[2], x[3], x[0], x[1]);
  for (const double rest : system.rest(x)) EXPECT_NEAR(rest, 0, 1e-13);
}

TEST(Elimination, NextToRestTheAccelerationIsTiedToTheSpeed) {
  const TwoNodes system;
  constexpr double tie = 0.4;
  NodeBlock<double> after = system.second;
  const Elimination<double> e = eliminate_tied(system.first, tie, system.cell, after);
  const double det = after.bb * after.aa - after.ba * after.ba;
  Row4 x{};
  x[2] = (after.aa * after.rb - after.ba * after.ra) / det;
  x[3] = (after.bb * after.ra - after.ba * after.rb) / det;
  e.back(x[2], x[3], x[0], x[1]);
  EXPECT_NEAR(x[1], tie * x[0], 1e-15);
  const auto rest = system.rest(x);
  EXPECT_NEAR(rest[0] + tie * rest[1], 0, 1e-13);  // along (1, tie) alone
  EXPECT_NEAR(rest[2], 0, 1e-13);
  EXPECT_NEAR(rest[3], 0, 1e-13);
}

TEST(Elimination, APivotThatRoundingHasTakenDoesNotBecomeNegative) {
  NodeBlock<double> now{1, 1, 1 - 1e-18, 1, 1}, after{1, 0, 1, 0, 0};
  const Elimination<double> e = eliminate(now, 1.0, 1.0, CellMatrix<double>{}, after);
  EXPECT_TRUE(std::isfinite(e.yb) && std::isfinite(e.ya));
}

}  // namespace
}  // namespace bahnwerk
