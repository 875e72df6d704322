#include "core/motion/feed/speed_spline.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace bahnwerk {
namespace {

constexpr double end_share = 0.4;  // φ(1)

}  // namespace

SpeedSpline::SpeedSpline(std::vector<double> breaks, std::size_t graded) : breaks_(std::move(breaks)), graded_(graded) {
  const std::size_t n = breaks_.size();
  if (graded == 0 || n < 2 * graded + 1 || n < 5 ||
      !std::is_sorted(breaks_.begin(), breaks_.end(), [](double a, double b) { return a <= b; }))
    throw std::invalid_argument("a spline of the speed needs four spans at least, in ascending order");
  first_width_ = (breaks_[graded] - breaks_.front()) / end_share;
  last_width_ = (breaks_.back() - breaks_[n - 1 - graded]) / end_share;
  knots_.assign(order, 0.0);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const auto parts = static_cast<double>(graded);
    knots_.push_back(knots_.back() + (i < graded            ? first_width_ / parts
                                      : i + 1 + graded >= n ? last_width_ / parts
                                                            : breaks_[i + 1] - breaks_[i]));
  }
  knots_.insert(knots_.end(), order - 1, knots_.back());
}

SpeedSpline::Place SpeedSpline::at(std::size_t span, double x) const {
  Place place;
  place.span = span;
  const double h = width(span);
  const bool last = span + graded_ >= spans();
  if (span < graded_ || last) {
    const auto parts = static_cast<double>(graded_);
    const double y = (last ? static_cast<double>(spans() - span) - x : static_cast<double>(span) + x) / parts;
    const double all = last ? last_width_ : first_width_, phi = y * y * y * y * (1 - 0.6 * y);
    place.s = last ? breaks_.back() - all * phi : breaks_.front() + all * phi;
    place.s1 = y * y * y * (4 - 3 * y);
    place.s2 = (last ? -1 : 1) * 12 * y * y * (1 - y) / all;
  } else {
    place.s = breaks_[span] + x * h;
    place.s1 = 1;
  }
  // De Boor's recursion over the knots of this span: bases of degree p from those of p − 1, and derivatives
  // p (B_{i,p−1}/(t_{i+p} − t_i) − B_{i+1,p−1}/(t_{i+p+1} − t_{i+1})) [Herrmann (3.72)].
  const std::size_t k = span + order - 1;  // w ∈ [t_k, t_{k+1}]
  const double w = knot(k) + x * h;
  std::array<std::array<double, order>, order> n{};  // [degree][i]: base number k − degree + i
  n[0][0] = 1;
  for (std::size_t p = 1; p < order; ++p)
    for (std::size_t i = 0; i <= p; ++i) {
      const std::size_t first = k - p + i;
      double sum = 0;
      if (i > 0) sum += (w - knot(first)) / (knot(first + p) - knot(first)) * n[p - 1][i - 1];
      if (i < p) sum += (knot(first + p + 1) - w) / (knot(first + p + 1) - knot(first + 1)) * n[p - 1][i];
      n[p][i] = sum;
    }
  // Returns the derivatives of the basis functions of degree p from those of degree p − 1, from `lower` on.
  const auto derived = [&](std::size_t p, const std::array<double, order>& lower) {
    std::array<double, order> d{};
    for (std::size_t i = 0; i <= p; ++i) {
      const std::size_t first = k - p + i;
      if (i > 0) d[i] += static_cast<double>(p) / (knot(first + p) - knot(first)) * lower[i - 1];
      if (i < p) d[i] -= static_cast<double>(p) / (knot(first + p + 1) - knot(first + 1)) * lower[i];
    }
    return d;
  };
  place.b0 = n[3];
  place.b1 = derived(3, n[2]);
  place.b2 = derived(3, derived(2, n[1]));
  return place;
}

SpeedSpline::State SpeedSpline::state(const Place& p, std::span<const double> control) {
  double v = 0, v1 = 0, v2 = 0;
  for (std::size_t i = 0; i < order; ++i) {
    const double c = control[p.span + i];
    v += p.b0[i] * c, v1 += p.b1[i] * c, v2 += p.b2[i] * c;
  }
  State x;
  const double g = v1 / p.s1, rise = (v2 - g * p.s2) / (p.s1 * p.s1);
  x.v = v, x.a = v * g, x.j = v * (g * g + v * rise);
  for (std::size_t i = 0; i < order; ++i) {
    const double dg = p.b1[i] / p.s1, drise = (p.b2[i] - dg * p.s2) / (p.s1 * p.s1);
    x.dv[i] = p.b0[i];
    x.da[i] = p.b0[i] * g + v * dg;
    x.dj[i] = p.b0[i] * (g * g + 2 * v * rise) + v * (2 * g * dg + v * drise);
  }
  return x;
}

}  // namespace bahnwerk
