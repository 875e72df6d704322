#include "core/cam/optimal/task/extrema.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace bahnwerk::cam {
namespace {

constexpr std::size_t most = 23;  // coefficients
using Coefficients = std::array<double, most>;

/// The sign is positive where larger is better: +1 for the maximum, −1 for the minimum.
void enclose(std::span<const double> bernstein, double sign, Extremum& best) {
  const std::size_t n = bernstein.size();
  struct Part {
    Coefficients b;
    double begin, width;
  };
  double scale = 0;
  Part whole{{}, 0, 1};
  for (std::size_t i = 0; i < n; ++i) {
    whole.b[i] = sign * bernstein[i];
    scale = std::max(scale, std::abs(whole.b[i]));
  }
  const double resolution = 1e-13 * scale;
  const auto look = [&](double value, double at) {
    if (value > best.value) best = {at, value};
  };
  look(whole.b[0], 0);
  look(whole.b[n - 1], 1);
  std::vector<Part> stack{whole};
  double outside = best.value;
  while (!stack.empty()) {
    const Part part = stack.back();
    stack.pop_back();
    const double top = *std::max_element(part.b.begin(), part.b.begin() + static_cast<std::ptrdiff_t>(n));
    if (top <= best.value + resolution || part.width < 1e-9) {
      outside = std::max(outside, top);
      continue;
    }
    Part left{{}, part.begin, part.width / 2}, right{part.b, part.begin + part.width / 2, part.width / 2};
    for (std::size_t k = 0; k < n; ++k) {
      left.b[k] = right.b[0];
      for (std::size_t i = 0; i + 1 < n - k; ++i) right.b[i] = 0.5 * (right.b[i] + right.b[i + 1]);
    }
    look(left.b[n - 1], right.begin);
    // The half with the larger coefficients is looked at first.
    const double in_left = *std::max_element(left.b.begin(), left.b.begin() + static_cast<std::ptrdiff_t>(n));
    const double in_right = *std::max_element(right.b.begin(), right.b.begin() + static_cast<std::ptrdiff_t>(n));
    if (in_left > in_right) std::swap(left, right);
    if (std::min(in_left, in_right) > best.value) stack.push_back(left);
    if (std::max(in_left, in_right) > best.value) stack.push_back(right);
  }
  best.value = std::max(best.value, outside);
}

/// The one root of a polynomial over [0, 1] whose ends differ in sign: regula falsi with Illinois' halving, and
/// bisection every third step, for ends that are next to nothing.
double single_root(std::span<const double> d) {
  double a = 0, fa = d.front(), b = 1, fb = d.back();
  for (int i = 1; i < 150 && b - a > 4e-16; ++i) {
    double x = i % 3 == 0 ? (a + b) / 2 : b - fb * (b - a) / (fb - fa);
    if (!(x > a && x < b)) x = (a + b) / 2;
    if (!(x > a && x < b)) break;
    const double fx = evaluate_bernstein(d, x);
    if (fx == 0) return x;
    if ((fx < 0) != (fb < 0)) {
      a = x;
      fa = fx;
      if (i % 3 == 1) fb /= 2;
    } else {
      b = x;
      fb = fx;
      if (i % 3 == 1) fa /= 2;
    }
  }
  return (a + b) / 2;
}

/// Roots inside (begin, begin + width), ascending, by Descartes' rule on Bernstein coefficients: no change of sign, no
/// root; one change, one root; else both halves, down to 2⁻³⁰.
template <class Found>
void isolate_roots(const Coefficients& d, std::size_t n, double begin, double width, int depth, Found&& found) {
  int changes = 0;
  double last = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (d[i] == 0) continue;
    if (last != 0 && (d[i] < 0) != (last < 0)) ++changes;
    last = d[i];
  }
  if (changes == 0) return;
  if (changes == 1 && d[0] != 0 && d[n - 1] != 0) {
    found(begin + width * single_root({d.data(), n}));
    return;
  }
  if (depth >= 30) {
    found(begin + width / 2);
    return;
  }
  Coefficients left{}, right = d;
  for (std::size_t k = 0; k < n; ++k) {
    left[k] = right[0];
    for (std::size_t i = 0; i + 1 < n - k; ++i) right[i] = 0.5 * (right[i] + right[i + 1]);
  }
  isolate_roots(left, n, begin, width / 2, depth + 1, found);
  // A root in the middle itself belongs to neither half.
  if (right[0] == 0) found(begin + width / 2);
  isolate_roots(right, n, begin + width / 2, width / 2, depth + 1, found);
}

}  // namespace

double evaluate_bernstein(std::span<const double> bernstein, double v) {
  Coefficients b;
  const std::size_t n = bernstein.size();
  std::copy(bernstein.begin(), bernstein.end(), b.begin());
  for (std::size_t k = n; k-- > 1;)
    for (std::size_t i = 0; i < k; ++i) b[i] = (1 - v) * b[i] + v * b[i + 1];
  return b[0];
}

void find_extrema(std::span<const double> bernstein, std::vector<Extremum>& out) {
  out.clear();
  const std::size_t n = bernstein.size();
  out.push_back({0, bernstein[0]});
  if (n > 2) {
    Coefficients slope{};
    for (std::size_t i = 0; i + 1 < n; ++i) slope[i] = bernstein[i + 1] - bernstein[i];
    isolate_roots(slope, n - 1, 0, 1, 0, [&](double at) { out.push_back({at, evaluate_bernstein(bernstein, at)}); });
  }
  out.push_back({1, bernstein[n - 1]});
}

Extremum greatest_value(std::span<const double> bernstein) {
  Extremum best{0, bernstein[0]};
  enclose(bernstein, 1, best);
  return best;
}

Extremum greatest_magnitude(std::span<const double> bernstein) {
  Extremum best{0, std::abs(bernstein[0])};
  enclose(bernstein, 1, best);
  enclose(bernstein, -1, best);
  return best;
}

}  // namespace bahnwerk::cam
