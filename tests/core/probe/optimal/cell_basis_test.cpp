#include "core/probe/optimal/cell_basis.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bahnwerk {
namespace {

double row(std::size_t r, const double (&y)[8]) {
  double sum = 0;
  for (int c = 0; c < 8; ++c) sum += cell_basis().row[r][c] * y[c];
  return sum;
}

// u^4 and everything below it is one quartic, so all four pieces are: Bézier points are its polar form.
TEST(CellBasis, AQuarticIsReproduced) {
  const double y[8] = {0, 0, 0, 0, 1, 4, 12, 24};
  for (std::size_t piece = 0; piece < 4; ++piece) {
    const double a = static_cast<double>(piece) / 4, b = a + 0.25;
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(row(4 * piece + i, y),
                  std::pow(a, 4.0 - static_cast<double>(i)) * std::pow(b, static_cast<double>(i)), 1e-13);
    EXPECT_NEAR(row(CellBasis::first[3] + piece, y), 24 * a, 1e-11);
    EXPECT_NEAR(row(CellBasis::first[4] + piece, y), 24, 1e-10);
  }
}

TEST(CellBasis, EndStatesAreRowsAndPiecesMeet) {
  const double y[8] = {0.3, -1, 2, 5, 1.1, 0.4, -7, 3};
  for (std::size_t p = 0; p < 4; ++p) {
    EXPECT_DOUBLE_EQ(row(CellBasis::first[p], y), y[p]);
    EXPECT_DOUBLE_EQ(row(CellBasis::first[p + 1] - 1, y), y[4 + p]);
  }
  // The jerk rises by the snap over a quarter, the last piece's to the end state.
  for (std::size_t piece = 0; piece < 4; ++piece)
    EXPECT_NEAR(row(CellBasis::first[3] + piece, y) + row(CellBasis::first[4] + piece, y) / 4,
                row(CellBasis::first[3] + piece + 1, y), 1e-9);
}

}  // namespace
}  // namespace bahnwerk
