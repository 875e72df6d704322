#include "core/geometry/curve/nurbs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/base/errors.hpp"
#include "core/geometry/curve/bspline_basis.hpp"

namespace bahnwerk {
namespace {

constexpr std::size_t order_limit = Nurbs::max_degree + 1;
struct Homogeneous {
  Vec p;
  double w = 0;
};
Homogeneous mix(double a, const Homogeneous& x, double b, const Homogeneous& y) {
  return {a * x.p + b * y.p, a * x.w + b * y.w};
}

/// Everything that is wrong with the definition, in document order.
std::vector<InputFault> faults_of(std::size_t p, const std::vector<Vec>& points, const std::vector<double>& weights,
                                  const std::vector<double>& knots) {
  std::vector<InputFault> faults;
  const auto add = [&](std::vector<std::string> place, const char* what) {
    place.insert(place.begin(), "nurbs");
    faults.push_back({std::move(place), what});
  };
  if (p < 1 || p > Nurbs::max_degree) {
    add({"degree"}, "the degree has to be 1 to 16");
    return faults;
  }
  const std::size_t n = points.size();
  if (n < p + 1) add({"points"}, "more control points than the degree are needed");
  for (std::size_t i = 0; i < n; ++i) {
    const Vec& q = points[i];
    if (!(std::abs(q.x) <= 1e9 && std::abs(q.y) <= 1e9 && std::abs(q.z) <= 1e9)) {
      add({"points", std::to_string(i)}, "a coordinate has to be finite and within 1e9 mm");
    }
  }
  if (!weights.empty() && weights.size() != n) add({"weights"}, "one weight per control point is needed");
  double low = HUGE_VAL, high = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] > 0 && weights[i] < HUGE_VAL)) {
      add({"weights", std::to_string(i)}, "a weight has to be positive and finite");
    } else {
      low = std::min(low, weights[i]);
      high = std::max(high, weights[i]);
    }
  }
  if (high > 0 && !(high / low <= 1e6)) add({"weights"}, "the weights are more than a factor of 1e6 apart");
  if (knots.size() != n + p + 1) {
    add({"knots"}, "the number of knots has to be points + degree + 1");
    return faults;
  }
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!(std::abs(knots[i]) <= 1e150)) {
      add({"knots", std::to_string(i)}, "a knot has to be finite");
    } else if (i > 0 && knots[i] < knots[i - 1]) {
      add({"knots", std::to_string(i)}, "the knots have to be non-decreasing");
    }
  }
  if (!faults.empty()) return faults;
  if (!(knots[p] < knots[n])) {
    add({"knots"}, "the knots leave no domain");
    return faults;
  }
  for (std::size_t i = 0; i < knots.size();) {
    std::size_t j = i;
    while (j < knots.size() && knots[j] == knots[i]) ++j;
    if (j - i > p + 1) {
      add({"knots", std::to_string(i + p + 1)}, "a knot occurs more than degree + 1 times");
    } else if (j - i == p + 1 && knots[i] > knots[p] && knots[i] < knots[n] && norm(points[i] - points[i - 1]) > 1e-9) {
      add({"knots", std::to_string(i + p)}, "an inner knot of multiplicity degree + 1 tears the curve");
    }
    i = j;
  }
  return faults;
}

}  // namespace

Nurbs::Nurbs(std::size_t degree, std::vector<Vec> points, std::vector<double> weights, std::vector<double> knots)
    : degree_(degree), points_(std::move(points)), weights_(std::move(weights)), knots_(std::move(knots)) {
  auto faults = faults_of(degree_, points_, weights_, knots_);
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  if (weights_.empty()) weights_.assign(points_.size(), 1.0);
}

std::size_t Nurbs::span(double u) const {
  const auto first = knots_.begin() + static_cast<std::ptrdiff_t>(degree_);
  const auto last = knots_.begin() + static_cast<std::ptrdiff_t>(points_.size());
  if (u >= *last) {  // the last non-empty span
    return static_cast<std::size_t>(std::lower_bound(first, last, *last) - knots_.begin()) - 1;
  }
  return static_cast<std::size_t>(std::max(first + 1, std::upper_bound(first, last, u)) - knots_.begin()) - 1;
}

Jet Nurbs::at(double u) const {
  const std::size_t p = degree_, k = span(u), orders = std::min<std::size_t>(3, p);
  const BsplineBasis<order_limit> basis = bspline_basis<order_limit>(knots_, p, k, u);
  // Homogeneous derivatives relative to one control point (large coordinates), then the quotient rule (A4.2).
  const Vec base = points_[k - p];
  std::array<Homogeneous, 4> h{};
  for (std::size_t o = 0; o <= orders; ++o) {
    for (std::size_t r = 0; r <= p; ++r) {
      const double c = basis[o][r] * weights_[k - p + r];
      h[o].p += c * (points_[k - p + r] - base);
      h[o].w += c;
    }
  }
  const double w = h[0].w;
  Jet jet;
  jet.value = h[0].p / w;
  jet.d1 = (h[1].p - h[1].w * jet.value) / w;
  jet.d2 = (h[2].p - 2 * h[1].w * jet.d1 - h[2].w * jet.value) / w;
  jet.d3 = (h[3].p - 3 * h[1].w * jet.d2 - 3 * h[2].w * jet.d1 - h[3].w * jet.value) / w;
  jet.value += base;
  return jet;
}

std::vector<std::pair<double, double>> Nurbs::spans() const {
  std::vector<std::pair<double, double>> result;
  for (std::size_t k = degree_; k < points_.size(); ++k) {
    if (knots_[k] < knots_[k + 1]) result.emplace_back(knots_[k], knots_[k + 1]);
  }
  return result;
}

std::vector<Rational> Nurbs::pieces() const {
  const std::size_t p = degree_;
  std::vector<Rational> result;
  std::vector<Vec> points(p + 1);
  std::vector<double> weights(p + 1);
  for (std::size_t k = p; k < points_.size(); ++k) {
    if (!(knots_[k] < knots_[k + 1])) continue;
    const double a = knots_[k], b = knots_[k + 1];
    const Vec base = points_[k - p];
    for (std::size_t j = 0; j <= p;
         ++j) {  // control point j = blossom(a … a, b … b) with j times b; convex combinations
      std::array<Homogeneous, order_limit> d;
      for (std::size_t i = 0; i <= p; ++i) {
        const double w = weights_[k - p + i];
        d[i] = {w * (points_[k - p + i] - base), w};
      }
      for (std::size_t r = 1; r <= p; ++r) {
        const double t = r <= j ? b : a;
        for (std::size_t i = p; i >= r; --i) {
          const double low = knots_[k - p + i], high = knots_[k + 1 + i - r], share = (t - low) / (high - low);
          d[i] = mix((high - t) / (high - low), d[i - 1], share, d[i]);
        }
      }
      points[j] = base + d[p].p / d[p].w;
      weights[j] = d[p].w;
    }
    result.push_back(Rational::bezier(points, weights));
  }
  return result;
}

}  // namespace bahnwerk
