#include "core/contour/blend/smooth_spans.hpp"

#include "core/contour/blend/smooth_basis.hpp"

namespace bahnwerk::blending {

SpanPolynomials::SpanPolynomials(const TubeSpline& spline) {
  const std::size_t count = spline.points.size() - spline_degree;
  const auto end_of = [&](std::size_t k) { return spline.knots[spline_degree + k]; };
  // Control points are relative to one nearby, so that large coordinates cost no digits.
  const auto jet = [&](std::size_t span, double t, Vec base) {
    const BasisRow row = second_derivative_basis_at(spline.knots, span, t);
    Jet f;
    for (std::size_t i = 0; i < spline_order; ++i) {
      const Vec c = spline.points[span + i] - base;
      f.value += row[0][i] * c;
      f.d1 += row[1][i] * c;
      f.d2 += row[2][i] * c;
    }
    return f;
  };
  const auto base_of = [&](std::size_t span) { return spline.points[span + spline_degree / 2]; };
  spans_.resize(count);
  Jet left = jet(0, end_of(0), base_of(0));
  for (std::size_t k = 0; k < count; ++k) {
    const bool last = k + 1 == count;
    const Vec base = base_of(k), next = base_of(last ? k : k + 1);
    const Jet right = jet(last ? k : k + 1, end_of(k + 1), next);
    const double h = end_of(k + 1) - end_of(k), square = h * h;
    const Vec step = (right.value - left.value) + (next - base), v0 = h * left.d1, v1 = h * right.d1,
              a0 = (0.5 * square) * left.d2, a1 = (0.5 * square) * right.d2;
    spans_[k] = {end_of(k),
                 1 / h,
                 {base + left.value, v0, a0, 10 * step - 6 * v0 - 4 * v1 - 3 * a0 + a1,
                  -15 * step + 8 * v0 + 7 * v1 + 3 * a0 - 2 * a1, 6 * step - 3 * (v0 + v1) - a0 + a1}};
    left = right;
  }
}

}  // namespace bahnwerk::blending
