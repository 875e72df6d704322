#pragma once
/// The dual function of jerk-limited motion along a path: for any multipliers, less than the time of every motion.
///
/// Let b = v², c = 1/v, a_k = q″_k b + q′_k b′/2 the acceleration of axis k, so that time is ∫ c ds and |a_k′| ≤ J_k c.
/// Take any λ_k(s) that is continuously differentiable and any continuous μ_k(s). With η_k = μ_k − λ_k′,
///   w = 1 − Σ J_k |λ_k| ≥ 0   and   G = ½ Σ (η_k q″_k − η_k′ q′_k),
/// integrating λ_k a_k′ by parts twice gives, for every motion within the limits,
///   ∫ c ds ≥ ∫ (w c + G b) ds − Σ_k [ A_k ∫ |μ_k| ds + Σ_joints (λ_k Δa_k + ½ η_k Δq′_k b) ],
/// since acceleration and b vanish at rests; at a free end λ, λ′ and μ have to vanish instead. Because c = b^(−1/2) and
/// b ≤ cap (from the bound without jerk), w c + G b is no less than
///   f(w, G) = min over 0 < b ≤ cap of w b^(−1/2) + G b:   3/2 w^(2/3) (2G)^(1/3), or w cap^(−1/2) + G cap.
/// Every choice of multipliers yields a lower bound; those of the convex problem in core/motion/relaxation are close to
/// the best. That solver only supplies numbers: none of its results can make the bound wrong.
///
/// Enclosures: f is concave and increasing in w and in G. Over a piece both have known means (∫ G ds follows from q and
/// q′ at its ends, w is at least a quadratic) and known ranges (|G′| ≤ ½ Σ |η_k| |q‴_k|, since η_k is linear), and the
/// mean of a concave function is at least the least mean over the corners of these ranges. Rounding is covered by
/// margins from the magnitudes of the summands, as in lower_bound.hpp.
///
/// At a joint an axis steps by Δa_k = Δq″_k b + Δq′_k v̇, since the acceleration v̇ along the path is continuous, and
/// by at most J_k · cycle time; the verifier checks both. The joint's term is therefore bounded in one of two ways: by
/// its known part λ_k Δq″_k b, which may have either sign, or by the magnitude of the whole, |λ_k| J_k · cycle time.
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/motion/relaxation/relaxation.hpp"
#include "core/verify/bound/blocks.hpp"
#include "core/verify/bound/bound_grid.hpp"

namespace bahnwerk::verify {

/// Steps at a place of the path. Joints without a piece between them are added up.
template <int N>
struct DualJoint {
  using Row = std::array<double, N>;
  bool here = false;                        ///< whether there is a joint
  Row tangent_jump{}, acceleration_step{};  ///< Δq′_k, and the known part of Δa_k, per b
  Row step{};                               ///< bound of |Δa_k − acceleration_step_k b|
  double cap = 0;                           ///< largest b, mm²/s²
};

/// A part of a segment on which the dual function is evaluated.
template <int N>
struct DualPiece {
  using Row = std::array<double, N>;
  std::size_t segment = 0;
  double u0 = 0, u1 = 0;               ///< parameters of the ends on the segment's curve
  Row displacement{}, begin{}, end{};  ///< q at the end − at the begin, q′ at both ends
  Row q2{};                            ///< largest |q″_k| at the ends
  Row third{};                         ///< bounds of |q‴_k|, 1/mm²
  double length = 0;                   ///< mm
  double cap = 0;                      ///< largest b on the piece, mm²/s²
  double along = 0;                    ///< largest |v̇| on the piece, mm/s²
  double time = 0;                     ///< approximate duration, s
  double rounding = 0;                 ///< relative rounding error of the length and of q′
  double displacement_error = 0;       ///< effect of rounding of q at either end on a component of `displacement`
  DualJoint<N> joint;                  ///< joint before the beginning
};

/// Returns the piece between two places of one segment with |q‴_k| ≤ `third`; without a joint.
template <int N>
DualPiece<N> dual_piece(const BoundGrid<N>& grid, const BoundNode<N>& a, const BoundNode<N>& b, double cap,
                        const typename DualPiece<N>::Row& third);

/// Evaluates the dual function for N axes.
template <int N>
class JerkDual {
 public:
  using Row = std::array<double, N>;
  /// `grid` and `progress` have to outlive the object.
  JerkDual(const BoundGrid<N>& grid, ProgressScope& progress) : grid_(grid), progress_(progress) {}

  /// Returns the value for the pieces [first, last), which form whole cells of a relaxation: cell_of[i] is the cell of
  /// piece i, for all of the pieces. Pieces on which the enclosure loses much are halved, at most 8 times. O(pieces),
  /// 0.2 µs each for two axes.
  double value(const Blocks<DualPiece<N>>& pieces, std::size_t first, std::size_t last,
               const std::vector<std::size_t>& cell_of, const RelaxationProblem<N>& problem,
               const RelaxationMultipliers<N>& multipliers);

 private:
  struct Value {
    double now = 0, loss = 0;  ///< value, and bound of what halving can gain
  };
  void enter(std::size_t cell, const RelaxationProblem<N>& problem, const RelaxationMultipliers<N>& multipliers);
  /// Returns the value of a piece x mm from the cell's beginning; `next` is the piece behind it, if a joint lies
  /// between.
  Value of(const DualPiece<N>& piece, double x, const DualPiece<N>* next) const;
  /// Nodes at the beginning and end of a piece; null if unknown.
  using Ends = std::pair<const BoundNode<N>*, const BoundNode<N>*>;
  double refined(const DualPiece<N>& piece, double x, const DualPiece<N>* next, Value coarse, int depth, Ends ends);

  const BoundGrid<N>& grid_;
  ProgressScope& progress_;
  /// Values of the current cell: its length, its splines with their w and λ, and μ at its ends.
  double length_ = 0;
  std::array<SplinePart, 3> parts_{};
  std::array<double, 3> weight_{};
  std::array<Row, 3> lambda_{};
  std::array<Row, 2> mu_{};
};

extern template class JerkDual<2>;
extern template class JerkDual<3>;
extern template class JerkDual<5>;
extern template class JerkDual<8>;
extern template DualPiece<2> dual_piece(const BoundGrid<2>&, const BoundNode<2>&, const BoundNode<2>&, double,
                                        const DualPiece<2>::Row&);
extern template DualPiece<3> dual_piece(const BoundGrid<3>&, const BoundNode<3>&, const BoundNode<3>&, double,
                                        const DualPiece<3>::Row&);
extern template DualPiece<5> dual_piece(const BoundGrid<5>&, const BoundNode<5>&, const BoundNode<5>&, double,
                                        const DualPiece<5>::Row&);
extern template DualPiece<8> dual_piece(const BoundGrid<8>&, const BoundNode<8>&, const BoundNode<8>&, double,
                                        const DualPiece<8>::Row&);

}  // namespace bahnwerk::verify
