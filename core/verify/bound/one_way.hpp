#pragma once
/// The distance that every axis travels in an unchanged direction from a place of the bound's grid, forwards and
/// backwards.
///
/// The distance ends in a cell whose enclosure does not exclude that the axis reverses, at a joint where q′_k jumps by
/// more than rounding, and at an open end of the grid. It does not end at a rest, where the acceleration is zero: it is
/// unlimited if it reaches one. The steps of acceleration that limits of jerk allow at joints are added up; when their
/// sum reaches a part of the acceleration limit, the distance ends as well. At the node where the distance ends, the
/// acceleration is at most |q″_k| b + |q′_k| |v̇|, which is small where the axis reverses.
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/verify/bound/bound_grid.hpp"
#include "core/verify/bound/jerk_cap.hpp"

namespace bahnwerk::verify {

/// The distances of N axes at all nodes of a grid.
template <int N>
class OneWay {
 public:
  /// Computes the distances for the first nodes of the current grid, which has to outlive the object; `b` is the
  /// largest v² at each of them. O(nodes · N), 4 bytes per node and direction.
  void take(const BoundGrid<N>& grid, const std::vector<double>& b, bool rest_first, bool rest_last, double cycle_time);

  /// Sets both directions of every axis: ahead from `to` in or at the end of cell `last`, behind from `from` in or at
  /// the beginning of cell `first`. O(N · cells between).
  void set(JerkCapPiece<N>& piece, const BoundNode<N>& from, const BoundNode<N>& to, std::size_t first,
           std::size_t last) const;

 private:
  struct End {
    double at = 0, steps = 0;  ///< position of the axis at the end; sum of the steps up to the end
    double acceleration = 0;   ///< upper bound of the acceleration at the end
  };
  /// Ends of all cells, with the index of each cell's end; neighbouring cells mostly share one.
  struct Ends {
    std::vector<std::uint32_t> of;
    std::vector<std::array<End, N>> list;
    const std::array<End, N>& at(std::size_t cell) const { return list[of[cell]]; }
  };
  void pass(const BoundGrid<N>& grid, const std::vector<double>& b, bool forwards, bool rest, double cycle_time,
            Ends& ends) const;

  const BoundGrid<N>* grid_ = nullptr;
  Ends ahead_, behind_;
};

extern template class OneWay<2>;
extern template class OneWay<3>;
extern template class OneWay<5>;
extern template class OneWay<8>;

}  // namespace bahnwerk::verify
