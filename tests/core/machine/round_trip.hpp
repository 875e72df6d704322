#pragma once
/// What holds for every machine with closed formulas, at random poses that it reaches.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "core/machine/kinematics.hpp"
#include "tests/core/cases.hpp"

namespace bahnwerk::test {

inline int poses() { return testing::cases(100'000); }

inline ToolJet standing(const ToolPose& pose) {
  ToolJet tool;
  tool.position.value = pose.position, tool.phi.value = pose.phi, tool.psi.value = pose.psi;
  return tool;
}

/// Axes somewhere in their ranges (those without: within two turns), drawn again until `reach` takes them.
template <class Random, class Reach>
AxisArray random_axes(const Kinematics& machine, Random& random, Reach&& reach) {
  std::uniform_real_distribution<double> uniform(0, 1);
  for (;;) {
    AxisArray q{};
    for (std::size_t k = 0; k < machine.axes().size(); ++k) {
      const AxisLimits& axis = machine.axes()[k];
      const double low = std::max(axis.lowest, -12.0 - 1e6 * (axis.unit == "mm")),
                   high = std::min(axis.highest, 12.0 + 1e6 * (axis.unit == "mm"));
      q[k] = low + (high - low) * uniform(random);
    }
    if (reach(q)) return q;
  }
}

/// forward(inverse(pose)) is the pose, to 1e-12 mm and rad.
template <class Reach>
void poses_come_back(const Kinematics& machine, Reach&& reach) {
  std::mt19937_64 random(14);
  double position = 0, angle = 0;
  for (int i = 0, n = poses(); i < n; ++i) {
    const ToolPose pose = machine.forward(random_axes(machine, random, reach));
    const ToolPose again = machine.forward(machine.inverse(standing(pose)).value);
    position = std::max(position, norm(again.position - pose.position));
    angle = std::max(
        {angle, std::abs(std::remainder(again.phi - pose.phi, 2 * std::numbers::pi)), std::abs(again.psi - pose.psi)});
  }
  ::testing::Test::RecordProperty("worst_position_mm", std::to_string(position * 1e12) + "e-12");
  ::testing::Test::RecordProperty("worst_angle_rad", std::to_string(angle * 1e12) + "e-12");
  std::printf("worst of %d poses: %.3g mm, %.3g rad\n", poses(), position, angle);
  EXPECT_LE(position, 1e-12);
  EXPECT_LE(angle, 1e-12);
}

/// The tool along a cubic in all five coordinates.
struct Cubic {
  std::array<std::array<double, 4>, 5> c{};  // value and derivatives at 0
  ToolJet at(double t) const {
    ToolJet tool;
    const auto set = [&](std::size_t i, double& v, double& d1, double& d2, double& d3) {
      v = c[i][0] + t * (c[i][1] + t * (c[i][2] / 2 + t * c[i][3] / 6));
      d1 = c[i][1] + t * (c[i][2] + t * c[i][3] / 2), d2 = c[i][2] + t * c[i][3], d3 = c[i][3];
    };
    Jet& p = tool.position;
    for (std::size_t i = 0; i < 3; ++i) set(i, p.value[i], p.d1[i], p.d2[i], p.d3[i]);
    set(3, tool.phi.value, tool.phi.d1, tool.phi.d2, tool.phi.d3);
    set(4, tool.psi.value, tool.psi.d1, tool.psi.d2, tool.psi.d3);
    return tool;
  }
};

/// Each derivative against central differences of fourth order of the one before, to 1e-6 of its size.
template <class Reach>
void derivatives_are_differences(const Kinematics& machine, Reach&& reach) {
  std::mt19937_64 random(15);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const ToolPose pose = machine.forward(random_axes(machine, random, reach));
    Cubic tool;
    const auto start = pose.coordinates();
    for (std::size_t k = 0; k < 5; ++k) {
      const double unit = k < 3 ? 1 : 0.02;
      tool.c[k] = {start[k], unit * uniform(random), 0.05 * unit * uniform(random), 0.005 * unit * uniform(random)};
    }
    const double h = 0.02;
    const AxisJet here = machine.inverse(tool.at(0)), a2 = machine.inverse(tool.at(-2 * h)),
                  a1 = machine.inverse(tool.at(-h)), b1 = machine.inverse(tool.at(h)),
                  b2 = machine.inverse(tool.at(2 * h));
    for (std::size_t k = 0; k < machine.axes().size(); ++k) {
      const double period = machine.period(k);
      const auto step = [&](double later, double earlier) {
        return period > 0 ? std::remainder(later - earlier, period) : later - earlier;
      };
      const auto slope = [&](double m2, double m1, double p1, double p2) {
        return (8 * step(p1, m1) - step(p2, m2)) / (12 * h);
      };
      const double unit = machine.axes()[k].unit == "mm" ? 1 : 0.01;
      const auto close = [&](double exact, double difference, const char* which) {
        EXPECT_NEAR(exact, difference, 1e-6 * (std::abs(exact) + 0.01 * unit)) << which << " of axis " << k;
      };
      close(here.d1[k], slope(a2.value[k], a1.value[k], b1.value[k], b2.value[k]), "first");
      const auto plain = [&](double m2, double m1, double p1, double p2) {
        return (8 * (p1 - m1) - (p2 - m2)) / (12 * h);
      };
      close(here.d2[k], plain(a2.d1[k], a1.d1[k], b1.d1[k], b2.d1[k]), "second");
      close(here.d3[k], plain(a2.d2[k], a1.d2[k], b1.d2[k], b2.d2[k]), "third");
    }
    if (::testing::Test::HasFailure()) FAIL() << "pose " << i;
  }
}

/// Derivatives along random directions at random places of random balls are no larger than bounds() says, and not all
/// much smaller.
template <class Reach>
void bounds_hold(const Kinematics& machine, Reach&& reach) {
  std::mt19937_64 random(16);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  const double lever = machine.lever();
  std::array<double, 3> closest{};
  int finite = 0;
  for (int i = 0; i < 400; ++i) {
    const ToolPose centre = machine.forward(random_axes(machine, random, reach));
    const double radius = 10 * uniform(random);
    const MapBounds bounds = machine.bounds(centre, radius);
    if (std::isfinite(bounds.order[2][0] + bounds.order[2][1])) ++finite;
    for (int j = 0; j < 20; ++j) {
      std::array<double, 5> off{}, e{};
      double n0 = 0, n1 = 0;
      for (std::size_t k = 0; k < 5; ++k) {
        off[k] = normal(random), e[k] = normal(random);
        n0 += off[k] * off[k], n1 += e[k] * e[k];
      }
      for (std::size_t k = 0; k < 5; ++k) off[k] *= radius * uniform(random) / std::sqrt(n0), e[k] /= std::sqrt(n1);
      ToolJet tool = standing(centre);
      for (std::size_t k = 0; k < 3; ++k) tool.position.value[k] += off[k], tool.position.d1[k] = e[k];
      tool.phi.value += off[3] / lever, tool.phi.d1 = e[3] / lever;
      tool.psi.value += off[4] / lever, tool.psi.d1 = e[4] / lever;
      AxisJet q;
      try {
        q = machine.inverse(tool);
      } catch (const UnreachablePose&) {
        EXPECT_TRUE(std::isinf(bounds.order[0][0])) << "a ball with finite bounds is within reach";
        continue;
      }
      for (std::size_t k = 0; k < machine.axes().size(); ++k) {
        const std::array<double, 3> size{std::abs(q.d1[k]), std::abs(q.d2[k]), std::abs(q.d3[k])};
        for (std::size_t n = 0; n < 3; ++n) {
          EXPECT_LE(size[n], bounds.order[n][k] * (1 + 1e-12) + 1e-15) << n + 1 << " of axis " << k;
          if (bounds.order[n][k] > 0) closest[n] = std::max(closest[n], size[n] / bounds.order[n][k]);
        }
      }
    }
    if (::testing::Test::HasFailure()) FAIL() << "ball " << i;
  }
  EXPECT_GT(finite, 300);
  EXPECT_GT(closest[0], 0.5);
  EXPECT_GT(closest[1], 0.2);
  EXPECT_GT(closest[2], 0.1);
}

}  // namespace bahnwerk::test
