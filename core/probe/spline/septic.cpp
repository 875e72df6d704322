#include "core/probe/spline/septic.hpp"

#include "core/probe/landing.hpp"

namespace bahnwerk::probe {

Bezier septic(const SepticEnd& l, const SepticEnd& r, double h) {
  Bezier out;
  out.n = 8;
  out.b[0] = l.x;
  out.b[1] = l.x + (h / 7) * l.v;
  out.b[2] = l.x + (2 * h / 7) * l.v + (h * h / 42) * l.a;
  out.b[3] = l.x + (3 * h / 7) * l.v + (h * h / 14) * l.a + (h * h * h / 210) * l.j;
  out.b[4] = r.x - (3 * h / 7) * r.v + (h * h / 14) * r.a - (h * h * h / 210) * r.j;
  out.b[5] = r.x - (2 * h / 7) * r.v + (h * h / 42) * r.a;
  out.b[6] = r.x - (h / 7) * r.v;
  out.b[7] = r.x;
  return out;
}

std::array<Vec, 8> septic_coefficients(const SepticEnd& l, const SepticEnd& r, double h) {
  // Difference of the right end from the left one's Taylor polynomial.
  const std::array<Vec, 4> rest =
      landing<Vec>(r.x - l.x - h * (l.v + (h / 2) * (l.a + (h / 3) * l.j)), r.v - l.v - h * (l.a + (h / 2) * l.j),
                   r.a - l.a - h * l.j, r.j - l.j, h);
  return {l.x, l.v, l.a / 2, l.j / 6, rest[0], rest[1], rest[2], rest[3]};
}

}  // namespace bahnwerk::probe
