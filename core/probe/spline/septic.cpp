#include "core/probe/spline/septic.hpp"

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
  // What the right end has beyond the left one's Taylor polynomial, by powers of the duration.
  const Vec x = r.x - l.x - h * (l.v + (h / 2) * (l.a + (h / 3) * l.j));
  const Vec v = h * (r.v - l.v - h * (l.a + (h / 2) * l.j)), a = (h * h) * (r.a - l.a - h * l.j),
            j = (h * h * h) * (r.j - l.j);
  const double h4 = h * h * h * h;
  return {l.x,
          l.v,
          l.a / 2,
          l.j / 6,
          (35 * x - 15 * v + 2.5 * a - (1.0 / 6) * j) / h4,
          (-84 * x + 39 * v - 7 * a + 0.5 * j) / (h4 * h),
          (70 * x - 34 * v + 6.5 * a - 0.5 * j) / (h4 * h * h),
          (-20 * x + 10 * v - 2 * a + (1.0 / 6) * j) / (h4 * h * h * h)};
}

}  // namespace bahnwerk::probe
