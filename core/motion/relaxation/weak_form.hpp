#pragma once
/// The relaxation (core/motion/relaxation/relaxation.hpp) as a finite problem: its input and its weak form.
///
/// Discretisation: b is constant in each cell. The limits hold in the mean: acceleration weighted by hat functions,
/// jerk weighted by the quadratic B-splines B_j. T_j ≥ ∫ B_j c ds is the time under that weight. The problem is
///   minimise Σ T_j   subject to
///   |∫ B_j da_k − Σ B_j step_k b| ≤ J_k (T_j + time_jk),   |∫ hat_i a_k ds| ≤ A_k ∫ hat_i ds,   b ≤ cap.
/// The sum in the first row is over the joints in the support of B_j; step_k is their acceleration step, time_jk their
/// J_k · time with the weight B_j.
/// Integrated by parts, the integrals need q at the nodes and q′ on both sides of them, no q″. The weak form is chosen
/// so that its multipliers are feasible for the continuous problem, too: λ_k = Σ λ_jk B_j is continuously
/// differentiable, μ_k = Σ μ_ik hat_i is continuous, and Σ_k J_k |λ_jk| ≤ 1 for each j makes 1 − Σ J_k |λ_k| ≥ 0
/// everywhere. core/verify/bound/jerk_bound.hpp turns them into a proven bound, independent of their accuracy.
#include <array>
#include <cstddef>
#include <vector>

#include "core/motion/relaxation/splines.hpp"

namespace bahnwerk {

/// A cell of the relaxation: a part of the path.
template <int N>
struct RelaxationCell {
  using Row = std::array<double, N>;
  double length = 0;   ///< mm, > 0
  Row displacement{};  ///< q_k at the end − q_k at the begin
  Row begin{}, end{};  ///< q′_k at both ends, on this cell's side
  double cap = 0;      ///< largest b in the cell, mm²/s², finite and > 0
};

/// A joint, at which q′_k jumps by tangent_jump[k] and q″_k by acceleration_step[k]: the acceleration of axis k jumps
/// by acceleration_step[k] · b, and may jump by J_k · time[k] more.
template <int N>
struct RelaxationStep {
  std::size_t cell = 0;
  double at = 0;                 ///< place, mm from the cell's beginning
  std::array<double, N> time{};  ///< additional jump as a time at the jerk limit, s
  std::array<double, N> tangent_jump{}, acceleration_step{};
};

/// The input: cells, joints and limits of N axes.
template <int N>
struct RelaxationProblem {
  using Row = std::array<double, N>;
  std::vector<RelaxationCell<N>> cells;
  std::vector<RelaxationStep<N>> steps;
  Row acceleration{}, jerk{};  ///< limits; jerk may be infinite
  bool rest_first = true,
       rest_last = true;  ///< whether the motion rests there; otherwise speed and acceleration are free
};

/// Returns the B-splines on a cell. Beyond the ends lengths are mirrored; the neighbours of a single cell have its own
/// length.
template <int N>
std::array<SplinePart, 3> splines_on(const std::vector<RelaxationCell<N>>& cells, std::size_t cell) {
  const double h = cells[cell].length;
  return spline_parts(cell > 0 ? cells[cell - 1].length : h, h, cell + 1 < cells.size() ? cells[cell + 1].length : h);
}

/// Coefficients of b of one cell, by the place of the cell in the support of a spline or a hat.
template <int N>
struct WeakCell {
  using Row = std::array<double, N>;
  std::array<double, 3> time{};       ///< ∫ B_j ds
  std::array<Row, 3> jerk{};          ///< ∫ B_j da_k / J_k per b; 0 for splines that a free end excludes
  std::array<Row, 2> acceleration{};  ///< ∫ hat a_k ds / (A_k ∫ hat ds) per b; 0 for hats that a free end excludes
};

/// The coefficients of the finite problem.
template <int N>
struct WeakForm {
  std::vector<WeakCell<N>> cells;              ///< two empty cells at each end: cell i is stored as i + 2
  std::vector<std::array<double, N>> allowed;  ///< step_jk of each spline j and axis k, s
  std::vector<double> mass;                    ///< ∫ hat ds of each node, mm

  /// Computes the weak form of a problem. O(cells). Reuses its memory.
  void take(const RelaxationProblem<N>& problem);
};

extern template struct WeakForm<2>;
extern template struct WeakForm<3>;
extern template struct WeakForm<5>;
extern template struct WeakForm<8>;

}  // namespace bahnwerk
