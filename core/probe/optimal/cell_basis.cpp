#include "core/probe/optimal/cell_basis.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace bahnwerk {
namespace {

using Row = Eigen::Matrix<double, 1, 8>;

CellBasis make_basis() {
  constexpr std::size_t n = CellBasis::pieces;
  constexpr double h = 1.0 / n;
  // The end state without snap, and what each piece's snap adds to it: order p gains h^(4−p) of a unit snap.
  Eigen::Matrix4d drift = Eigen::Matrix4d::Identity(), per_snap;
  drift(0, 1) = drift(1, 2) = drift(2, 3) = 1;
  drift(0, 2) = drift(1, 3) = 0.5;
  drift(0, 3) = 1.0 / 6;
  constexpr double factorial[] = {1, 1, 2, 6, 24};
  for (std::size_t k = 0; k < n; ++k) {
    const double from = 1 - static_cast<double>(k) * h, to = from - h;
    for (int p = 0; p < 4; ++p)
      per_snap(p, static_cast<Eigen::Index>(k)) = (std::pow(from, 4 - p) - std::pow(to, 4 - p)) / factorial[4 - p];
  }
  Eigen::Matrix<double, 4, 8> miss;
  miss << -drift, Eigen::Matrix4d::Identity();
  const Eigen::Matrix<double, 4, 8> snap = per_snap.fullPivLu().solve(miss);

  CellBasis basis{};
  Eigen::Matrix<double, 4, 8> state = Eigen::Matrix<double, 4, 8>::Zero();
  state.leftCols<4>().setIdentity();
  const auto put = [&](std::size_t order, std::size_t at, const Row& row) {
    const std::size_t r = CellBasis::first[order] + at;
    constexpr double nothing = 1e-12;  // rounding of sums that cancel
    for (int c = 0; c < 8; ++c) basis.row[r][c] = std::abs(row(c)) < nothing ? 0 : row(c);
    basis.order[r] = static_cast<int>(order);
    int from = 0, to = 8;
    while (from + 1 < to && basis.row[r][from] == 0) ++from;
    while (to > from + 1 && basis.row[r][to - 1] == 0) --to;
    basis.from[r] = from, basis.to[r] = to;
  };
  for (std::size_t k = 0; k < n; ++k) {
    const Row x = state.row(0), v = state.row(1), a = state.row(2), j = state.row(3),
              s = snap.row(static_cast<Eigen::Index>(k));
    const Row v1 = v + h / 3 * a, v2 = v + 2 * h / 3 * a + h * h / 6 * j, v3 = v + h * (a + h * (j / 2 + h / 6 * s));
    put(0, 4 * k, x);
    put(0, 4 * k + 1, x + h / 4 * v);
    put(0, 4 * k + 2, x + h / 4 * (v + v1));
    put(0, 4 * k + 3, x + h / 4 * (v + v1 + v2));
    put(1, 3 * k, v);
    put(1, 3 * k + 1, v1);
    put(1, 3 * k + 2, v2);
    put(2, 2 * k, a);
    put(2, 2 * k + 1, a + h / 2 * j);
    put(3, k, j);
    put(4, k, s);
    const Row x1 = x + h / 4 * (v + v1 + v2 + v3), a1 = a + h * (j + h / 2 * s), j1 = j + h * s;
    state << x1, v3, a1, j1;
  }
  // The last row of an order is the state at the end itself.
  for (std::size_t p = 0; p < 4; ++p) {
    Row end = Row::Zero();
    end(static_cast<Eigen::Index>(4 + p)) = 1;
    put(p, CellBasis::first[p + 1] - CellBasis::first[p] - 1, end);
  }
  return basis;
}

}  // namespace

const CellBasis& cell_basis() {
  static const CellBasis basis = make_basis();
  return basis;
}

}  // namespace bahnwerk
