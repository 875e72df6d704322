#pragma once
/// The rows of JerkProblem as the interior-point method sees them: linearisations, slacks and multipliers of both
/// sides.
#include <algorithm>
#include <bit>

#include "core/motion/jerk_problem.hpp"
#include "core/numeric/lanes.hpp"

namespace bahnwerk {

template <int M>
inline Lanes<M> lanes(const std::array<double, M>& a) {
  return std::bit_cast<Lanes<M>>(a);
}
template <int M>
inline Lanes<M> all_lanes(double a) {
  std::array<double, M> r;
  r.fill(a);
  return lanes<M>(r);
}
template <int M>
inline double sum(const Lanes<M>& a) {
  double s = a[0];
  for (std::size_t k = 1; k < M; ++k) s += a[k];
  return s;
}
template <int M>
inline Lanes<M> larger(const Lanes<M>& a, const Lanes<M>& b) {
  if constexpr (M == 2) {
    return a > b ? a : b;
  } else {
    return Lanes<M>::each([&](std::size_t i) { return std::max(a[i], b[i]); });
  }
}
template <int M>
inline double largest(const Lanes<M>& a) {
  double most = a[0];
  for (std::size_t k = 1; k < M; ++k) most = std::max(most, a[k]);
  return most;
}

/// State of M two-sided rows |g| ≤ share: slacks s and multipliers z of both sides, 1/s, and the step of the slacks.
template <int M>
struct RowState {
  Lanes<M> sp, sm, zp, zm, ip, im, dp, dm;

  /// Slacks are what is free, but at least `least`.
  void begin(const Lanes<M>& g, const Lanes<M>& share, double mu, double least) {
    const Lanes<M> wall = all_lanes<M>(least);
    sp = larger<M>(share - g, wall);
    sm = larger<M>(share + g, wall);
    ip = 1.0 / sp;
    im = 1.0 / sm;
    zp = mu * ip;
    zm = mu * im;
    dp = dm = all_lanes<M>(0);
  }
  /// Takes parts of the step that aimed at s z = mu.
  void move(double mu, double primal, double dual) {
    zp = zp + dual * ((mu - zp * dp) * ip - zp);
    zm = zm + dual * ((mu - zm * dm) * im - zm);
    sp = sp + primal * dp;
    sm = sm + primal * dm;
  }
  /// Weights and right-hand sides of the rows in the Newton system; sums of s z and largest residuals are added up.
  void weigh(const Lanes<M>& g, const Lanes<M>& share, double mu, Lanes<M>& w, Lanes<M>& y, Lanes<M>& gap,
             Lanes<M>& violation) {
    dp = share - g - sp;
    dm = share + g - sm;
    ip = 1.0 / sp;
    im = 1.0 / sm;
    w = zp * ip + zm * im;
    y = (mu - zp * dp) * ip - (mu - zm * dm) * im;
    gap = gap + sp * zp + sm * zm;
    violation = larger<M>(violation, larger<M>(magnitude<M>(dp), magnitude<M>(dm)));
  }
  /// The step when the values change by `d`; `primal` and `dual` become at least 1/(the part of it that reaches zero).
  void step(const Lanes<M>& d, double mu, Lanes<M>& primal, Lanes<M>& dual) {
    dp = dp - d;
    dm = dm + d;
    const Lanes<M> fp = dp * ip, fm = dm * im;
    primal = larger<M>(primal, larger<M>(-1.0 * fp, -1.0 * fm));
    dual = larger<M>(dual, larger<M>(1.0 + fp - mu * ip / zp, 1.0 + fm - mu * im / zm));
  }
};

/// Jerk rows at one end of a cell: value g and gradient t · (that of the path's jerk) + (nb, na) on the node there.
template <int M>
struct JerkRows {
  Lanes<M> g, t, nb, na;
};
template <int M>
inline JerkRows<M> jerk_rows(const JerkStation<M>& s, JerkNode x, JerkSpeed speed, double j,
                             const Lanes<M>& inverse_jerk) {
  const double v = speed.v, va = v * x.a, vb = x.b * v, w = x.b > 0 ? 3 * x.a * speed.dv : 0;
  const Lanes<M> d1 = inverse_jerk * lanes<M>(s.d1), d2 = inverse_jerk * lanes<M>(s.d2),
                 d3 = inverse_jerk * lanes<M>(s.d3);
  return {d3 * vb + d2 * (3 * va) + d1 * j, d1, d3 * (1.5 * v) + d2 * w, d2 * (3 * v)};
}

/// The middle Bernstein coefficient of a(t), with its gradient.
struct JerkMiddle {
  double g = 0;
  std::array<double, 4> dg{};
};
inline JerkMiddle jerk_middle(JerkNode l, JerkSpeed vl, JerkNode r, JerkSpeed vr, const JerkCell& cell) {
  const double u = 1 / cell.T, mean = (vr.v - vl.v) * u, gT = -3 * mean * u;
  return {3 * mean - l.a - r.a,
          {gT * cell.dT[0] - 3 * u * vl.dv, gT * cell.dT[1] - 1, gT * cell.dT[2] + 3 * u * vr.dv, gT * cell.dT[3] - 1}};
}

}  // namespace bahnwerk
