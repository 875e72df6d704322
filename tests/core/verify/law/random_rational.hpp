#pragma once
/// Random free-form pieces, among them long ones, flat ones, spiked weights and almost vanishing tangents.
#include <cmath>
#include <random>
#include <vector>

#include "core/geometry/curve/rational.hpp"

namespace bahnwerk::test {

inline Rational random_rational(std::mt19937_64& random, int round) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const int degree = 2 + static_cast<int>(random() % 5);
  std::vector<Vec> points{{0, 0, 0}};
  std::vector<double> weights{1};
  for (int k = 1; k <= degree; ++k) {
    points.push_back(points.back() +
                     Vec{12 + 8 * uniform(random), 20 * uniform(random), round % 5 == 0 ? 9 * uniform(random) : 0});
    weights.push_back(std::pow(10, (round % 7 == 3 ? 1.5 : 0.3) * uniform(random)));
  }
  if (round % 4 == 1) {  // (u − u0)² and (u − u0)³, but for a little: almost a cusp inside
    const double u0 = 0.5 + 0.3 * uniform(random), little = std::pow(10, -1 - 1.5 * (1 + uniform(random)));
    // x = 20 ((u − u0)² + …), y = 10 ((u − u0)³ + 3 little u)
    return Rational::from_power_basis({{0, -40 * u0, 20}, {0, 30 * (u0 * u0 + little), -30 * u0, 10}});
  }
  return Rational::bezier(points, round % 2 ? weights : std::vector<double>{});
}

}  // namespace bahnwerk::test
