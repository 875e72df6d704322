#pragma once
/// Peaks of the law of one cell between its nodes, in relation to the limits.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/motion/grid/even_samples.hpp"
#include "core/motion/grid/grid.hpp"
#include "core/motion/jerk/problem.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// The path over a cell from three stations: h″ is the quintic through their values and derivatives, h′ its integral.
template <int M>
class CellPath {
 public:
  CellPath() = default;  // empty
  /// `middle` lies at `sm` ∈ (0, h).
  CellPath(const JerkStation<M>& left, const JerkStation<M>& middle, const JerkStation<M>& right, double sm, double h)
      : w_(1 / h), d1_(left.d1) {
    const double x = sm * w_, y = 1 - x, ix = 1 / x, iy = 1 / y;
    // Divided differences over the nodes 0 0 x x 1 1 of h″ as a function of s/h.
    const Lanes<M>&f0 = left.d2, &fx = middle.d2, &f1 = right.d2;
    const Lanes<M> a1 = h * left.d3, a2 = ix * (fx - f0), a3 = h * middle.d3, a4 = iy * (f1 - fx), a5 = h * right.d3;
    const Lanes<M> b1 = ix * (a2 - a1), b2 = ix * (a3 - a2), b3 = iy * (a4 - a3), b4 = iy * (a5 - a4);
    const Lanes<M> c1 = ix * (b2 - b1), c2 = b3 - b2, c3 = iy * (b4 - b3);
    const Lanes<M> e = c2 - c1, q = c3 - c2 - e;
    // f0 + s (a1 + s (b1 + (s − x)(c1 + (s − x)(e + (s − 1) q)))) in powers of s = arc/h
    p_ = {f0, a1, b1 - x * c1 + (x * x) * (e - q), c1 - (2 * x) * e + (x * x + 2 * x) * q, e - (2 * x + 1) * q, q};
  }
  JerkStation<M> at(double s) const {
    const double x = s * w_;
    const auto& p = p_;
    return {d1_ + s * (p[0] + x * ((1.0 / 2) * p[1] +
                                   x * ((1.0 / 3) * p[2] +
                                        x * ((1.0 / 4) * p[3] + x * ((1.0 / 5) * p[4] + x * ((1.0 / 6) * p[5])))))),
            p[0] + x * (p[1] + x * (p[2] + x * (p[3] + x * (p[4] + x * p[5])))),
            w_ * (p[1] + x * (2.0 * p[2] + x * (3.0 * p[3] + x * (4.0 * p[4] + x * (5.0 * p[5])))))};
  }

 private:
  double w_ = 0;
  Lanes<M> d1_{};
  std::array<Lanes<M>, 6> p_{};
};

/// Peaks over a cell as fractions of the limits: acceleration and jerk of each axis, and the largest (speed/limit)².
template <int M>
struct CellPeaks {
  std::array<double, M> acceleration{}, jerk{};
  double velocity = 0;
  double doubt = 0;  ///< upper estimate of any of them, as far as samples show
  double most() const {
    double p = velocity;
    for (std::size_t k = 0; k < M; ++k) p = std::max({p, acceleration[k], jerk[k]});
    return p;
  }
};

/// Inverse limits: 1/V², 1/A, 1/J of each quantity.
template <int M>
struct RowLimits {
  std::array<double, M> inverse_velocity2{}, inverse_acceleration{}, inverse_jerk{};
};

namespace jerk_peaks_detail {
/// Returns the largest |f| over [0, 1] from five equidistant samples; `doubt` becomes the part that samples cannot
/// exclude.
template <class L>
inline L peak(const std::array<L, 5>& f, L& doubt) {
  const EvenSamples<L> samples(f, 0.7);
  const L fourth = magnitude(f[0] - 4.0 * f[1] + 6.0 * f[2] - 4.0 * f[3] + f[4]), most = samples.peak();
  doubt = larger(doubt, most + 0.3 * fourth + 0.1 * samples.third);
  return most;
}
}  // namespace jerk_peaks_detail

/// Returns the largest v² of a piece, mm²/s².
inline double peak_speed2(const LawPiece& law) {
  double most = std::max(law.v, law.at(law.duration).v);
  for (const double t : turning_points(law))
    if (t > 0 && t < law.duration) most = std::max(most, law.at(t).v);
  return most * most;
}

/// The path over a cell of `length` mm: its derivatives at both ends, and between them as `at(s)`, s ∈ (0, length).
template <int M, class PathAt>
struct CellPlaces {
  const JerkStation<M>&left, &right;
  double length;
  PathAt at;
};
template <int M, class PathAt>
CellPlaces(const JerkStation<M>&, const JerkStation<M>&, double, PathAt) -> CellPlaces<M, PathAt>;

/// `inverse_feed2` is 1/v² of the largest speed along the path.
template <int M, class PathAt>
CellPeaks<M> cell_peaks(const LawPiece& law, const CellPlaces<M, PathAt>& path, const RowLimits<M>& limit,
                        double inverse_feed2) {
  std::array<Lanes<M>, 5> velocity, acceleration, jerk;
  for (std::size_t i = 0; i < 5; ++i) {
    const LawState x = law.at(law.duration * static_cast<double>(i) * 0.25);
    const double b = x.v * x.v;
    const JerkStation<M> d = i == 0 ? path.left : i == 4 ? path.right : path.at(std::clamp(x.s, 0.0, path.length));
    velocity[i] = b * d.d1 * d.d1 * lanes(limit.inverse_velocity2);
    acceleration[i] = (b * d.d2 + x.a * d.d1) * lanes(limit.inverse_acceleration);
    jerk[i] = ((b * x.v) * d.d3 + (3 * x.v * x.a) * d.d2 + x.j * d.d1) * lanes(limit.inverse_jerk);
  }
  CellPeaks<M> peaks;
  Lanes<M> doubt = 0.0 * velocity[0];
  peaks.velocity = std::max(peak_speed2(law) * inverse_feed2, largest(jerk_peaks_detail::peak(velocity, doubt)));
  peaks.acceleration = numbers<M>(jerk_peaks_detail::peak(acceleration, doubt));
  peaks.jerk = numbers<M>(jerk_peaks_detail::peak(jerk, doubt));
  peaks.doubt = std::max(peaks.velocity, largest(doubt));
  return peaks;
}

}  // namespace bahnwerk
