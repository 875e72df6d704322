#include "core/numeric/chebyshev.hpp"

#include <numbers>

namespace bahnwerk {

Chebyshev::Chebyshev(double a, double b, std::vector<double> coefficients)
    : a_(a), b_(b), c_(std::move(coefficients)) {}

std::vector<double> Chebyshev::lobatto(std::size_t degree) {
  std::vector<double> x(degree + 1);
  for (std::size_t j = 0; j <= degree;
       ++j) {  // the sine of the signed distance from the middle makes nodes exactly symmetric
    const double k = static_cast<double>(degree) - 2 * static_cast<double>(j);
    x[j] = std::sin(std::numbers::pi * k / (2 * static_cast<double>(degree)));
  }
  return x;
}

std::vector<double> Chebyshev::from_samples(const std::vector<double>& values) {
  const std::size_t n = values.size() - 1;
  std::vector<double> c(n + 1, 0.0);
  for (std::size_t k = 0; k <= n; ++k) {  // discrete cosine transform of the first kind
    double sum = 0;
    for (std::size_t j = 0; j <= n; ++j) {
      const double end = j == 0 || j == n ? 0.5 : 1.0;
      const std::size_t turn = (j * k) % (2 * n);  // keeps the argument small
      sum += end * values[j] * std::cos(std::numbers::pi * static_cast<double>(turn) / static_cast<double>(n));
    }
    c[k] = sum * (k == 0 || k == n ? 1.0 : 2.0) / static_cast<double>(n);
  }
  return c;
}

double Chebyshev::operator()(double u) const {
  const double x = ((u - a_) + (u - b_)) / (b_ - a_), twice = 2 * x;
  double b1 = 0, b2 = 0;
  for (std::size_t k = c_.size() - 1; k >= 1; --k) {
    const double b0 = c_[k] + (twice * b1 - b2);
    b2 = b1;
    b1 = b0;
  }
  return c_[0] + (x * b1 - b2);
}

Chebyshev Chebyshev::derivative() const {
  const std::size_t n = c_.size() - 1;
  std::vector<double> d(std::max<std::size_t>(n, 1), 0.0);
  const double scale = 2 / (b_ - a_);
  for (std::size_t k = n; k >= 1; --k) {  // d_{k−1} = d_{k+1} + 2k c_k
    d[k - 1] = (k + 1 < n ? d[k + 1] : 0.0) + 2 * static_cast<double>(k) * c_[k];
  }
  d[0] *= 0.5;
  for (double& x : d) x *= scale;
  return {a_, b_, std::move(d)};
}

Chebyshev Chebyshev::integral() const {
  const std::size_t n = c_.size() - 1;
  const auto at = [&](std::size_t k) { return k <= n ? c_[k] : 0.0; };
  std::vector<double> s(n + 2, 0.0);
  const double half = 0.5 * (b_ - a_);
  s[1] = half * (at(0) - 0.5 * at(2));
  for (std::size_t k = 2; k <= n + 1; ++k) s[k] = half * (at(k - 1) - at(k + 1)) / (2 * static_cast<double>(k));
  double start = 0;  // Σ s_k T_k(−1)
  for (std::size_t k = n + 1; k >= 1; --k) start += k % 2 == 0 ? s[k] : -s[k];
  s[0] = -start;
  return {a_, b_, std::move(s)};
}

double Chebyshev::bound() const { return tail(0); }

double Chebyshev::tail(std::size_t first) const {
  double sum = 0;
  for (std::size_t k = first; k < c_.size(); ++k) sum += std::abs(c_[k]);
  return sum;
}

std::vector<double> Chebyshev::power_basis() const {
  const std::size_t size = c_.size();
  std::vector<double> result(size, 0.0), t0(size, 0.0), t1(size, 0.0);
  t0[0] = 1;
  result[0] = c_[0];
  if (size > 1) {
    t1[1] = 1;
    result[1] = c_[1];
  }
  for (std::size_t k = 2; k < size; ++k) {  // T_k = 2x T_{k−1} − T_{k−2}
    for (std::size_t i = k + 1; i-- > 0;) t0[i] = (i > 0 ? 2 * t1[i - 1] : 0.0) - t0[i];
    t0.swap(t1);
    for (std::size_t i = 0; i <= k; ++i) result[i] += c_[k] * t1[i];
  }
  return result;
}

}  // namespace bahnwerk
