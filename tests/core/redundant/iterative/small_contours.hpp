#pragma once
/// A sheet like that of [Bock Fig. 4.10]: 45 small contours on 10 cm by 10 cm, cut at 400 mm/s.
#include <cmath>

#include "core/contour/builder.hpp"
#include "core/contour/contour.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk::test {

/// A closed outline of `corners` vertices around a centre, from vertex 0 on; every second vertex at `inner` radius.
/// With `rounding` > 0 straight edges are joined by arcs of that radius.
inline void outline(ContourBuilder& b, const Vec& centre, double radius, double inner, int corners, double turn,
                    double rounding) {
  const auto vertex = [&](int i) {
    const double angle = turn + 2 * M_PI * i / corners, r = i % 2 == 0 ? radius : inner;
    return Vec{centre.x + r * std::cos(angle), centre.y + r * std::sin(angle), 0};
  };
  if (!(rounding > 0)) {
    for (int i = 1; i <= corners; ++i) b.line(vertex(i));
    return;
  }
  // From the middle of the first edge around.
  for (int i = 1; i <= corners; ++i) {
    const Vec before = vertex(i - 1), here = vertex(i), after = vertex(i + 1);
    const Vec in = (1 / norm(here - before)) * (here - before), out = (1 / norm(after - here)) * (after - here);
    const double half = 0.5 * std::acos(dot(in, out)), way = rounding * std::tan(half);
    const bool left = cross(in, out).z > 0;
    const Vec from = here - way * in, to = here + way * out;
    const Vec normal{left ? -in.y : in.y, left ? in.x : -in.x, 0};
    b.line(from);
    b.arc(to, from + rounding * normal, left);
    if (i == corners) b.line(0.5 * (here + after));
  }
}

inline Contour small_contours(int columns = 7, int rows = 7, double pitch = 14) {
  ContourBuilder b(2, {0, 0, 0});
  int made = 0;
  for (int j = 0; j < rows; ++j)
    for (int k = 0; k < columns; ++k) {
      const int i = j % 2 == 0 ? k : columns - 1 - k;
      if ((j + 1) * columns - k <= 4 && j + 1 == rows && columns == 7) continue;  // 45 of 49
      const Vec centre{i * pitch + 7, j * pitch + 7, 0};
      const double turn = 0.37 * made;
      const auto go = [&](const Vec& to) {
        b.block(Mode::position, unlimited);
        b.line(to);
        b.block(Mode::cut, 400);
      };
      const auto on = [&](double radius, double angle) {
        return Vec{centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle), 0};
      };
      switch (made++ % 4) {
        case 0: {
          const Vec start = on(5.5, turn);
          go(start);
          b.arc(start, centre, true);
          break;
        }
        case 1:
          go(on(6, turn));
          outline(b, centre, 6, 6, 6, turn, 0);
          break;
        case 2: {
          const Vec middle = 0.5 * (on(6.5, turn) + on(6.5, turn + M_PI / 2));
          go(middle);
          outline(b, centre, 6.5, 6.5, 4, turn, 1.5);
          break;
        }
        default:
          go(on(6, turn));
          outline(b, centre, 6, 3.5, 10, turn, 0);
          break;
      }
    }
  return b.finish();
}

}  // namespace bahnwerk::test
