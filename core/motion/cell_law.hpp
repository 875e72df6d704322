#pragma once
/// The motion law inside one curved cell, and by how much it exceeds the limits between the stations.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/motion/even_samples.hpp"
#include "core/motion/grid.hpp"
#include "core/motion/law.hpp"
#include "core/motion/station_limits.hpp"

namespace bahnwerk {

/// Jerk constant in time over one cell; s counts from its left end.
struct CellLaw {
  double duration = 0, v = 0, a = 0, j = 0;
  LawState at(double tau) const {
    return {tau * (v + tau * (a / 2 + tau * j / 6)), v + tau * (a + tau * j / 2), a + tau * j, j};
  }
};

/// From v1 = √b1 to v2 = √b2 with the solved acceleration (g − b1)/h at the begin; s counts from the cell's left end.
inline CellLaw cell_law(double b1, double v1, double g, double b2, double v2, double h) {
  CellLaw p;
  p.v = v1;
  if (b1 == g && g == b2) {
    p.duration = h / v1;
    return p;
  }
  // h = v1 T + (2 a1 + a2) T²/6 and v2 = v1 + (a1 + a2) T/2 ⇒ a1 T²/6 + (2 v1 + v2) T/3 = h
  const double w = 1 / h, a1 = (g - b1) * w, half = (2 * v1 + v2) * (1.0 / 6),
               root = half * half + (g - b1) * (1.0 / 6);
  if (root > 0.01 * half * half) {
    const double mean = half + std::sqrt(root), rate = mean * w;  // 1/T
    p.duration = h / mean;
    p.a = a1;
    p.j = 2 * ((v2 - v1) * rate - a1) * rate;
  } else {
    p.duration = 2 * h / (v1 + v2);
    p.a = (v2 - v1) / p.duration;
  }
  return p;
}

/// Relative excess over the limits: of |axis acceleration|/A, and of (axis velocity/V)², (v/feed)². Negative = within.
struct Excess {
  double acceleration = -1, velocity = -1;
};

namespace cell_law_detail {

/// The path between two stations from their derivatives: the cubic of h'' and the quintic of h' that the grid keeps
/// exact enough.
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

/// Largest |f| over a cell from five even samples.
inline double peak(const std::array<double, 5>& f) {
  const EvenSamples<double> samples(f, 0.9);
  return samples.most < 0.9 ? samples.most : samples.peak() + 1e-9;
}

}  // namespace cell_law_detail

/// Where nothing switches inside a cell a look at both ends and at half time is enough: what the parabola through these
/// three points hides is smaller than its bend by the angle that the path turns. Returns what the accelerations exceed
/// their limits by at most; false where that is too rough to judge by.
template <int N>
inline bool smooth_excess(const Station<N>& l, const Station<N>& r, double h, const CellLaw& p, double b1, double b2,
                          const AxisBounds<N>& limit, Excess& excess) {
  const LawState middle = p.at(0.5 * p.duration);
  const double a2 = p.a + p.duration * p.j, b = middle.v * middle.v, off = middle.s - 0.5 * h;
  // Too far to expand the path about s = h/2, or v² bends too much for the reserve of 2 % below.
  bool smooth = std::abs(off) < 0.01 * h && std::abs(b1 - 2 * b + b2) < 1e-3 * b;
  double most = 0;
  const Lanes<N> fl = (l.d2 * b1 + l.d1 * p.a) * limit.inverse_acceleration,
                 fr = (r.d2 * b2 + r.d1 * a2) * limit.inverse_acceleration;
  for (std::size_t k = 0; k < N; ++k) {
    const double ends = std::max(std::abs(fl[k]), std::abs(fr[k]));
    if (ends < 0.98) continue;
    // The cubic of h'' and the quintic of h' between the stations, at s = h/2 and from there.
    const double c = 0.5 * (l.d2[k] + r.d2[k]) + 0.125 * h * (l.d3[k] - r.d3[k]);
    const double t =
        0.5 * (l.d1[k] + r.d1[k]) + h * (0.15625 * (l.d2[k] - r.d2[k]) + 0.015625 * h * (l.d3[k] + r.d3[k]));
    const double slope = 1.5 * (r.d2[k] - l.d2[k]) / h - 0.25 * (l.d3[k] + r.d3[k]);
    const double f = ((c + off * slope) * b + (t + off * c) * middle.a) * limit.inverse_acceleration[k];
    const double bend = fl[k] - 2 * f + fr[k], tilt = std::abs(0.5 * (fr[k] - fl[k])), size = std::abs(bend);
    double peak = std::max(ends, std::abs(f));
    if (tilt < size) {  // the parabola's vertex lies tilt²/(2 size) beyond f: less than this, which needs no division
      const double rise = std::min(0.125 * size, 0.5 * tilt);
      peak =
          peak + rise + 0.02 * size <= 1 + 1e-9 ? peak + rise : std::max(peak, std::abs(f - 0.5 * tilt * tilt / bend));
    }
    smooth = smooth && size < 1e-3;
    most = std::max(most, peak + 0.02 * size);
  }
  if (std::max(b1, b2) > 0.97 * limit.slowest2) {
    const Lanes<N> vl = l.d1 * l.d1 * b1, vr = r.d1 * r.d1 * b2;
    for (std::size_t k = 0; k < N; ++k) smooth = smooth && std::max(vl[k], vr[k]) < 0.97 * limit.velocity2[k];
  }
  excess = {most - 1, -1};
  return smooth && (most <= 1 + 1e-9 || most > 1 + 1e-7);
}

/// Peaks over a cell, from samples of the law on the rebuilt path.
template <int N>
inline Excess cell_excess(const Station<N>& l, const Station<N>& r, double h, const CellLaw& p, const GridCell& cell,
                          const AxisBounds<N>& limit, double feed) {
  constexpr std::size_t last = 4;
  const cell_law_detail::Between<N> path{l, r, h};
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
    // The model does not hold next to a cusp; half of the limit is in reserve there.
    if (!cell.cusp_left && !cell.cusp_right)
      worst.acceleration = std::max(worst.acceleration, cell_law_detail::peak(value[k]));
    worst.velocity = std::max(worst.velocity, cell_law_detail::peak(value[N + k]));
  }
  return {worst.acceleration - 1, worst.velocity - 1};
}

}  // namespace bahnwerk
