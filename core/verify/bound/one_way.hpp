#pragma once
/// How far every axis goes on in its direction from a place of the bound's grid, and how far it has come in it.
///
/// An axis may turn round in a cell whose enclosure does not exclude it, at joints where its q′ jumps by more than
/// rounding, and beyond an open end of the grid, of which nothing is known. It does not at a rest, where it stands with
/// no acceleration: from there on it may go on as far as it likes. Where limits of jerk allow its acceleration to step
/// at joints these steps are added up; when they come to a part of its acceleration the way ends, too. At the node
/// where a way ends its acceleration is no more than |q″_k| b + |q′_k| |v̇|, which is little where it turns round.
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/verify/bound/bound_grid.hpp"
#include "core/verify/bound/jerk_cap.hpp"

namespace bahnwerk::verify {

template <int N>
class OneWay {
 public:
  /// Of the first nodes of the grid at hand, which outlives it; `b`: largest v² at each of them. O(nodes · N), 4
  /// bytes per node and direction.
  void take(const BoundGrid<N>& grid, const std::vector<double>& b, bool rest_first, bool rest_last, double cycle_time);

  /// Sets both directions of every axis: ahead from `to` in or at the end of cell `last`, behind from `from` in or at
  /// the begin of cell `first`. O(N · cells between).
  void set(JerkCapPiece<N>& piece, const BoundNode<N>& from, const BoundNode<N>& to, std::size_t first,
           std::size_t last) const;

 private:
  struct End {
    double at = 0, steps = 0;  ///< position of the axis there; steps on the way
    double acceleration = 0;   ///< at most, there
  };
  /// Per cell, which of the ends: neighbours mostly have the same.
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
