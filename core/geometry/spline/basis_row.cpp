#include "core/geometry/spline/basis_row.hpp"

namespace bahnwerk {

std::vector<double> basis_row(const std::vector<double>& knots, std::size_t degree, std::size_t order, double u) {
  const std::size_t spans = knots.size() - 1;
  std::vector<double> n(spans, 0.0);
  std::size_t k = spans;  // the span of u: to the right of a knot, the last one at the end
  while (k-- > 0)
    if (knots[k] < knots[k + 1] && (knots[k] <= u)) break;
  n[k] = 1;
  for (std::size_t q = 1; q <= degree; ++q)
    for (std::size_t i = 0; i + q < spans; ++i) {
      const double left = knots[i + q] - knots[i], right = knots[i + q + 1] - knots[i + 1];
      const bool difference = q + order > degree;
      double value = 0;
      if (left > 0) value += (difference ? static_cast<double>(q) : u - knots[i]) / left * n[i];
      if (right > 0) value += (difference ? -static_cast<double>(q) : knots[i + q + 1] - u) / right * n[i + 1];
      n[i] = value;
    }
  n.resize(spans - degree);
  return n;
}

}  // namespace bahnwerk
