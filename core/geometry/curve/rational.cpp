#include "core/geometry/curve/rational.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {
namespace {

using Pair = Lanes<2>;  // two coordinates at a time
Pair load(const double* p) { return Pair{p[0], p[1]}; }

struct Taylor {
  Pair t0, t1, t2, t3;
};
/// Value and derivatives/k! of one pair of rows, Horner with the derivatives carried along.
template <std::size_t stride>
Taylor horner3(const double* c, std::size_t degree, double t) {
  const Pair x{t, t};
  Taylor r{load(c + degree * stride), Pair{}, Pair{}, Pair{}};
  for (std::size_t k = degree; k-- > 0;) {
    r.t3 = r.t3 * x + r.t2;
    r.t2 = r.t2 * x + r.t1;
    r.t1 = r.t1 * x + r.t0;
    r.t0 = r.t0 * x + load(c + k * stride);
  }
  return r;
}

}  // namespace

Polynomial Rational::coordinate(std::size_t axis) const {
  if (axis >= stride_) return {};
  Polynomial p(degree_ + 1);
  for (std::size_t k = 0; k <= degree_; ++k) p[k] = c_[k * stride_ + axis];
  return p;
}

Polynomial Rational::weight() const {
  if (!rational_) return {1.0};
  Polynomial p(degree_ + 1);
  for (std::size_t k = 0; k <= degree_; ++k) p[k] = c_[k * 4 + 3];
  return p;
}

Vec Rational::longest() const {
  Vec most;
  for (std::size_t k = 1; k <= degree_; ++k) {
    if (norm(numerator(k)) > norm(most)) most = numerator(k);
  }
  return most;
}

bool Rational::collinear() const {
  const Vec most = longest();
  if (norm(most) == 0) return true;
  const Vec along = most / norm(most);
  const double tolerance = std::max(1e-12 * extent_, noise_);
  for (std::size_t k = 1; k <= degree_; ++k) {
    if (norm(cross(along, numerator(k))) > tolerance) return false;
  }
  return true;
}

Jet Rational::at(double u) const {
  const double t = (u - pivot_) * inverse_, i1 = inverse_, i2 = i1 * i1 * 2, i3 = i1 * i1 * i1 * 6;
  if (stride_ == 2) {
    const Taylor a = horner3<2>(c_.data(), degree_, t);
    return {{origin_.x + a.t0[0], origin_.y + a.t0[1], origin_.z},
            {i1 * a.t1[0], i1 * a.t1[1], 0},
            {i2 * a.t2[0], i2 * a.t2[1], 0},
            {i3 * a.t3[0], i3 * a.t3[1], 0}};
  }
  Taylor a = horner3<4>(c_.data(), degree_, t), b = horner3<4>(c_.data() + 2, degree_, t);
  if (rational_) {  // Taylor coefficients of the quotient: w₀ hₖ = Nₖ − Σ wⱼ hₖ₋ⱼ
    const double inverse = 1 / b.t0[1];
    const Pair i{inverse, inverse}, w1{b.t1[1], b.t1[1]}, w2{b.t2[1], b.t2[1]}, w3{b.t3[1], b.t3[1]};
    a.t0 = a.t0 * i;
    b.t0 = b.t0 * i;
    a.t1 = (a.t1 - w1 * a.t0) * i;
    b.t1 = (b.t1 - w1 * b.t0) * i;
    a.t2 = (a.t2 - w1 * a.t1 - w2 * a.t0) * i;
    b.t2 = (b.t2 - w1 * b.t1 - w2 * b.t0) * i;
    a.t3 = (a.t3 - w1 * a.t2 - w2 * a.t1 - w3 * a.t0) * i;
    b.t3 = (b.t3 - w1 * b.t2 - w2 * b.t1 - w3 * b.t0) * i;
  }
  return {{origin_.x + a.t0[0], origin_.y + a.t0[1], origin_.z + b.t0[0]},
          {i1 * a.t1[0], i1 * a.t1[1], i1 * b.t1[0]},
          {i2 * a.t2[0], i2 * a.t2[1], i2 * b.t2[0]},
          {i3 * a.t3[0], i3 * a.t3[1], i3 * b.t3[0]}};
}

