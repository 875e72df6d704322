#pragma once
// Problems with known geometry for the relaxation, and its dual function by another way.
#include <cmath>
#include <numbers>

#include "core/motion/relaxation/relaxation.hpp"
#include "core/motion/relaxation/splines.hpp"

namespace bahnwerk::test {

// A line in direction (0.8, 0.6), finer and finer towards both ends.
inline RelaxationProblem<2> line(double length, std::size_t cells, double velocity, double acceleration, double jerk) {
  RelaxationProblem<2> p;
  const auto node = [&](std::size_t i) {
    const double x = static_cast<double>(i) / static_cast<double>(cells);
    return length * x * x * x * (10 - 15 * x + 6 * x * x);
  };
  for (std::size_t i = 0; i < cells; ++i) {
    const double h = node(i + 1) - node(i);
    p.cells.push_back({h, {0.8 * h, 0.6 * h}, {0.8, 0.6}, {0.8, 0.6}, velocity * velocity});
  }
  p.acceleration = {0.8 * acceleration, acceleration}, p.jerk = {0.8 * jerk, jerk};
  return p;
}

// A circle of radius r at even nodes.
inline RelaxationProblem<2> circle(double r, std::size_t cells, double velocity, double acceleration, double jerk) {
  RelaxationProblem<2> p;
  const double turn = 2 * std::numbers::pi / static_cast<double>(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    const double a = turn * static_cast<double>(i), b = a + turn;
    p.cells.push_back({r * turn,
                       {r * (std::sin(b) - std::sin(a)), r * (std::cos(a) - std::cos(b))},
                       {std::cos(a), std::sin(a)},
                       {std::cos(b), std::sin(b)},
                       velocity * velocity});
  }
  p.acceleration = {acceleration, acceleration}, p.jerk = {jerk, jerk};
  return p;
}

// Lagrange: for any multipliers the least over all b and T of Σ T_j + multipliers · violated limits; cells of one
// length.
inline double dual_of(const RelaxationProblem<2>& p, const RelaxationMultipliers<2>& m) {
  double dual = 0;
  for (std::size_t i = 0; i < p.cells.size(); ++i) {
    const auto& c = p.cells[i];
    const double h = c.length, cap = c.cap;
    const auto parts = spline_parts(h, h, h);
    double w = 0, G = 0;
    for (std::size_t r = 0; r < 3; ++r) {
      const auto& l = m.jerk[i + r];
      w += (1 - p.jerk[0] * std::abs(l[0]) - p.jerk[1] * std::abs(l[1])) * parts[r].integral(h);
      for (std::size_t k = 0; k < 2; ++k)
        G += l[k] * (parts[r].second * c.displacement[k] -
                     0.5 * (parts[r].slope_end * c.end[k] - parts[r].slope_begin * c.begin[k]));
    }
    for (std::size_t k = 0; k < 2; ++k) {
      const double m0 = m.acceleration[i][k], m1 = m.acceleration[i + 1][k];
      G += m0 * (c.displacement[k] / h - 0.5 * c.begin[k]) + m1 * (0.5 * c.end[k] - c.displacement[k] / h);
      dual -= p.acceleration[k] * h * (std::abs(m0) + std::abs(m1)) / 2;
    }
    const double b = G > 0 ? std::min(cap, std::pow(w / (2 * G), 2.0 / 3)) : cap;
    dual += w / std::sqrt(b) + G * b;
  }
  return dual;
}

}  // namespace bahnwerk::test
