#pragma once
/// What limits of jerk leave of the axes' accelerations around a node of the relaxation.
///
/// Where an axis goes on in its direction its acceleration is no more than √(2 J u) and something that follows from the
/// end of its way (core/verify/bound/jerk_cap.hpp), u its speed. This is convex in b and v̇ together: a limit that the
/// relaxation can take in the place of A_k. What it takes has to hold wherever the hat of a node is not 0.
#include <array>
#include <cstddef>

#include "core/motion/relaxation/weak_form.hpp"
#include "core/verify/bound/bound_grid.hpp"
#include "core/verify/bound/jerk_dual.hpp"

namespace bahnwerk::verify {

/// What the pieces of a cell have in common.
template <int N>
struct JerkWays {
  using Row = std::array<double, N>;
  std::array<int, N> direction{};  ///< of the axes; 0: they stand still
  /// By how much the accelerations against and in their directions may exceed √(2 J u), mm/s²; infinite where an axis
  /// may turn round.
  Row ahead{}, behind{};
  Row size{};        ///< the largest |q′_k|, about
  double speed = 0;  ///< mm/s, about

  /// One piece more, where a motion is about so fast.
  void add(const DualPiece<N>& piece, const Row& ahead_of_it, const Row& behind_it, double speed_there);
};

/// Around a node, between its two cells. In the place of A_k only where that is about what counts: at the speeds that
/// are likely.
template <int N>
RelaxationLimit<N> jerk_limit(const JerkWays<N>& before, const JerkWays<N>& after, const BoundGrid<N>& grid);

extern template struct JerkWays<2>;
extern template struct JerkWays<3>;
extern template struct JerkWays<5>;
extern template struct JerkWays<8>;
extern template RelaxationLimit<2> jerk_limit(const JerkWays<2>&, const JerkWays<2>&, const BoundGrid<2>&);
extern template RelaxationLimit<3> jerk_limit(const JerkWays<3>&, const JerkWays<3>&, const BoundGrid<3>&);
extern template RelaxationLimit<5> jerk_limit(const JerkWays<5>&, const JerkWays<5>&, const BoundGrid<5>&);
extern template RelaxationLimit<8> jerk_limit(const JerkWays<8>&, const JerkWays<8>&, const BoundGrid<8>&);

}  // namespace bahnwerk::verify