namespace {

/// Derivatives/k!, k < rows, of one coordinate at two points. The first steps leave out what is still zero.
template <std::size_t rows>
std::array<PointPair, rows> taylor(const double* c, std::size_t stride, std::size_t degree, PointPair x) {
  std::array<PointPair, rows> t{};
  std::size_t k = degree;
  const auto step = [&](std::size_t known) {
    const double next = c[--k * stride];
    for (std::size_t r = known; r > 0; --r) t[r] = t[r] * x + t[r - 1];
    t[0] = t[0] * x + PointPair{next, next};
  };
  const double top = c[degree * stride];
  t[0] = PointPair{top, top};
  for (std::size_t known = 1; known < rows && k > 0; ++known) step(known);
  while (k > 0) step(rows - 1);  // NOLINT(bugprone-infinite-loop): step() counts k down
  return t;
}

}  // namespace

bool Rational::derivatives(PathBatch& batch) const {
  if (degree_ == 0) return false;
  const double i1 = inverse_, i2 = i1 * i1 * 2, i3 = i1 * i1 * i1 * 6;
  batch.planar = plane_;
  const std::size_t axes = batch.planar ? 2 : 3;
  for (std::size_t p = 0; p < batch.used_pairs(); ++p) {
    const PointPair x = (batch.u.pair[p] - PointPair{pivot_, pivot_}) * PointPair{i1, i1};
    if (!rational_) {
      for (std::size_t axis = 0; axis < axes; ++axis) {
        const auto d = taylor<3>(d_.data() + axis, stride_, degree_ - 1, x);
        batch.d1[axis].pair[p] = i1 * d[0];
        batch.d2[axis].pair[p] = (i1 * i1) * d[1];
        batch.d3[axis].pair[p] = (i1 * i1 * i1 * 2) * d[2];
      }
      continue;
    }
    const auto w = taylor<4>(c_.data() + 3, 4, degree_, x);
    const PointPair inverse = PointPair{1, 1} / w[0];
    for (std::size_t axis = 0; axis < axes; ++axis) {  // the sum is formed as in at()
      auto a = taylor<4>(c_.data() + axis, stride_, degree_, x);
      a[0] = a[0] * inverse;
      a[1] = (a[1] - w[1] * a[0]) * inverse;
      a[2] = (a[2] - w[1] * a[1] - w[2] * a[0]) * inverse;
      a[3] = (a[3] - w[1] * a[2] - w[2] * a[1] - w[3] * a[0]) * inverse;
      batch.d1[axis].pair[p] = i1 * a[1];
      batch.d2[axis].pair[p] = i2 * a[2];
      batch.d3[axis].pair[p] = i3 * a[3];
    }
  }
  return true;
}

double Rational::speed(double u) const {
  const double t = (u - pivot_) * inverse_;
  const Pair x{t, t};
  if (stride_ == 2) {
    Pair d = load(&d_[(degree_ - 1) * 2]);
    for (std::size_t k = degree_ - 1; k-- > 0;) d = d * x + load(&d_[k * 2]);
    return inverse_ * std::sqrt(d[0] * d[0] + d[1] * d[1]);
  }
  Pair d = load(&d_[(degree_ - 1) * 4]), e = load(&d_[(degree_ - 1) * 4 + 2]);
  if (!rational_) {
    for (std::size_t k = degree_ - 1; k-- > 0;) {
      d = d * x + load(&d_[k * 4]);
      e = e * x + load(&d_[k * 4 + 2]);
    }
    return inverse_ * std::sqrt(d[0] * d[0] + d[1] * d[1] + e[0] * e[0]);
  }
  Pair n = load(&c_[degree_ * 4]), m = load(&c_[degree_ * 4 + 2]);
  n = n * x + load(&c_[(degree_ - 1) * 4]);
  m = m * x + load(&c_[(degree_ - 1) * 4 + 2]);
  for (std::size_t k = degree_ - 1; k-- > 0;) {
    d = d * x + load(&d_[k * 4]);
    e = e * x + load(&d_[k * 4 + 2]);
    n = n * x + load(&c_[k * 4]);
    m = m * x + load(&c_[k * 4 + 2]);
  }
  const double w = m[1], w1 = e[1];  // h' = (N' w − N w')/w²
  const double vx = d[0] * w - n[0] * w1, vy = d[1] * w - n[1] * w1, vz = e[0] * w - m[0] * w1;
  return inverse_ * std::sqrt(vx * vx + vy * vy + vz * vz) / (w * w);
}

}  // namespace bahnwerk
