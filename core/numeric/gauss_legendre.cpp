#include "core/numeric/gauss_legendre.hpp"

#include <boost/math/special_functions/legendre.hpp>
#include <vector>

namespace bahnwerk {

void gauss_legendre(std::span<GaussPoint> rule) {
  const std::size_t n = rule.size();
  const int degree = static_cast<int>(n);
  const std::vector<long double> roots = boost::math::legendre_p_zeros<long double>(degree);  // ascending from 0 on
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const long double x = roots[i], slope = boost::math::legendre_p_prime(degree, x);
    const auto place = static_cast<double>(x), weight = static_cast<double>(2 / ((1 - x * x) * slope * slope));
    rule[n - roots.size() + i] = {place, weight};
    rule[roots.size() - 1 - i] = {-place, weight};
  }
  if (n % 2 == 1) rule[n / 2].place = 0;
}

}  // namespace bahnwerk
