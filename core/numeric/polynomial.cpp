#include "core/numeric/polynomial.hpp"

#include <algorithm>

namespace bahnwerk {

double evaluate(const Polynomial& p, double x) {
  double sum = 0;
  for (std::size_t k = p.size(); k-- > 0;) sum = sum * x + p[k];
  return sum;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial d(p.empty() ? 0 : p.size() - 1);
  for (std::size_t k = 0; k < d.size(); ++k) d[k] = static_cast<double>(k + 1) * p[k + 1];
  return d;
}

Polynomial operator+(const Polynomial& p, const Polynomial& q) {
  Polynomial sum(std::max(p.size(), q.size()), 0.0);
  for (std::size_t k = 0; k < p.size(); ++k) sum[k] = p[k];
  for (std::size_t k = 0; k < q.size(); ++k) sum[k] += q[k];
  return sum;
}

Polynomial operator-(const Polynomial& p, const Polynomial& q) {
  Polynomial difference(std::max(p.size(), q.size()), 0.0);
  for (std::size_t k = 0; k < p.size(); ++k) difference[k] = p[k];
  for (std::size_t k = 0; k < q.size(); ++k) difference[k] -= q[k];
  return difference;
}

Polynomial operator*(const Polynomial& p, const Polynomial& q) {
  if (p.empty() || q.empty()) return {};
  Polynomial product(p.size() + q.size() - 1, 0.0);
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < q.size(); ++j) product[i + j] += p[i] * q[j];
  return product;
}

Polynomial operator*(double k, Polynomial p) {
  for (double& c : p) c *= k;
  return p;
}

Polynomial shifted(Polynomial p, double at, double scale) {
  if (at != 0) {
    for (std::size_t k = 0; k + 1 < p.size(); ++k)
      for (std::size_t i = p.size() - 1; i-- > k;) p[i] += at * p[i + 1];
  }
  double power = 1;
  for (double& c : p) {
    c *= power;
    power *= scale;
  }
  return p;
}

Polynomial deflated(const Polynomial& p, std::size_t k) {
  return k >= p.size() ? Polynomial{} : Polynomial(p.begin() + static_cast<std::ptrdiff_t>(k), p.end());
}

Polynomial from_bernstein(const std::vector<double>& b) {
  // t^k has the coefficient C(n,k) times the blossom with k half differences and n − k midpoints.
  const std::size_t n = b.size() - 1;
  Polynomial result(n + 1);
  std::vector<double> differences = b, row;
  double binomial = 1;
  for (std::size_t k = 0; k <= n; ++k) {
    row = differences;
    for (std::size_t left = n - k; left > 0; --left)
      for (std::size_t i = 0; i < left; ++i) row[i] = 0.5 * (row[i] + row[i + 1]);
    result[k] = binomial * row[0];
    binomial = binomial * static_cast<double>(n - k) / static_cast<double>(k + 1);
    for (std::size_t i = 0; i + k < n; ++i) differences[i] = 0.5 * (differences[i + 1] - differences[i]);
  }
  return result;
}

}  // namespace bahnwerk
