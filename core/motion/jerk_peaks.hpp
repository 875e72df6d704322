#pragma once
/// By how much the law of one cell exceeds limits between its nodes.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/motion/even_samples.hpp"
#include "core/motion/grid.hpp"
#include "core/motion/jerk_problem.hpp"
#include "core/motion/law.hpp"

namespace bahnwerk {

/// The path over a cell from three stations: h″ is the quintic through their values and derivatives, h′ its integral.
template <int M>
class CellPath {
 public:
  /// `middle` lies at `sm` of [0, h].
  CellPath(const JerkStation<M>& left, const JerkStation<M>& middle, const JerkStation<M>& right, double sm, double h)
      : h_(h) {
    const double x = sm / h;
    for (std::size_t k = 0; k < M; ++k) {
      d1_[k] = left.d1[k];
      // Divided differences over the nodes 0 0 x x 1 1 of d2 as a function of s/h.
      const double f0 = left.d2[k], fx = middle.d2[k], f1 = right.d2[k];
      const double g0 = h * left.d3[k], gx = h * middle.d3[k], g1 = h * right.d3[k];
      const double a1 = g0, a2 = (fx - f0) / x, a3 = gx, a4 = (f1 - fx) / (1 - x), a5 = g1;
      const double b1 = (a2 - a1) / x, b2 = (a3 - a2) / x, b3 = (a4 - a3) / (1 - x), b4 = (a5 - a4) / (1 - x);
      const double c1 = (b2 - b1) / x, c2 = b3 - b2, c3 = (b4 - b3) / (1 - x);
      const double e1 = c2 - c1, e2 = (c3 - c2) / (1 - x);
      const double q = e2 - e1;
      // f0 + s (a1 + s (b1 + (s − x)(c1 + (s − x)(e1 + (s − 1) q)))) in powers of s = arc/h
      std::array<double, 6> p{f0, a1, b1, 0, 0, 0};
      const double c = c1, e = e1;
      // (s−x) c
      p[2] += -x * c;
      p[3] += c;
      // (s−x)² e
      p[2] += x * x * e;
      p[3] += -2 * x * e;
      p[4] += e;
      // (s−x)² (s−1) q
      p[2] += -x * x * q;
      p[3] += (x * x + 2 * x) * q;
      p[4] += (-2 * x - 1) * q;
      p[5] += q;
      p_[k] = p;
    }
  }
  void at(double s, JerkStation<M>& out) const {
    const double x = s / h_;
    for (std::size_t k = 0; k < M; ++k) {
      const auto& p = p_[k];
      out.d1[k] =
          d1_[k] + s * (p[0] + x * (p[1] / 2 + x * (p[2] / 3 + x * (p[3] / 4 + x * (p[4] / 5 + x * p[5] / 6)))));
      out.d2[k] = p[0] + x * (p[1] + x * (p[2] + x * (p[3] + x * (p[4] + x * p[5]))));
      out.d3[k] = (p[1] + x * (2 * p[2] + x * (3 * p[3] + x * (4 * p[4] + x * 5 * p[5])))) / h_;
    }
  }

 private:
  double h_;
  std::array<double, M> d1_;
  std::array<std::array<double, 6>, M> p_;
};

/// Peaks over a cell in relation to the limits: of each axis' acceleration and jerk, of (speed/limit)² at worst.
template <int M>
struct CellPeaks {
  std::array<double, M> acceleration{}, jerk{};
  double velocity = 0;
  double doubt = 0;  ///< what any of them may be at most, as far as samples tell
  double most() const {
    double p = velocity;
    for (std::size_t k = 0; k < M; ++k) p = std::max({p, acceleration[k], jerk[k]});
    return p;
  }
};

template <int M>
struct RowLimits {
  std::array<double, M> inverse_velocity2{}, inverse_acceleration{}, inverse_jerk{};
};

namespace jerk_peaks_detail {
/// Largest |f| over [0, 1] from five even samples. `doubt` becomes what they cannot know about.
inline double peak(const std::array<double, 5>& f, double& doubt) {
  const EvenSamples samples(f, 0.7);
  const double fourth = std::abs(f[0] - 4 * f[1] + 6 * f[2] - 4 * f[3] + f[4]);
  doubt = std::max(doubt, samples.peak() + 0.3 * fourth + 0.1 * samples.third);
  return samples.peak();
}
}  // namespace jerk_peaks_detail

/// Largest v² of a piece.
inline double peak_speed2(const LawPiece& law) {
  double most = std::max(law.v, law.at(law.duration).v);
  for (const double t : turning_points(law))
    if (t > 0 && t < law.duration) most = std::max(most, law.at(t).v);
  return most * most;
}

/// `path(s, station)` gives the derivatives at s ∈ [0, h] of the cell.
template <int M, class PathAt>
CellPeaks<M> cell_peaks(const LawPiece& law, double h, const RowLimits<M>& limit, double inverse_feed2, PathAt&& path) {
  std::array<std::array<double, 5>, M> velocity, acceleration, jerk;
  for (std::size_t i = 0; i < 5; ++i) {
    const LawState x = law.at(law.duration * static_cast<double>(i) * 0.25);
    const double b = x.v * x.v;
    JerkStation<M> d;
    path(i == 0 ? 0 : i == 4 ? h : std::clamp(x.s, 0.0, h), d);
    for (std::size_t k = 0; k < M; ++k) {
      velocity[k][i] = d.d1[k] * d.d1[k] * b * limit.inverse_velocity2[k];
      acceleration[k][i] = (d.d2[k] * b + d.d1[k] * x.a) * limit.inverse_acceleration[k];
      jerk[k][i] = (d.d3[k] * b * x.v + 3 * d.d2[k] * x.v * x.a + d.d1[k] * x.j) * limit.inverse_jerk[k];
    }
  }
  CellPeaks<M> peaks;
  peaks.velocity = peak_speed2(law) * inverse_feed2;
  peaks.doubt = peaks.velocity;
  for (std::size_t k = 0; k < M; ++k) {
    peaks.velocity = std::max(peaks.velocity, jerk_peaks_detail::peak(velocity[k], peaks.doubt));
    peaks.acceleration[k] = jerk_peaks_detail::peak(acceleration[k], peaks.doubt);
    peaks.jerk[k] = jerk_peaks_detail::peak(jerk[k], peaks.doubt);
  }
  return peaks;
}

}  // namespace bahnwerk
