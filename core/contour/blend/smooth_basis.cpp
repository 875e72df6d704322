#include "core/contour/blend/smooth_basis.hpp"

#include <utility>

namespace bahnwerk::blending {

std::vector<double> clamped_knots(const std::vector<double>& breaks) {
  std::vector<double> knots(spline_degree, breaks.front());
  knots.insert(knots.end(), breaks.begin(), breaks.end());
  knots.insert(knots.end(), spline_degree, breaks.back());
  return knots;
}

BasisRow basis_at(const std::vector<double>& knots, std::size_t span, double t) {
  constexpr std::size_t p = spline_degree;
  const std::size_t k = span + p;  // knots[k] ≤ t ≤ knots[k + 1]
  // Values of all degrees (upper triangle) and knot differences (lower triangle).
  double table[spline_order][spline_order] = {{1}};
  double left[spline_order] = {}, right[spline_order] = {};
  for (std::size_t j = 1; j <= p; ++j) {
    left[j] = t - knots[k + 1 - j];
    right[j] = knots[k + j] - t;
    double saved = 0;
    for (std::size_t r = 0; r < j; ++r) {
      table[j][r] = right[r + 1] + left[j - r];
      const double term = table[r][j - 1] / table[j][r];
      table[r][j] = saved + right[r + 1] * term;
      saved = left[j - r] * term;
    }
    table[j][j] = saved;
  }
  BasisRow row{};
  for (std::size_t i = 0; i <= p; ++i) row[0][i] = table[i][p];
  for (std::size_t r = 0; r <= p; ++r) {
    double a[2][spline_order] = {{1}};
    std::size_t now = 0, next = 1;
    double factor = 1;
    for (std::size_t d = 1; d <= 3; ++d) {
      double sum = 0;
      const std::size_t low = p - d;
      if (r >= d) {
        a[next][0] = a[now][0] / table[low + 1][r - d];
        sum = a[next][0] * table[r - d][low];
      }
      const std::size_t j1 = r + 1 >= d ? 1 : d - r;
      const std::size_t j2 = r <= low + 1 ? d - 1 : p - r;
      for (std::size_t j = j1; j <= j2; ++j) {
        a[next][j] = (a[now][j] - a[now][j - 1]) / table[low + 1][r + j - d];
        sum += a[next][j] * table[r + j - d][low];
      }
      if (r <= low) {
        a[next][d] = -a[now][d - 1] / table[low + 1][r];
        sum += a[next][d] * table[r][low];
      }
      factor *= static_cast<double>(p + 1 - d);
      row[d][r] = factor * sum;
      std::swap(now, next);
    }
  }
  return row;
}

}  // namespace bahnwerk::blending
