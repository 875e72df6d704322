#include "core/cam/optimal/task/section_basis.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bahnwerk::cam {
namespace {

constexpr std::size_t max_order_count = 23;  // coefficients of degree 22

}  // namespace

std::vector<double> equal_breaks(int pieces) {
  std::vector<double> out;
  for (int i = 0; i <= pieces; ++i) out.push_back(static_cast<double>(i) / pieces);
  return out;
}

SectionBasis::SectionBasis(int degree, int pieces) : SectionBasis(degree, equal_breaks(pieces)) {}

SectionBasis::SectionBasis(int degree, std::vector<double> breaks)
    : degree_(static_cast<std::size_t>(degree)), pieces_(breaks.size() - 1), breaks_(std::move(breaks)) {
  const std::size_t n = degree_ - states, count = n + 1, whole = size();
  for (std::size_t r = 0; r <= states; ++r) to_bernstein_[r].assign(pieces_ * (degree_ - r + 1) * whole, 0);
  const auto knot = [&](std::size_t i) { return i <= n ? 0.0 : breaks_[std::min(i - n, pieces_)]; };
  std::vector<double> d(count * count);
  for (std::size_t p = 0; p < pieces_; ++p) {
    const double a = breaks_[p], b = breaks_[p + 1];
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
      double* const out = to_bernstein_[states].data() + (p * count + j) * whole + states + p;
      std::copy(d.begin() + static_cast<std::ptrdiff_t>(n * count), d.end(), out);
    }
  }
  // Each lower order is the integral: it begins where the piece before ends.
  for (std::size_t r = states; r-- > 0;) {
    const std::size_t rows = degree_ - r;  // Bernstein coefficients of the derivative of order r + 1
    for (std::size_t p = 0; p < pieces_; ++p) {
      const double step = length(p) / static_cast<double>(rows);
      double* out = to_bernstein_[r].data() + p * (rows + 1) * whole;
      if (p == 0)
        out[r] = 1;
      else
        std::copy(out - whole, out, out);
      for (std::size_t j = 0; j < rows; ++j, out += whole) {
        const double* const slope = row(p, r + 1, j);
        for (std::size_t k = 0; k < whole; ++k) out[whole + k] = out[k] + step * slope[k];
      }
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
  std::fill(out, out + size(), 0.0);
  if (order > degree_) return;
  const std::size_t n = degree_, lower = std::min(order, states);
  std::array<double, max_order_count> values{};
  bernstein_values(n - order, v, values.data());
  double factor = 1;
  for (std::size_t k = lower; k < order; ++k) factor *= static_cast<double>(n - k) / length(piece);
  // The adjoint of order − 3 differences.
  for (std::size_t k = n - order; k < n - lower; ++k) {
    double last = 0;
    for (std::size_t j = 0; j <= k + 1; ++j) {
      const double value = j <= k ? values[j] : 0;
      values[j] = last - value;
      last = value;
    }
  }
  for (std::size_t j = 0; j <= n - lower; ++j) {
    const double weight = factor * values[j];
    if (weight == 0) continue;
    const double* const from = row(piece, lower, j);
    for (std::size_t k = 0; k < size(); ++k) out[k] += weight * from[k];
  }
}

void SectionBasis::bernstein(std::size_t piece, const double* coefficients, std::size_t order, double* out) const {
  const auto value = [&](std::size_t r, std::size_t j) {
    const double* const from = row(piece, r, j);
    double sum = 0;
    for (std::size_t k = size(); k-- > 0;) sum += from[k] * coefficients[k];
    return sum;
  };
  for (std::size_t j = 0; j <= degree_ - states; ++j) out[j] = value(states, j);
  // The integrals: what rounds the states at the piece's begin does not round the derivatives inside.
  for (std::size_t r = states; r-- > order;) {
    const double step = length(piece) / static_cast<double>(degree_ - r);
    double sum = value(r, 0);
    for (std::size_t j = 0; j < degree_ - r; ++j) {
      const double slope = out[j];
      out[j] = sum;
      sum += step * slope;
    }
    out[degree_ - r] = sum;
  }
}

std::vector<double> SectionBasis::sites(std::size_t order) const {
  const std::size_t n = degree_ - order;
  std::vector<double> out;
  for (std::size_t j = 0; j < n + pieces_; ++j) {
    double sum = 0;
    for (std::size_t k = 1; k <= n; ++k) sum += breaks_[std::min(std::max(j + k, n) - n, pieces_)];
    out.push_back(n > 0 ? sum / static_cast<double>(n) : begin(j) + length(j) / 2);
  }
  return out;
}

void differentiate_bernstein(std::vector<double>& coefficients) {
  const double degree = static_cast<double>(coefficients.size() - 1);
  for (std::size_t i = 0; i + 1 < coefficients.size(); ++i)
    coefficients[i] = degree * (coefficients[i + 1] - coefficients[i]);
  coefficients.pop_back();
  if (coefficients.empty()) coefficients.push_back(0);
}

}  // namespace bahnwerk::cam
