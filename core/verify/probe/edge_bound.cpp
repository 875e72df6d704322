#include "core/verify/probe/edge_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numeric/bisection.hpp"

namespace bahnwerk {

namespace {

// r! [g_k … g_(k+r)] in the precision asked for.
template <typename Real>
std::array<Real, 5> difference_row(const std::vector<double>& grid, std::size_t r, std::size_t k) {
  constexpr double factorial[] = {1, 1, 2, 6, 24};
  std::array<Real, 5> row{};
  for (std::size_t i = 0; i <= r; ++i) {
    Real product = 1;
    for (std::size_t j = 0; j <= r; ++j)
      if (j != i) product *= static_cast<Real>(grid[k + i]) - static_cast<Real>(grid[k + j]);
    row[i] = factorial[r] / product;
  }
  return row;
}

}  // namespace

std::array<std::vector<std::array<double, 5>>, 4> difference_rows(const std::vector<double>& grid) {
  std::array<std::vector<std::array<double, 5>>, 4> rows;
  for (std::size_t r = 1; r <= 4; ++r)
    for (std::size_t k = 0; k + r < grid.size(); ++k) rows[r - 1].push_back(difference_row<double>(grid, r, k));
  return rows;
}

template <int D>
double certified_time(const EdgeBoundProblem<D>& problem, const EdgeMultipliers<D>& y) {
  using Real = long double;
  const std::size_t samples = problem.grid.size();
  // Positions relative to one of them: the rows of a difference sum up to nothing.
  const std::array<double, D> origin = problem.set.front().p;
  std::vector<std::array<Real, D>> force(samples), size(samples);
  std::array<double, 5> cost{};
  for (std::size_t r = 1; r <= 4; ++r)
    for (std::size_t k = 0; k + r < samples; ++k) {
      const std::array<Real, 5> row = difference_row<Real>(problem.grid, r, k);
      const std::array<double, D>& m = y[r - 1][k];
      double norm = 0;
      for (int a = 0; a < D; ++a) {
        if (!std::isfinite(m[a])) return 0;
        if (r == 1)
          norm += m[a] * m[a];
        else
          cost[r] += problem.derivative[r - 2][a] * std::abs(m[a]);
        for (std::size_t i = 0; i <= r; ++i) {
          force[k + i][a] += row[i] * m[a];
          size[k + i][a] += std::abs(row[i] * m[a]);
        }
      }
      if (r == 1) cost[1] += problem.speed * std::sqrt(norm);
    }
  for (std::size_t k = samples; k-- > 1;) {
    if (!problem.set[k].with_last) continue;
    for (int a = 0; a < D; ++a) {
      force[k - 1][a] += force[k][a];
      size[k - 1][a] += size[k][a];
      force[k][a] = size[k][a] = 0;
    }
  }
  // −Σ σ_k(−f_k) = Σ min over the capsule of f·x, less what rounding may have changed.
  constexpr Real unit = 24 * std::numeric_limits<Real>::epsilon();
  Real least = 0, total_size = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    const SampleSet<D>& s = problem.set[k];
    Real at_p = 0, at_q = 0, norm = 0, rounding = 0;
    for (int a = 0; a < D; ++a) {
      const Real p = static_cast<Real>(s.p[a]) - origin[a], q = static_cast<Real>(s.q[a]) - origin[a];
      at_p += force[k][a] * p;
      at_q += force[k][a] * q;
      norm += force[k][a] * force[k][a];
      rounding += unit * size[k][a] * (std::max(std::abs(p), std::abs(q)) + s.radius);
      total_size += std::abs(force[k][a]) * (std::max(std::abs(p), std::abs(q)) + s.radius);
    }
    least += std::min(at_p, at_q) - s.radius * std::sqrt(norm) - rounding;
  }
  least -= unit * static_cast<Real>(samples) * total_size;
  if (!(least > 0)) return 0;
  for (double& c : cost) c *= 1 + 1e-12;
  const auto total = [&](double h) { return h * (cost[1] + h * (cost[2] + h * (cost[3] + h * cost[4]))); };
  double high = 1;
  for (int i = 0; i < 200 && total(high) < least; ++i) high *= 2;
  if (!(total(high) >= least)) return 0;
  const double low = bisect(0, high, 0, 100, [&](double h) { return total(h) < least; }).low;
  return low * (1 - 1e-12);
}

template double certified_time<1>(const EdgeBoundProblem<1>&, const EdgeMultipliers<1>&);
template double certified_time<2>(const EdgeBoundProblem<2>&, const EdgeMultipliers<2>&);
template double certified_time<3>(const EdgeBoundProblem<3>&, const EdgeMultipliers<3>&);

}  // namespace bahnwerk
