#pragma once
/// Gauss–Legendre quadrature: fixed rules and an adaptive one.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace bahnwerk {

/// Nodes in (−1, 1), ascending, and weights (sum 2): exact for polynomials of degree 2n − 1.
struct GaussRule {
  std::vector<double> nodes, weights;
};

/// Computes the rule by Newton's method on the Legendre polynomial, to full precision. 1 ≤ n ≤ 64. O(n²).
GaussRule make_gauss_rule(std::size_t n);
/// The rules of 5, 7 and 10 nodes, made once.
const GaussRule& gauss5();
const GaussRule& gauss7();
const GaussRule& gauss10();

/// ∫ₐᵇ f by one application of the rule.
template <class F>
double integrate(F&& f, double a, double b, const GaussRule& rule) {
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) sum += rule.weights[i] * f(middle + half * rule.nodes[i]);
  return half * sum;
}

struct Integral {
  double value = 0;
  double error = 0;           ///< estimated absolute error (difference of the last two levels, summed)
  std::size_t intervals = 0;  ///< how many leaves the bisection ended with
};

/// ∫ₐᵇ f by bisection with the 10-node rule: an interval is accepted when its two halves agree with it to
/// max(absolute, relative · |running total|), or at depth 50. 20 evaluations per bisection.
template <class F>
Integral integrate_adaptive(F&& f, double a, double b, double relative, double absolute = 0) {
  struct Open {
    double a, b, value;
    int depth;
  };
  const GaussRule& rule = gauss10();
  Integral result;
  double total = integrate(f, a, b, rule);
  std::vector<Open> open{{a, b, total, 0}};
  while (!open.empty()) {
    const Open top = open.back();
    open.pop_back();
    const double middle = 0.5 * (top.a + top.b);
    const double left = integrate(f, top.a, middle, rule), right = integrate(f, middle, top.b, rule);
    const double difference = left + right - top.value;
    total += difference;
    if (std::abs(difference) <= std::max(absolute, relative * std::abs(total)) || top.depth >= 50 ||
        !(std::abs(difference) < HUGE_VAL)) {
      result.value += left + right;
      result.error += std::abs(difference);
      ++result.intervals;
    } else {
      open.push_back({middle, top.b, right, top.depth + 1});
      open.push_back({top.a, middle, left, top.depth + 1});
    }
  }
  return result;
}

}  // namespace bahnwerk
