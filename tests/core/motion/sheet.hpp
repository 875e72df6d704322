#pragma once
/// A sheet with equal holes, as document coordinates have it: decimals, so that no two holes are equal to the last bit.
#include "core/contour/builder.hpp"

namespace bahnwerk::test {

/// What one hole of a sheet is: from its centre, leaving and ending at the same place.
enum class Hole { circle, slot, free_form };

inline Vec first_of(Hole hole, Vec at) { return hole == Hole::circle ? at + Vec{1.7, 0, 0} : at + Vec{0, -1.3, 0}; }

inline void cut(ContourBuilder& b, Hole hole, Vec at) {
  const Vec from = first_of(hole, at);
  if (hole == Hole::circle) b.arc(from, at, true);
  if (hole == Hole::free_form) b.polynomial({{from.x, 4, -9.5, 5.5}, {from.y, 6.5, 3.25, -9.75}});
  if (hole != Hole::slot) return;
  b.line(at + Vec{8.1, -1.3, 0});
  b.arc(at + Vec{8.1, 1.3, 0}, at + Vec{8.1, 0, 0}, true);
  b.line(at + Vec{0, 1.3, 0});
  b.arc(from, at, true);
}

/// Centres in rows of ten.
inline Vec centre(int i) { return {0.3 + 12.7 * (i % 10), 0.7 + 7.62 * (i / 10), 0}; }

/// Holes with moves between them, each a block; all at rest between.
inline Contour sheet(Hole hole, int first, int last, double feed = 300) {
  ContourBuilder b(2, first_of(hole, centre(first)));
  for (int i = first; i < last; ++i) {
    if (i > first) {
      b.dwell(0);
      b.block(Mode::position, unlimited);
      b.line(first_of(hole, centre(i)));
      b.dwell(0);
    }
    b.block(Mode::cut, feed);
    cut(b, hole, centre(i));
  }
  return b.finish();
}

}  // namespace bahnwerk::test
