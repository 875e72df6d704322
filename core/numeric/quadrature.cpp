#include "core/numeric/quadrature.hpp"

#include <numbers>

namespace bahnwerk {

GaussRule make_gauss_rule(std::size_t n) {
  GaussRule rule{std::vector<double>(n), std::vector<double>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    // Tricomi's start, then Newton in long double; the three-term recurrence gives Pₙ and Pₙ'.
    long double x = -std::cos(std::numbers::pi_v<long double> * (static_cast<long double>(i) + 0.75L) /
                              (static_cast<long double>(n) + 0.5L));
    long double slope = 0;
    for (int step = 0; step < 20; ++step) {
      long double p = 1, before = 0;
      for (std::size_t k = 1; k <= n; ++k) {
        const long double kk = static_cast<long double>(k);
        const long double next = ((2 * kk - 1) * x * p - (kk - 1) * before) / kk;
        before = p;
        p = next;
      }
      slope = static_cast<long double>(n) * (x * p - before) / (x * x - 1);
      const long double change = p / slope;
      x -= change;
      if (std::abs(change) < 1e-19L) break;
    }
    rule.nodes[i] = static_cast<double>(x);
    rule.weights[i] = static_cast<double>(2 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

const GaussRule& gauss5() {
  static const GaussRule rule = make_gauss_rule(5);
  return rule;
}
const GaussRule& gauss7() {
  static const GaussRule rule = make_gauss_rule(7);
  return rule;
}
const GaussRule& gauss10() {
  static const GaussRule rule = make_gauss_rule(10);
  return rule;
}

}  // namespace bahnwerk
