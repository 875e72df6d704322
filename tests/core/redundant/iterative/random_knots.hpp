#pragma once
/// Clamped knots at random places.
#include <algorithm>
#include <vector>

#include "core/numeric/random.hpp"

namespace bahnwerk::test {

inline std::vector<double> random_knots(Random& random, std::size_t degree, std::size_t inner, std::size_t multiplicity,
                                        double duration) {
  std::vector<double> places;
  for (std::size_t i = 0; i < inner; ++i)
    places.push_back(duration * (static_cast<double>(i) + random.uniform(0.2, 1.0)) / static_cast<double>(inner + 1));
  std::vector<double> k(degree + 1, 0.0);
  for (const double p : places) k.insert(k.end(), multiplicity, p);
  k.insert(k.end(), degree + 1, duration);
  return k;
}

}  // namespace bahnwerk::test
