#include "core/geometry/spline/reparametrise.hpp"

namespace bahnwerk {
namespace {

Series coordinate(const SplineJet& jet, std::size_t d) {
  return Series::from(jet[0][d], jet[1][d], jet[2][d], jet[3][d], jet[4][d]);
}

}  // namespace

Series composed(const Series& outer, const Series& inner) {
  Series r;
  for (std::size_t n = spline_orders; n-- > 0;) {
    r = r * inner;
    r.c[0] += outer.c[n];
  }
  return r;
}

Series reverted(const Series& f) {
  Series g;
  g.c[1] = 1 / f.c[1];
  // If g is right to order n − 1, f(g(x)) − x begins with a term of order n.
  for (std::size_t n = 2; n < spline_orders; ++n) g.c[n] = -composed(f, g).c[n] / f.c[1];
  return g;
}

Series inverse_change(const Betas& betas) { return reverted(Series::from(0, betas[0], betas[1], betas[2], betas[3])); }

SplineJet reparametrised(const SplineJet& jet, const Series& change) {
  // Powers of the change, which all coordinates share; the n-th begins with x^n.
  std::array<Series, spline_orders> power;
  power[0] = 1;
  for (std::size_t n = 1; n < spline_orders; ++n) power[n] = power[n - 1] * change;
  SplineJet r{};
  r[0] = jet[0];
  for (std::size_t d = 0; d < spline_dimension; ++d) {
    const Series outer = coordinate(jet, d);
    Series s;
    for (std::size_t n = 1; n < spline_orders; ++n)
      for (std::size_t m = n; m < spline_orders; ++m) s.c[m] += outer.c[n] * power[n].c[m];
    for (std::size_t n = 1; n < spline_orders; ++n) r[n][d] = s.derivative(n);
  }
  return r;
}

SplineJet beta_derivative(const SplineJet& link, const Series& change, std::size_t j) {
  Series power = -1;
  for (std::size_t i = 1; i <= j; ++i) power = power * change / static_cast<double>(i);
  SplineJet r{};
  for (std::size_t d = 0; d < spline_dimension; ++d) {
    const Series s = power * Series::from(link[1][d], link[2][d], link[3][d], link[4][d]);
    for (std::size_t n = 0; n < spline_orders; ++n) r[n][d] = s.derivative(n);
  }
  return r;
}

SplineJet by_length(const SplineJet& jet) {
  Series square;  // |dh/dv|²
  for (std::size_t d = 0; d < 3; ++d) {
    const Series slope = Series::from(jet[1][d], jet[2][d], jet[3][d], jet[4][d]);
    square = square + slope * slope;
  }
  const Series speed = sqrt(square);
  Series length;
  for (std::size_t n = 1; n < spline_orders; ++n) length.c[n] = speed.c[n - 1] / static_cast<double>(n);
  return reparametrised(jet, reverted(length));
}

}  // namespace bahnwerk
