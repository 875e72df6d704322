#pragma once
/// The motion law inside one curved cell, and its excess over the limits between the stations.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/motion/acceleration/station_limits.hpp"
#include "core/motion/grid/even_samples.hpp"
#include "core/motion/grid/grid.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// A law with constant jerk over one cell; s counts from the cell's left end.
struct CellLaw {
  double duration, v, a, j;
  LawState at(double tau) const {
    const double change = tau * j;
    return {tau * (v + tau * (0.5 * a + (1.0 / 6) * change)), v + tau * (a + 0.5 * change), a + change, j};
  }
};

/// Returns the law from v1 = √b1 to v2 with the solved acceleration (g − b1)/h at the beginning.
inline CellLaw cell_law(double b1, double v1, double g, double v2, double h) {
  // h = v1 T + (2 a1 + a2) T²/6 and v2 = v1 + (a1 + a2) T/2 ⇒ a1 T²/6 + (2 v1 + v2) T/3 = h
  const double w = 1 / h, a1 = (g - b1) * w, half = (2 * v1 + v2) * (1.0 / 6),
               root = half * half + (g - b1) * (1.0 / 6);
  if (root > 0.01 * half * half) {
    const double mean = half + std::sqrt(root), rate = mean * w;  // 1/T
    return {h / mean, v1, a1, 2 * ((v2 - v1) * rate - a1) * rate};
  }
  const double duration = 2 * h / (v1 + v2);
  return {duration, v1, (v2 - v1) / duration, 0};
}

/// Relative excess over the limits: |axis acceleration|/A − 1, and the larger one of (axis velocity/V)² − 1 and
/// (v/feed)² − 1. It is negative within the limits.
struct Excess {
  double acceleration, velocity;
};

/// The ends of a curved cell.
template <int N>
struct CellEnds {
  const Station<N>&left, &right;
  double b1, b2;  ///< v² of the law at both ends, mm²/s²
  double length() const { return right.s - left.s; }
};

namespace cell_law_detail {

/// The path between two stations from their derivatives: the cubic of h'' and the quintic of h', which are accurate
/// enough on the grid's cells.
template <int N>
struct Between {
  const Station<N>&l, &r;
  double h;
  double d2(std::size_t k, double x) const {
    const double y = 1 - x;
    return y * y * (1 + 2 * x) * l.d2[k] + x * x * (1 + 2 * y) * r.d2[k] + h * x * y * (y * l.d3[k] - x * r.d3[k]);
  }
  double d1(std::size_t k, double x) const {
    const double y = 1 - x;
    return y * y * y *
               ((1 + 3 * x + 6 * x * x) * l.d1[k] + h * (x + 3 * x * x) * l.d2[k] + 0.5 * h * h * x * x * l.d3[k]) +
           x * x * x *
               ((1 + 3 * y + 6 * y * y) * r.d1[k] - h * (y + 3 * y * y) * r.d2[k] + 0.5 * h * h * y * y * r.d3[k]);
  }
};

/// Returns the largest |f| over a cell from five equidistant samples.
inline double peak(const std::array<double, 5>& f) {
  const EvenSamples<double> samples(f, 0.9);
  return samples.most < 0.9 ? samples.most : samples.peak() + 1e-9;
}

}  // namespace cell_law_detail

