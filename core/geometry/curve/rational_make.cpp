// Construction of rational pieces from a document's coefficients or control points, or from another piece.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/base/errors.hpp"
#include "core/geometry/curve/rational.hpp"

namespace bahnwerk {
namespace {

constexpr double largest = 1e9;  // mm
constexpr double epsilon = std::numeric_limits<double>::epsilon();

[[noreturn]] void fault(std::vector<std::string> place, const char* what) {
  throw InvalidInput({{std::move(place), what}});
}
/// Returns the effect of rounding of coordinates of that size on the first derivative at an end, n (P₁ − P₀), on [0,
/// 1].
double coordinate_noise(double size, std::size_t degree) {
  return 4 * epsilon * size * static_cast<double>(std::max<std::size_t>(degree, 1));
}
bool usable(double x) { return std::abs(x) <= largest; }  // false for NaN

}  // namespace

Rational Rational::build(const Polynomial (&numerator)[3], const Polynomial& weight, Vec origin, const Domain& domain,
                         double noise) {
  Rational r;
  r.pivot_ = domain.pivot;
  r.reach_ = domain.reach();
  r.inverse_ = 1 / r.reach_;
  r.begin_ = domain.begin;
  r.end_ = domain.end;
  r.origin_ = origin;
  r.noise_ = noise;
  r.rational_ = weight.size() > 1;
  std::size_t size = std::max<std::size_t>(weight.size(), 2);
  for (const Polynomial& p : numerator) size = std::max(size, p.size());
  r.degree_ = size - 1;
  const bool planar = std::all_of(numerator[2].begin(), numerator[2].end(), [](double x) { return x == 0; });
  r.plane_ = planar;
  r.stride_ = planar && !r.rational_ ? 2 : 4;
  r.c_.assign(size * r.stride_, 0.0);
  for (std::size_t axis = 0; axis < (r.stride_ == 2 ? 2U : 3U); ++axis) {
    for (std::size_t k = 0; k < numerator[axis].size(); ++k) r.c_[k * r.stride_ + axis] = numerator[axis][k];
  }
  if (r.stride_ == 4) {
    r.c_[3] = 1;
    for (std::size_t k = 0; k < weight.size(); ++k) r.c_[k * 4 + 3] = weight[k];
  }
  r.d_.assign(r.degree_ * r.stride_, 0.0);
  for (std::size_t k = 0; k < r.degree_; ++k) {
    double square = 0;
    for (std::size_t i = 0; i < r.stride_; ++i) {
      const double c = r.c_[(k + 1) * r.stride_ + i];
      r.d_[k * r.stride_ + i] = static_cast<double>(k + 1) * c;
      if (i < 3) square += c * c;
    }
    r.extent_ += std::sqrt(square);
  }
  return r;
}

Rational Rational::from_power_basis(const std::vector<std::vector<double>>& rows) {
  const std::vector<std::string> here{"polynomial", "coefficients"};
  if (rows.size() < 2 || rows.size() > 3) fault(here, "two or three rows of coefficients are needed");
  Polynomial n[3];
  Vec origin;
  double noise = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<std::string> place = here;
    place.push_back(std::to_string(i));
    if (rows[i].empty() || rows[i].size() > max_degree + 1) fault(place, "a row has 1 to 25 coefficients");
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      if (usable(rows[i][k])) continue;
      place.push_back(std::to_string(k));
      fault(place, "a coefficient has to be finite and within 1e9 mm");
    }
    Polynomial p = rows[i];
    const double start = p[0];
    noise = std::max(noise, coordinate_noise(std::abs(start), rows[i].size() - 1));
    p[0] = 0;
    p = shifted(p, 0.5, 0.5);
    origin[i] = start + p[0];
    p[0] = 0;
    n[i] = std::move(p);
  }
  return build(n, {1.0}, origin, {}, noise);
}

Rational Rational::bezier(const std::vector<Vec>& points, const std::vector<double>& weights) {
  if (points.size() < 2 || points.size() > max_degree + 1) fault({"points"}, "2 to 25 control points are needed");
  if (!weights.empty() && weights.size() != points.size()) fault({"weights"}, "one weight per control point is needed");
  double low = HUGE_VAL, high = 0, noise = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] > 0 && weights[i] < HUGE_VAL))
      fault({"weights", std::to_string(i)}, "a weight has to be positive and finite");
    low = std::min(low, weights[i]);
    high = std::max(high, weights[i]);
  }
  if (!weights.empty() && !(high / low <= 1e6)) fault({"weights"}, "the weights are more than a factor of 1e6 apart");
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!usable(points[i][axis]))
        fault({"points", std::to_string(i)}, "a coordinate has to be finite and within 1e9 mm");
      noise = std::max(noise, coordinate_noise(std::abs(points[i][axis]), points.size() - 1));
    }
  }
  const bool is_rational = !weights.empty() && low != high;
  std::vector<double> row(points.size());
  Polynomial w{1.0};
  double scale = 1;
  if (is_rational) {
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = weights[i] / high;
    w = from_bernstein(row);
    scale = 1 / w[0];
    w = scale * w;
  }
  const auto weight_of = [&](std::size_t i) { return is_rational ? weights[i] / high * scale : 1.0; };
  // Relative to a control point first; the point in the middle of the parameter then becomes the origin.
  const Vec base = points[points.size() / 2];
  Vec origin = base;
  Polynomial n[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = weight_of(i) * (points[i][axis] - base[axis]);
    if (std::all_of(row.begin(), row.end(), [](double x) { return x == 0; })) {
      n[axis].assign(row.size(), 0.0);
      continue;
    }
    const double middle = from_bernstein(row)[0];
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = weight_of(i) * ((points[i][axis] - base[axis]) - middle);
    n[axis] = from_bernstein(row);
    n[axis][0] = 0;
    origin[axis] += middle;
  }
  return build(n, w, origin, {}, noise);
}

Rational Rational::restricted(double u0, double u1, double pivot, std::size_t vanishing) const {
  const Domain part{u0, u1, pivot};
  const double at = (pivot - pivot_) * inverse_, scale = part.reach() * inverse_;
  Polynomial w = shifted(weight(), at, scale), n[3];
  const double normal = 1 / w[0];
  w = normal * w;
  Vec origin = origin_;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    n[axis] = normal * shifted(coordinate(axis), at, scale);
    if (n[axis].empty()) continue;
    const double value = n[axis][0];  // w(pivot) = 1
    n[axis] = n[axis] - value * w;
    origin[axis] += value;
    for (std::size_t k = 0; k <= std::min(vanishing, n[axis].size() - 1); ++k) n[axis][k] = 0;
  }
  Rational r = build(n, w, origin, part, noise_);
  r.vanishing_ = vanishing;
  return r;
}

Rational Rational::mapped(const std::array<Vec, 3>& rows, Vec offset) const {
  Polynomial n[3];
  Vec origin = offset;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t k = 0; k <= degree_; ++k) n[axis].push_back(dot(rows[axis], numerator(k)));
    origin[axis] += dot(rows[axis], origin_);
  }
  Rational r = build(n, weight(), origin, domain(), noise_);
  r.vanishing_ = vanishing_;
  return r;
}

Rational Rational::straightened() const {
  const Vec most = longest();
  if (norm(most) == 0) return *this;
  const Vec along = most / norm(most);
  Polynomial n[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t k = 0; k <= degree_; ++k) n[axis].push_back(dot(numerator(k), along) * along[axis]);
  }
  Rational r = build(n, weight(), origin_, domain(), noise_);
  r.vanishing_ = vanishing_;
  return r;
}

}  // namespace bahnwerk
