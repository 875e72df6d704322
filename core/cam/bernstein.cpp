#include "core/cam/bernstein.hpp"

#include <cmath>
#include <limits>

namespace bahnwerk::cam {

double bernstein_value(std::span<const double> b, double x) {
  BernsteinArray v;
  std::copy(b.begin(), b.end(), v.begin());
  const double y = 1 - x;
  for (std::size_t m = b.size() - 1; m > 0; --m)
    for (std::size_t k = 0; k < m; ++k) v[k] = y * v[k] + x * v[k + 1];
  return v[0];
}

std::size_t bernstein_derivative(std::span<const double> b, double* out) {
  if (b.size() < 2) {
    out[0] = 0;
    return 1;
  }
  const double n = static_cast<double>(b.size() - 1);
  for (std::size_t k = 0; k + 1 < b.size(); ++k) out[k] = n * (b[k + 1] - b[k]);
  return b.size() - 1;
}

void bernstein_split(std::span<const double> b, double x, double* left, double* right) {
  const std::size_t n = b.size() - 1;
  const double y = 1 - x;
  std::copy(b.begin(), b.end(), right);
  for (std::size_t m = 0; m <= n; ++m) {
    left[m] = right[0];
    for (std::size_t k = 0; k + 1 + m <= n; ++k) right[k] = y * right[k] + x * right[k + 1];
  }
}

void bernstein_raise(double* b, std::size_t from_degree, std::size_t to_degree) {
  for (std::size_t n = from_degree; n < to_degree; ++n) {
    const double m = static_cast<double>(n + 1);
    b[n + 1] = b[n];
    for (std::size_t k = n; k > 0; --k) {
      const double w = static_cast<double>(k) / m;
      b[k] = w * b[k - 1] + (1 - w) * b[k];
    }
  }
}

namespace {

/// The one zero of a polynomial whose coefficients change sign once: Newton's method inside a shrinking bracket.
double only_zero(std::span<const double> d) {
  BernsteinArray slope;
  const std::size_t n = bernstein_derivative(d, slope.data());
  double low = 0, high = 1, x = 0.5;
  // The polynomial's sign before the zero is that of its first coefficient that has one: it may vanish at both ends.
  const bool rises = *std::find_if(d.begin(), d.end(), [](double c) { return c != 0; }) < 0;
  for (int i = 0; i < 200 && high - low > 1e-17; ++i) {
    const double value = bernstein_value(d, x);
    if (value == 0) return x;
    ((value < 0) == rises ? low : high) = x;
    const double tangent = bernstein_value({slope.data(), n}, x);
    double next = x - value / tangent;
    if (!(next > low && next < high)) next = low + (high - low) / 2;
    if (next == x || next <= low || next >= high) break;
    if (std::abs(next - x) < 1e-16) return next;
    x = next;
  }
  return x;
}

struct Part {
  BernsteinArray b;
  double from, width;
  int depth;
};

}  // namespace

void take_extremes(std::span<const double> b, BernsteinExtremes& known) {
  constexpr int max_depth = 50;
  const auto take = [&](double value, double at) {
    if (value > known.high) known.high = value, known.high_at = at;
    if (value < known.low) known.low = value, known.low_at = at;
  };
  take(b.front(), 0);
  take(b.back(), 1);
  const std::size_t size = b.size();
  double scale = 0;
  for (const double c : b) scale = std::max(scale, std::abs(c));
  const double rounding = 2 * std::numeric_limits<double>::epsilon() * scale;
  const auto within = [&](const double* c) {
    const auto [least, most] = std::minmax_element(c, c + size);
    return *most <= known.high + rounding && *least >= known.low - rounding;
  };
  if (size < 3 || within(b.data())) return;
  std::array<Part, max_depth + 2> stack;
  std::size_t top = 1;
  std::copy(b.begin(), b.end(), stack[0].b.begin());
  stack[0].from = 0, stack[0].width = 1, stack[0].depth = 0;
  while (top > 0) {
    Part now = stack[--top];
    if (within(now.b.data())) continue;
    BernsteinArray d;
    const std::size_t count = bernstein_derivative({now.b.data(), size}, d.data());
    int changes = 0;
    double last = 0;
    for (std::size_t k = 0; k < count; ++k) {
      if (d[k] == 0) continue;
      if (last != 0 && (d[k] > 0) != (last > 0)) ++changes;
      last = d[k];
    }
    take(now.b[0], now.from);
    take(now.b[size - 1], now.from + now.width);
    if (changes == 0) continue;
    if (changes == 1) {
      const double x = only_zero({d.data(), count});
      take(bernstein_value({now.b.data(), size}, x), now.from + x * now.width);
      continue;
    }
    if (now.depth == max_depth) {
      const auto [least, most] = std::minmax_element(now.b.begin(), now.b.begin() + static_cast<std::ptrdiff_t>(size));
      take(*least, now.from), take(*most, now.from);
      continue;
    }
    const double half = now.width / 2;
    Part& right = stack[top];
    Part& left = stack[top + 1];
    bernstein_split({now.b.data(), size}, 0.5, left.b.data(), right.b.data());
    left.from = now.from, right.from = now.from + half;
    left.width = right.width = half;
    left.depth = right.depth = now.depth + 1;
    top += 2;
  }
}

}  // namespace bahnwerk::cam
