#pragma once
/// The same random contour in other frames: moved, mirrored, turned by a right angle, and from its end to its begin.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/contour/builder.hpp"
#include "core/contour/contour.hpp"
#include "core/numeric/random.hpp"

namespace bahnwerk::test {

struct Frame {
  double xx = 1, xy = 0, x = 0;  ///< x' = xx x + xy y + x
  double yx = 0, yy = 1, y = 0;
  bool backwards = false;
  Vec operator()(const Vec& p) const { return {xx * p.x + xy * p.y + x, yx * p.x + yy * p.y + y, 0}; }
  bool mirrors() const { return xx * yy - xy * yx < 0; }
};
inline const Frame other_frames[] = {{1, 0, 341.7, 0, 1, -29.3}, {-1, 0, 0, 0, 1, 0}, {0, -1, 0, 1, 0, 0}};
inline const Frame backwards{1, 0, 0, 0, 1, 0, true};

/// Moves of up to `longest` mm, circles, arcs and straight cuts, 3 to 6 of each kind of block.
inline Contour framed(std::uint64_t seed, const Frame& frame, double longest = 60) {
  Random random(seed);
  struct Piece {
    Vec from, to, centre;
    bool arc, left, cut;
    double feed;
  };
  std::vector<Piece> pieces;
  Vec at{random.uniform(-20, 20), random.uniform(-20, 20), 0};
  const auto away = [&](double length) {
    const double angle = random.uniform(0, 2 * M_PI);
    return Vec{at.x + length * std::cos(angle), at.y + length * std::sin(angle), 0};
  };
  const auto add = [&](const Vec& to, const Vec& centre, bool arc, bool cut, double feed) {
    pieces.push_back({at, to, centre, arc, random.below(2) == 0, cut, feed});
    at = to;
  };
  for (int i = 0, n = 3 + static_cast<int>(random.below(4)); i < n; ++i) {
    add(away(longest * std::pow(10, random.uniform(-1, 0))), {}, false, false, 1e9);
    const double feed = random.uniform(50, 500), radius = std::pow(10, random.uniform(-0.5, 1.3));
    const Vec centre = away(radius), back{2 * centre.x - at.x, 2 * centre.y - at.y, 0};
    add(random.below(2) == 0 ? back : at, centre, true, true, feed);
    if (random.below(2) == 0) add(away(radius), {}, false, true, feed);
  }
  if (frame.backwards) {
    std::reverse(pieces.begin(), pieces.end());
    for (Piece& p : pieces) std::swap(p.from, p.to), p.left = !p.left;
  }
  ContourBuilder b(2, frame(pieces.front().from));
  for (const Piece& p : pieces) {
    b.block(p.cut ? Mode::cut : Mode::position, p.cut ? p.feed : unlimited);
    if (p.arc)
      b.arc(frame(p.to), frame(p.centre), p.left != frame.mirrors());
    else
      b.line(frame(p.to));
  }
  return b.finish();
}

}  // namespace bahnwerk::test
