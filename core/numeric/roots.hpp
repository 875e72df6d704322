#pragma once
/// Roots of a function of one variable inside a bracket. Both methods keep the bracket and cannot leave it.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace bahnwerk {

/// Newton's method, replaced by bisection where it would leave the bracket or converges too slowly [Press et al.,
/// Numerical Recipes, rtsafe]. `f(x)` returns {value, derivative}; f(a) and f(b) have opposite signs (or one is 0).
/// Ends when the step is ≤ tolerance; at most 200 evaluations.
template <class F>
double newton_bisect(F&& f, double a, double b, double start, double tolerance) {
  const double fa = f(a).first;
  if (fa == 0) return a;
  double low = a, high = b;
  if (fa > 0) std::swap(low, high);  // f(low) < 0
  double x = start, previous = std::abs(b - a);
  for (int i = 0; i < 200; ++i) {
    const auto [value, slope] = f(x);
    if (value == 0) return x;
    (value < 0 ? low : high) = x;
    double step = -value / slope;
    const double left = std::min(low, high), right = std::max(low, high);
    if (!(x + step >= left && x + step <= right) || std::abs(step) > 0.5 * previous) step = 0.5 * (low + high) - x;
    previous = std::abs(step);
    x += step;
    if (previous <= tolerance || right - left <= tolerance) break;
  }
  return x;
}

/// Brent's method [Brent: Algorithms for Minimization without Derivatives, 1973, ch. 4]: no derivative, superlinear.
/// f(a) and f(b) have opposite signs (or one is 0); the result is within tolerance + 4ε|x| of a sign change.
template <class F>
double brent(F&& f, double a, double b, double tolerance) {
  double fa = f(a), fb = f(b);
  if (fa == 0) return a;
  double c = a, fc = fa, d = b - a, e = d;
  for (int i = 0; i < 300 && fb != 0; ++i) {
    if ((fb > 0) == (fc > 0)) {
      c = a;
      fc = fa;
      d = e = b - a;
    }
    if (std::abs(fc) < std::abs(fb)) {
      a = std::exchange(b, c);
      c = a;
      fa = std::exchange(fb, fc);
      fc = fa;
    }
    const double tol = 2 * std::numeric_limits<double>::epsilon() * std::abs(b) + 0.5 * tolerance;
    const double half = 0.5 * (c - b);
    if (std::abs(half) <= tol) break;
    if (std::abs(e) >= tol && std::abs(fa) > std::abs(fb)) {
      const double s = fb / fa;
      double p = 0, q = 0;
      if (a == c) {
        p = 2 * half * s;
        q = 1 - s;
      } else {
        const double r = fb / fc, t = fa / fc;
        p = s * (2 * half * t * (t - r) - (b - a) * (r - 1));
        q = (t - 1) * (r - 1) * (s - 1);
      }
      if (p > 0) q = -q;
      p = std::abs(p);
      if (2 * p < std::min(3 * half * q - std::abs(tol * q), std::abs(e * q))) {
        e = d;
        d = p / q;
      } else {
        d = e = half;
      }
    } else {
      d = e = half;
    }
    a = b;
    fa = fb;
    b += std::abs(d) > tol ? d : std::copysign(tol, half);
    fb = f(b);
  }
  return b;
}

}  // namespace bahnwerk
