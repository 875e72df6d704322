#include "core/verify/law/curve_disc.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/rational.hpp"

namespace bahnwerk::verify {
namespace {

constexpr double height = 2.5;  // half height of the strip of φ + iy in which arcs are bounded
constexpr double speed_part = 0.6, weight_part = 0.3;
constexpr double least_start = 0.5;  // a curve behind a cusp is not like it

Polynomial magnitudes(Polynomial p) {
  for (double& c : p) c = std::abs(c);
  return p;
}

/// Σ |c_k| x^k and its first two derivatives, k ≥ 1 alone in the first: `constant` is left to the caller.
struct Sizes {
  double tail = 0, first = 0, second = 0;
};
template <class Size>
Sizes sizes(std::size_t count, double x, Size&& size) {
  Sizes s;
  for (std::size_t k = count; k-- > 1;) {
    const double c = size(k), n = static_cast<double>(k);
    s.tail = s.tail * x + c;
    s.first = s.first * x + n * c;
    if (k > 1) s.second = s.second * x + n * (n - 1) * c;
  }
  s.tail *= x;
  return s;
}

}  // namespace

CurveDiscs::CurveDiscs(const Curve& curve, double start) : start_(start), begin_(curve.begin()), end_(curve.end()) {
  if (curve.kind() == CurveKind::line) {
    last_.radius = largest;  // anything would do
    last_.first = 1;
    last_.speed = curve.speed(begin_);
    last_.pace = 1 / last_.speed;
  }
  if (curve.kind() == CurveKind::arc) {
    const auto& arc = static_cast<const Arc&>(curve);
    const double grown = std::sqrt(std::cosh(2 * height)), turn = std::abs(arc.sweep()),
                 per_length = turn / arc.length();
    last_.radius = height / turn;
    last_.first = grown;
    last_.second = grown * arc.radius() * per_length * per_length;
    last_.third = last_.second * per_length;
    last_.speed = arc.length();
    last_.pace = 1 / arc.length();
  }
  if (curve.kind() != CurveKind::rational) return;
  rational_ = true;
  const auto& piece = static_cast<const Rational&>(curve);
  pivot_ = piece.pivot(), reach_ = piece.reach();
  w_ = piece.weight();
  vanishing_ = std::max(piece.vanishing_begin(), piece.vanishing_end());
  const Polynomial w1 = derivative(w_);
  w_terms_ = magnitudes(w_);
  for (std::size_t k = 0; k < 3; ++k) {
    const Polynomial n = piece.coordinate(k), n1 = derivative(n);
    v_[k] = n1 * w_ - n * w1;
    v_terms_ = v_terms_ + (magnitudes(n1) * magnitudes(w_) + magnitudes(n) * magnitudes(w1));
  }
}

CurveDisc CurveDiscs::about(double u) {
  const auto from_last = [&] {
    CurveDisc disc = last_;
    disc.centre = u;
    disc.radius = last_.radius - std::abs(u - last_.centre);
    return disc;
  };
  if (!rational_) {
    CurveDisc disc = last_;
    disc.centre = u;
    return disc;
  }
  if (last_.radius > 0 && std::abs(u - last_.centre) <= last_.radius / 2) return from_last();
  const double ahead = std::min(u + 0.45 * last_.radius, std::max(u, end_));
  last_ = make(ahead);
  if (std::abs(u - last_.centre) > last_.radius / 2) last_ = make(u);
  return from_last();
}

CurveDisc CurveDiscs::make(double centre, std::size_t vanishing) {
  const double c = (centre - pivot_) / reach_;
  std::size_t count = 0;
  for (const Polynomial& p : v_) count = std::max(count, p.size());
  CurveDisc none;
  none.centre = centre;
  if (count <= vanishing) return none;
  count -= vanishing;  // number of coefficients of W = V/z^m
  v_at_.assign(count, Vec{});
  for (std::size_t k = 0; k < 3; ++k) {
    const Polynomial p = shifted(v_[k], c, 1);
    for (std::size_t i = vanishing; i < p.size(); ++i) v_at_[i - vanishing][k] = p[i];
  }
  w_at_ = shifted(w_, c, 1);
  q_at_.assign(2 * count - 1, 0);
  x_at_.assign(2 * count - 1, Vec{});
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) {
      q_at_[i + j] += dot(v_at_[i], v_at_[j]);
      if (i > 0) x_at_[i - 1 + j] = x_at_[i - 1 + j] + static_cast<double>(i) * cross(v_at_[i], v_at_[j]);
    }

