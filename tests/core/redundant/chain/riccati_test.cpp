#include "core/redundant/chain/riccati.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numeric/random.hpp"

namespace bahnwerk {
namespace {

/// Gaussian elimination with pivots.
std::vector<double> eliminate(std::vector<std::vector<double>> a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t pivot = i;
    for (std::size_t r = i; r < n; ++r)
      if (std::abs(a[r][i]) > std::abs(a[pivot][i])) pivot = r;
    std::swap(a[i], a[pivot]);
    std::swap(b[i], b[pivot]);
    for (std::size_t r = i + 1; r < n; ++r) {
      const double f = a[r][i] / a[i][i];
      for (std::size_t c = i; c < n; ++c) a[r][c] -= f * a[i][c];
      b[r] -= f * b[i];
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t c = i + 1; c < n; ++c) b[i] -= a[i][c] * b[c];
    b[i] /= a[i][i];
  }
  return b;
}

/// The same by the normal equations of what is free: the first state and the controls.
template <std::size_t order>
void compare(Random& random, bool rest) {
  constexpr std::size_t n = 6;
  std::vector<double> steps, cell, force;
  std::vector<ChainState<order>> node(n + 1), gradient(n + 1);
  for (std::size_t c = 0; c < n; ++c) {
    steps.push_back(random.uniform(0.2, 1));
    cell.push_back(c == 2 || c == 5 ? 0 : random.uniform(0.1, 2));
    force.push_back(cell.back() > 0 ? random.uniform(-1, 1) : 0);
  }
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t k = 0; k < order; ++k) {
      node[i][k] = random.uniform(0.1, 2);
      gradient[i][k] = random.uniform(-1, 1);
    }
  // What every free number alone makes of the states.
  std::vector<std::vector<ChainState<order>>> columns;
  std::vector<std::vector<double>> controls;
  const std::size_t begin = rest ? 1 : order;
  for (std::size_t f = 0; f < begin + n; ++f) {
    if (f >= begin && cell[f - begin] == 0) continue;
    std::vector<ChainState<order>> x(n + 1);
    std::vector<double> u(n);
    if (f < begin)
      x[0][f] = 1;
    else
      u[f - begin] = 1;
    for (std::size_t c = 0; c < n; ++c) x[c + 1] = advanced<order>(x[c], steps[c], u[c]);
    columns.push_back(x);
    controls.push_back(u);
  }
  std::vector<std::vector<double>> a(columns.size(), std::vector<double>(columns.size()));
  std::vector<double> b(columns.size());
  for (std::size_t p = 0; p < columns.size(); ++p) {
    for (std::size_t i = 0; i <= n; ++i)
      for (std::size_t k = 0; k < order; ++k) b[p] -= gradient[i][k] * columns[p][i][k];
    for (std::size_t c = 0; c < n; ++c) b[p] -= force[c] * controls[p][c];
    for (std::size_t q = 0; q < columns.size(); ++q) {
      for (std::size_t i = 0; i <= n; ++i)
        for (std::size_t k = 0; k < order; ++k) a[p][q] += node[i][k] * columns[p][i][k] * columns[q][i][k];
      for (std::size_t c = 0; c < n; ++c) a[p][q] += cell[c] * controls[p][c] * controls[q][c];
    }
  }
  const std::vector<double> free = eliminate(a, b);

  Riccati<order> riccati(steps, rest ? 1 : order);
  riccati.factorise(node, cell);
  std::vector<ChainState<order>> x(n + 1);
  std::vector<double> u(n);
  riccati.solve(gradient, force, x, u);
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t k = 0; k < order; ++k) {
      double expected = 0;
      for (std::size_t p = 0; p < free.size(); ++p) expected += free[p] * columns[p][i][k];
      EXPECT_NEAR(x[i][k], expected, 1e-9) << i << ' ' << k;
    }
  for (std::size_t c = 0; c < n; ++c) {
    double expected = 0;
    for (std::size_t p = 0; p < free.size(); ++p) expected += free[p] * controls[p][c];
    EXPECT_NEAR(u[c], expected, 1e-9) << c;
  }
}

TEST(Riccati, SolvesWhatTheNormalEquationsDo) {
  Random random(2);
  for (int i = 0; i < 50; ++i)
    for (const bool rest : {true, false}) {
      compare<2>(random, rest);
      compare<3>(random, rest);
    }
}

}  // namespace
}  // namespace bahnwerk