/// Evaluates both ends and the middle of a cell in which nothing switches. The error of the parabola through these
/// three points is smaller than its second difference by the angle that the path turns. Writes an upper bound of the
/// accelerations' excess; returns false where this is too rough.
template <int N>
[[gnu::always_inline]] inline bool smooth_excess(const CellEnds<N>& ends, const CellLaw& p, const AxisBounds<N>& limit,
                                                 Excess& excess) {
  const Station<N>&l = ends.left, &r = ends.right;
  const double h = ends.length(), b1 = ends.b1, b2 = ends.b2;
  const LawState middle = p.at(0.5 * p.duration);
  const double a2 = p.a + p.duration * p.j, b = middle.v * middle.v, off = middle.s - 0.5 * h, w = 1 / h;
  // The cubic of h'' and the quintic of h' between the stations, at s = h/2 and from there.
  const Lanes<N> turn = r.d2 - l.d2, rate = l.d3 + r.d3;
  const Lanes<N> c = 0.5 * (l.d2 + r.d2) + (0.125 * h) * (l.d3 - r.d3);
  const Lanes<N> t = 0.5 * (l.d1 + r.d1) - (0.15625 * h) * turn + (0.015625 * h * h) * rate;
  const Lanes<N> slope = (1.5 * w) * turn - 0.25 * rate;
  const Lanes<N> f = (b * (c + off * slope) + middle.a * (t + off * c)) * limit.inverse_acceleration,
                 fl = (b1 * l.d2 + p.a * l.d1) * limit.inverse_acceleration,
                 fr = (b2 * r.d2 + a2 * r.d1) * limit.inverse_acceleration;
  const Lanes<N> outer = larger(magnitude(fl), magnitude(fr)), second_difference = fl + fr - 2 * f,
                 size = magnitude(second_difference), tilt = 0.5 * magnitude(fr - fl);
  // A parabola with its vertex inside the cell exceeds f by tilt²/(2 size): this bound needs no division.
  const Lanes<N> peak = larger(outer, magnitude(f));
  double most = largest(peak + smaller(0.125 * size, 0.5 * tilt) + 0.02 * size), bent = largest(size);
  if (most > 1 + 1e-9 || bent >= 1e-3) {
    most = bent = 0;
    for (std::size_t k = 0; k < N; ++k) {
      if (outer[k] < 0.98) continue;
      const double vertex = tilt[k] < size[k] ? std::abs(f[k] - 0.5 * tilt[k] * tilt[k] / second_difference[k]) : 0;
      most = std::max(most, std::max(peak[k], vertex) + 0.02 * size[k]);
      bent = std::max(bent, size[k]);
    }
  }
  excess = {most - 1, -1};
  // The path turns too much to be expanded about s = h/2, or v² is too curved for the reserve of 2 %.
  bool smooth = bent < 1e-3 && std::abs(off) < 0.01 * h && std::abs(b1 - 2 * b + b2) < 1e-3 * b;
  if (std::max(b1, b2) > 0.97 * limit.slowest2) {
    const Lanes<N> fastest = larger(l.d1 * l.d1 * b1, r.d1 * r.d1 * b2);
    for (std::size_t k = 0; k < N; ++k) smooth = smooth && fastest[k] < 0.97 * limit.velocity2[k];
  }
  return smooth && (most <= 1 + 1e-9 || most > 1 + 1e-7);
}

/// Returns the excess over a cell from samples of the law on the reconstructed path. `feed` is the largest speed, mm/s.
/// It is not inlined, because smooth_excess(), which is, decides most cells.
template <int N>
[[gnu::noinline]] Excess cell_excess(const CellEnds<N>& ends, const CellLaw& p, const GridCell& cell,
                                     const AxisBounds<N>& limit, double feed) {
  constexpr std::size_t last = 4;
  const double h = ends.length();
  const cell_law_detail::Between<N> path{ends.left, ends.right, h};
  std::array<std::array<double, last + 1>, 2 * N> value{};
  double fastest = 0;
  for (std::size_t i = 0; i <= last; ++i) {
    const LawState law = p.at(p.duration * static_cast<double>(i) / last);
    const double x = i == 0 ? 0 : i == last ? 1 : law.s / h, b = law.v * law.v;
    fastest = std::max(fastest, b);
    for (std::size_t k = 0; k < N; ++k) {
      const double d1 = path.d1(k, x);
      value[k][i] = (path.d2(k, x) * b + d1 * law.a) / limit.acceleration[k];
      value[N + k][i] = d1 * d1 * b / (limit.velocity[k] * limit.velocity[k]);
    }
  }
  Excess worst{0, fastest / (feed * feed)};
  for (std::size_t k = 0; k < N; ++k) {
    // The model does not hold next to a cusp; half of the limit is reserved there.
    if (!cell.cusp_left && !cell.cusp_right)
      worst.acceleration = std::max(worst.acceleration, cell_law_detail::peak(value[k]));
    worst.velocity = std::max(worst.velocity, cell_law_detail::peak(value[N + k]));
  }
  return {worst.acceleration - 1, worst.velocity - 1};
}

}  // namespace bahnwerk