  const double unit = 32 * static_cast<double>(count + w_.size()) * std::numeric_limits<double>::epsilon();
  const double q0 = q_at_[0], w0 = w_at_[0], v0 = norm(v_at_[0]);
  v_sizes_.resize(count), x_sizes_.resize(x_at_.size());
  for (std::size_t k = 0; k < count; ++k) v_sizes_[k] = norm(v_at_[k]);
  for (std::size_t k = 0; k < x_at_.size(); ++k) x_sizes_[k] = norm(x_at_[k]);
  double radius = last_.radius > 0 ? std::min(largest, 2 * last_.radius / reach_) : start_;
  for (;; radius *= 0.75) {
    if (!(radius > 1e-15)) return none;
    const double out = std::abs(c) + radius;
    const Sizes v = sizes(count, radius, [&](std::size_t k) { return v_sizes_[k]; }),
                w = sizes(w_at_.size(), radius, [&](std::size_t k) { return std::abs(w_at_[k]); }),
                q = sizes(q_at_.size(), radius, [&](std::size_t k) { return std::abs(q_at_[k]); });
    if (!(q.tail <= speed_part * q0 && w.tail <= weight_part * w0)) continue;
    const auto terms = [&](const Polynomial& p) {
      Sizes s = sizes(p.size(), out, [&](std::size_t k) { return p[k]; });
      s.tail = unit * (s.tail + (p.empty() ? 0 : p[0])), s.first *= unit, s.second *= unit;
      return s;
    };
    Sizes dv = terms(v_terms_);
    const Sizes dw = terms(w_terms_);
    const double m = static_cast<double>(vanishing), power = std::pow(radius, m), square_power = power * power;
    dv.tail /= power, dv.first /= power, dv.second /= power;
    const double V = v0 + v.tail + dv.tail, dq = 2 * V * dv.tail, Q = q.tail + dq, W = w.tail + dw.tail;
    if (!(Q <= speed_part * q0 && W <= weight_part * w0)) continue;
    const double V1 = v.first + dv.first, V2 = v.second + dv.second;
    const Sizes x = sizes(x_at_.size(), radius, [&](std::size_t k) { return x_sizes_[k]; });
    const double X = norm(x_at_[0]) + x.tail + 2 * (dv.first * V + V1 * dv.tail),
                 X1 = x.first + 2 * (dv.second * V + V2 * dv.tail);
    // Bounds of V on the circle, from W: |z| = radius there.
    const double v_most = power * V, v1 = power * (V1 + m * V / radius), x_most = square_power * X,
                 x1 = square_power * (X1 + 2 * m * X / radius), least = square_power * (q0 - Q), nu = std::sqrt(least),
                 most = w0 + W, square = most * most, w1 = w.first + dw.first;
    CurveDisc disc;
    disc.centre = centre;
    disc.radius = radius * reach_;
    disc.first = v_most / nu;
    disc.second = square * v_most * x_most / (least * least);
    disc.third = square / (nu * least * least) *
                 (2 * most * w1 * v_most * x_most + square * (v1 * x_most + v_most * x1) +
                  4 * square * v_most * v_most * x_most * v1 / least);
    disc.speed = std::sqrt(square_power * (q0 + Q)) / ((w0 - W) * (w0 - W)) / reach_;
    disc.pace = square / nu * reach_;
    if (vanishing == 0) start_ = std::clamp(1.5 * radius, least_start, largest);
    return std::isfinite(disc.third + disc.speed + disc.pace) ? disc : none;
  }
}

const CurveDisc& CurveDiscs::at_vanishing_tangent() {
  if (vanishing_ > 0 && !end_known_) {
    end_known_ = true;
    const double kept = std::exchange(last_.radius, 0);
    end_disc_ = make(pivot_, vanishing_);
    last_.radius = kept;
  }
  return end_disc_;
}

bool through(const KinematicAxisPath& path, std::size_t segment, const CurveDisc& tool,
             std::array<CurveDisc, max_axes>& axes) {
  CurveDisc disc = tool;
  for (int attempt = 0; attempt < 60; ++attempt, disc.radius *= 0.5) {
    if (path.pose_turn(segment, disc.centre, disc.radius) > 0) continue;
    const MapBounds map = path.complex_map_bounds(segment, disc.centre, disc.first * disc.speed * disc.radius);
    bool known = true;
    for (std::size_t k = 0; k < path.axes(); ++k) {
      CurveDisc& q = axes[k] = disc;
      q.first = map.order[0][k] * disc.first;
      q.second = map.order[1][k] * disc.first * disc.first + map.order[0][k] * disc.second;
      q.third = map.order[2][k] * disc.first * disc.first * disc.first +
                3 * map.order[1][k] * disc.first * disc.second + map.order[0][k] * disc.third;
      known = known && std::isfinite(q.first + q.second + q.third);
    }
    if (known && disc.radius > 0) return true;
  }
  return false;
}

bool AxisDiscsAlong::enclose(std::size_t segment, const CurveDisc& tool, double radius) {
  AxisDiscs discs;
  if (!path_.enclose(segment, tool.centre, 0, discs)) return false;  // no smaller disc would do
  CurveDisc disc = tool;
  disc.radius = radius;
  for (int attempt = 0; attempt < 60; ++attempt, disc.radius *= 0.5) {
    if (!path_.enclose(segment, disc.centre, disc.radius, discs)) continue;
    for (std::size_t k = 0; k < path_.axes(); ++k) {
      made_[k] = disc;
      made_[k].first = discs.d1[k].most(), made_[k].second = discs.d2[k].most(), made_[k].third = discs.d3[k].most();
    }
    return disc.radius > 0;
  }
  return false;
}

const std::array<CurveDisc, max_axes>* AxisDiscsAlong::about(std::size_t segment, const CurveDisc& tool, double half) {
  constexpr double wide = 64, narrow = 12;  // discs of so many half widths: interpolation misses no more than rounding
  constexpr double smallest = 1e-6;
  if (segment == segment_) {
    const double left = made_[0].radius - std::abs(tool.centre - made_[0].centre);
    if (left >= std::min(narrow * half, made_[0].radius / 2) && made_[0].radius <= 4 * wide * half) {
      moved_ = made_;
      for (CurveDisc& disc : moved_) disc.centre = tool.centre, disc.radius = left;
      return &moved_;
    }
  }
  if (enclose(segment, tool, std::min(tool.radius, std::max(wide * half, smallest * tool.radius)))) {
    segment_ = segment;
    return &made_;
  }
  segment_ = none;
  return through(path_, segment, tool, moved_) ? &moved_ : nullptr;
}

}  // namespace bahnwerk::verify
