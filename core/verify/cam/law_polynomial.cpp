#include "core/verify/cam/law_polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace bahnwerk::verify {

double bernstein_sum(const std::vector<double>& c, double x) {
  const std::size_t n = c.size() - 1;
  // The smaller power of both ends carries the sum, so that nothing overflows or is divided by zero.
  if (x > 0.5) {
    std::vector<double> reversed(c.rbegin(), c.rend());
    return bernstein_sum(reversed, 1 - x);
  }
  const double ratio = x / (1 - x);
  double weight = std::pow(1 - x, static_cast<double>(n)), sum = 0;
  for (std::size_t k = 0; k <= n; ++k) {
    sum += weight * c[k];
    weight *= ratio * static_cast<double>(n - k) / static_cast<double>(k + 1);
  }
  return sum;
}

std::vector<double> derivative_coefficients(const std::vector<double>& b, double duration, int order) {
  const int n = static_cast<int>(b.size()) - 1;
  if (order > n) return {0};
  std::vector<double> out;
  for (int i = 0; i + order <= n; ++i) {
    // The binomials' sum with alternating signs is 0: distances from the first coefficient give the same difference,
    // without the rounding of multiples of positions.
    const auto first = static_cast<std::size_t>(i);
    const double from = order > 0 ? b[first] : 0;
    double difference = 0, binomial = 1;
    for (int k = 0; k <= order; ++k) {
      difference += ((order - k) % 2 == 0 ? binomial : -binomial) * (b[first + static_cast<std::size_t>(k)] - from);
      binomial *= static_cast<double>(order - k) / static_cast<double>(k + 1);
    }
    for (int k = 0; k < order; ++k) difference *= static_cast<double>(n - k) / duration;
    out.push_back(difference);
  }
  return out;
}

double mean_square(const std::vector<double>& c) {
  // B_i B_j = C(n, i) C(n, j) / C(2n, i + j) · B_{i + j, 2n}, whose integral is 1/(2n + 1).
  const std::size_t n = c.size() - 1;
  const auto binomials = [](std::size_t degree) {
    std::vector<double> out{1};
    for (std::size_t k = 0; k < degree; ++k)
      out.push_back(out.back() * static_cast<double>(degree - k) / static_cast<double>(k + 1));
    return out;
  };
  const std::vector<double> one = binomials(n), two = binomials(2 * n);
  double sum = 0;
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j <= n; ++j) sum += one[i] * one[j] / two[i + j] * c[i] * c[j];
  return std::max(0.0, sum) / static_cast<double>(2 * n + 1);
}

double derivative_rounding(const std::vector<double>& b, double duration, int order) {
  const auto [least, most] = std::minmax_element(b.begin(), b.end());
  const int n = static_cast<int>(b.size()) - 1;
  double rounding = 16 * std::numeric_limits<double>::epsilon() * std::max(-*least, *most);
  for (int k = 0; k < order; ++k) rounding *= 2 * static_cast<double>(std::max(n - k, 1)) / duration;
  return rounding;
}

EnclosedMaximum enclosed_maximum(const std::vector<double>& c, double tolerance) {
  struct Part {
    double above;
    std::vector<double> c;
    double from, width;
    bool operator<(const Part& other) const { return above < other.above; }
  };
  const auto part = [](std::vector<double> coefficients, double from, double width) {
    const double above = *std::max_element(coefficients.begin(), coefficients.end());
    return Part{above, std::move(coefficients), from, width};
  };
  std::priority_queue<Part> parts;
  parts.push(part(c, 0, 1));
  EnclosedMaximum best{std::max(c.front(), c.back()), c.front() >= c.back() ? 0.0 : 1.0};
  for (int steps = 0; !parts.empty() && steps < 20000; ++steps) {
    Part now = parts.top();
    if (now.above <= best.value + tolerance || now.width < 1e-12) return {std::max(now.above, best.value), best.at};
    parts.pop();
    // de Casteljau at the middle, in a triangle.
    std::vector<double> row = now.c, left, right(now.c.size());
    for (std::size_t m = now.c.size(); m-- > 0;) {
      left.push_back(row.front());
      right[m] = row[m];
      for (std::size_t k = 0; k < m; ++k) row[k] = (row[k] + row[k + 1]) / 2;
    }
    const double half = now.width / 2;
    if (left.back() > best.value) best = {left.back(), now.from + half};
    parts.push(part(std::move(left), now.from, half));
    parts.push(part(std::move(right), now.from + half, half));
  }
  return {parts.empty() ? best.value : std::max(parts.top().above, best.value), best.at};
}

}  // namespace bahnwerk::verify
