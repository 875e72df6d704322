#pragma once
/// Pieces of segments that turn so little that each has one nearest point to any point near it
/// (core/geometry/path/matched.hpp).
#include <vector>

#include "core/geometry/path/path.hpp"

namespace bahnwerk::verify {

/// The interval [u0, u1] of a segment, its ends and its length, mm.
struct CurvePiece {
  std::size_t segment = 0;
  double u0 = 0, u1 = 0;
  Vec p0, p1;
  double length = 0;
};

/// Divides a segment, the `index`-th of its path, until no piece turns by more than 0.5 rad (at most 2²⁴ pieces), and
/// appends them to `curve_pieces` in order.
void add_curve_pieces(const Segment& segment, std::size_t index, std::vector<CurvePiece>& curve_pieces);

}  // namespace bahnwerk::verify
