#pragma once
/// Limits of the axes' accelerations around a node of the relaxation that follow from limits of jerk.
///
/// An axis that keeps its direction has an acceleration of at most √(2 J u) and a term that follows from the end of the
/// distance (core/verify/bound/jerk_cap.hpp), u its speed. This is convex in b and v̇ together: a limit that the
/// relaxation can use in the place of A_k. It has to hold wherever the hat of a node is not 0.
#include <array>
#include <cstddef>

#include "core/motion/relaxation/weak_form.hpp"
#include "core/verify/bound/bound_grid.hpp"
#include "core/verify/bound/jerk_dual.hpp"

namespace bahnwerk::verify {

/// Common bounds of the pieces of a cell.
template <int N>
struct JerkWays {
  using Row = std::array<double, N>;
  std::array<int, N> direction{};  ///< of the axes; 0: standing still
  /// Bounds of the excess of the accelerations against and in their directions over √(2 J u), mm/s²; infinite where an
  /// axis may turn round.
  Row ahead{}, behind{};
  Row size{};        ///< approximate largest |q′_k|
  double speed = 0;  ///< mm/s, approximate

  /// Adds a piece, on which a motion has about that speed.
  void add(const DualPiece<N>& piece, const Row& ahead_of_it, const Row& behind_it, double speed_there);
};

/// Returns the limits around a node, between its two cells, in the place of A_k where they are about the tighter ones
/// at likely speeds.
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
