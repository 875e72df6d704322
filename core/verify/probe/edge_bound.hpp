#pragma once
/// The least time between two points of a probe path, bounded from below by a certificate.
///
/// Let x be any right motion, passing A at time 0 and B at time h. For times t_k = h g_k, r! times the divided
/// difference of order r of its positions is a mean of x^(r), so its norm is at most V for r = 1, and each axis' value
/// at most L_r for r = 2, 3, 4. The positions themselves lie in capsules: in that of the edge for 0 ≤ g ≤ 1, in those
/// of its neighbours during their least times, in a point where the head is at rest. With D_r x = r! [g_k … g_(k+r)] x
/// every choice of multipliers y satisfies
///     Σ y·D x ≤ Σ_r h^r L_r |y_r|      and      Σ y·D x = Σ_k (Dᵀy)_k·x_k ≥ −Σ_k σ_k(−(Dᵀy)_k),
/// σ_k the support function of the capsule of x_k. So h is at least the root of Σ_r h^r L_r |y_r| = C, the last
/// sum: weak duality, by which any y proves a bound. Close bounds come from the multipliers of the convex problem,
/// which an interior-point method finds; without convergence the bound is less close, and still a bound. If the
/// capsules hold for a time h g, they hold for the shorter times of a smaller h: the bound covers all of them.
#include <array>
#include <cstddef>
#include <vector>

namespace bahnwerk {

/// The set of all points within `radius` of the segment from `p` to `q`, mm.
template <int D>
struct SampleSet {
  std::array<double, D> p{}, q{};
  double radius = 0;
  bool with_last = false;  ///< the position equals that of the sample before: the head is at rest
};

template <int D>
struct EdgeBoundProblem {
  std::vector<double> grid;                           ///< g_k, ascending; the points are passed at 0 and 1
  std::vector<SampleSet<D>> set;                      ///< sets in which x(h g_k) lies
  double speed = 0;                                   ///< V, mm/s
  std::array<std::array<double, D>, 3> derivative{};  ///< L_2, L_3, L_4 per axis, mm/s², mm/s³, mm/s⁴
};

/// Multipliers of the divided differences: y[r − 1][k] belongs to samples k … k + r.
template <int D>
using EdgeMultipliers = std::array<std::vector<std::array<double, D>>, 4>;

/// Returns r! [g_k … g_(k+r)] as coefficients of the r + 1 samples; index r − 1.
std::array<std::vector<std::array<double, 5>>, 4> difference_rows(const std::vector<double>& grid);

/// Returns the proven lower bound of h, s, rounded down; 0 where the multipliers prove nothing. O(samples).
template <int D>
double certified_time(const EdgeBoundProblem<D>& problem, const EdgeMultipliers<D>& y);

/// Returns multipliers near the best ones, which are those of the samples' least h. O(samples) an iteration,
/// `iterations` at most.
template <int D>
EdgeMultipliers<D> edge_multipliers(const EdgeBoundProblem<D>& problem, int iterations);

}  // namespace bahnwerk
