#include "core/cam/optimal/program/section_basis.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace bahnwerk::cam {
namespace {

constexpr std::size_t max_order_count = 23;  // coefficients of degree 22

}  // namespace

SectionBasis::SectionBasis(int degree, int pieces)
    : degree_(static_cast<std::size_t>(degree)), pieces_(static_cast<std::size_t>(pieces)) {
  if (pieces_ == 1) return;
  const std::size_t n = degree_, count = n + 1;
  const auto knot = [&](std::size_t i) {  // knot i, in pieces
    return i <= n ? 0.0 : static_cast<double>(std::min(i - n, pieces_));
  };
  to_bernstein_.resize(pieces_ * count * count);
  std::vector<double> d(count * count);
  for (std::size_t p = 0; p < pieces_; ++p) {
    const double a = static_cast<double>(p), b = a + 1;
    for (std::size_t j = 0; j < count; ++j) {
      // Bernstein coefficient j is the blossom at a (n − j times) and b (j times): de Boor's algorithm.
      std::fill(d.begin(), d.end(), 0.0);
      for (std::size_t i = 0; i < count; ++i) d[i * count + i] = 1;
      for (std::size_t r = 1; r <= n; ++r) {
        const double x = r <= n - j ? a : b;
        for (std::size_t i = n; i >= r; --i) {
          const double low = knot(p + i), high = knot(p + i + n - r + 1), share = (x - low) / (high - low);
          for (std::size_t k = 0; k < count; ++k)
            d[i * count + k] = (1 - share) * d[(i - 1) * count + k] + share * d[i * count + k];
        }
      }
      for (std::size_t k = 0; k < count; ++k) to_bernstein_[(p * count + j) * count + k] = d[n * count + k];
    }
  }
}

void SectionBasis::bernstein_values(std::size_t degree, double v, double* out) {
  out[0] = 1;
  for (std::size_t k = 1; k <= degree; ++k) {
    double carried = 0;
    for (std::size_t j = 0; j < k; ++j) {
      const double value = out[j];
      out[j] = carried + (1 - v) * value;
      carried = v * value;
    }
    out[k] = carried;
  }
}

void SectionBasis::weights(std::size_t piece, double v, std::size_t order, double* out) const {
  const std::size_t n = degree_;
  if (order > n) {
    std::fill(out, out + n + 1, 0.0);
    return;
  }
  std::array<double, max_order_count> values{};
  bernstein_values(n - order, v, values.data());
  double factor = 1;
  for (std::size_t k = 0; k < order; ++k) factor *= static_cast<double>((n - k) * pieces_);
  // The adjoint of `order` differences.
  for (std::size_t k = n - order; k < n; ++k) {
    double last = 0;
    for (std::size_t j = 0; j <= k + 1; ++j) {
      const double value = j <= k ? values[j] : 0;
      values[j] = last - value;
      last = value;
    }
  }
  if (pieces_ == 1) {
    for (std::size_t j = 0; j <= n; ++j) out[j] = factor * values[j];
    return;
  }
  std::fill(out, out + n + 1, 0.0);
  const double* row = to_bernstein_.data() + piece * (n + 1) * (n + 1);
  for (std::size_t j = 0; j <= n; ++j, row += n + 1)
    for (std::size_t k = 0; k <= n; ++k) out[k] += factor * values[j] * row[k];
}

void SectionBasis::bernstein(std::size_t piece, const double* coefficients, double* out) const {
  if (pieces_ == 1) {
    std::copy(coefficients, coefficients + degree_ + 1, out);
    return;
  }
  const std::size_t count = degree_ + 1;
  const double* row = to_bernstein_.data() + piece * count * count;
  for (std::size_t j = 0; j < count; ++j, row += count) {
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += row[k] * coefficients[piece + k];
    out[j] = sum;
  }
}

void differentiate_bernstein(std::vector<double>& coefficients) {
  const double degree = static_cast<double>(coefficients.size() - 1);
  for (std::size_t i = 0; i + 1 < coefficients.size(); ++i)
    coefficients[i] = degree * (coefficients[i + 1] - coefficients[i]);
  coefficients.pop_back();
  if (coefficients.empty()) coefficients.push_back(0);
}

}  // namespace bahnwerk::cam
