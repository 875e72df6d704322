// What q' may be between two nodes holds what it is there, on machines with a map as on Cartesian ones.
#include "core/verify/bound/direction_range.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/progress.hpp"
#include "core/verify/bound/bound_grid.hpp"
#include "tests/core/motion/axes/five_axes.hpp"
#include "tests/core/verify/reference.hpp"

namespace bahnwerk::verify {
namespace {

using reference::Maker;

TEST(Between, HoldsRandomCubicsAndIsExactWhereTheyAreMonotone) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int exact = 0;
  for (int i = 0; i < 2000; ++i) {
    const double c[] = {uniform(random), uniform(random), uniform(random), uniform(random)}, l = 1 + uniform(random);
    const auto value = [&](double x) { return c[0] + x * (c[1] + x * (c[2] + x * c[3])); };
    const auto slope = [&](double x) { return c[1] + x * (2 * c[2] + x * 3 * c[3]); };
    const double q2 = std::max(std::abs(2 * c[2]), std::abs(2 * c[2] + 6 * c[3] * l));
    const Interval g = between(value(0), value(l), slope(0), slope(l), l, q2);
    for (int j = 0; j <= 50; ++j) {
      EXPECT_GE(value(l * j / 50), g.low - 1e-12);
      EXPECT_LE(value(l * j / 50), g.high + 1e-12);
    }
    exact += g.low == std::min(value(0), value(l)) && g.high == std::max(value(0), value(l));
  }
  EXPECT_GT(exact, 200);
}

template <int N>
void expect_enclosed(const AxisPath& path, const Machine& machine, const std::vector<double>& feeds) {
  Progress silent;
  ProgressScope progress(silent, "bound");
  BoundGrid<N> grid(path, machine, feeds, 2e-3, progress);
  grid.build(0, path.size());
  for (int round = 0; round < 2; ++round) {
    std::size_t undecided = 0;
    for (std::size_t i = 0; i < grid.cells().size(); ++i) {
      const BoundNode<N>&a = grid.nodes()[i], &b = grid.nodes()[i + 1];
      const BoundCell<N>& cell = grid.cells()[i];
      if (cell.kind == BoundCell<N>::Kind::joint) continue;
      const DirectionRange<N> range = grid.range(a, b);
      for (std::size_t k = 0; k < grid.axes(); ++k) {
        const double scale = grid.acceleration(k) / machine.axes[k].acceleration;
        undecided += range.wrong(k) > 1e-5;
        double way = 0, last = path.at_parameter(a.segment, a.u).value[k];
        for (int j = 1; j <= 12; ++j) {
          const AxisJet q = path.at_parameter(a.segment, a.u + (b.u - a.u) * j / 12);
          EXPECT_GE(scale * q.d1[k], range.low[k] - 1e-12) << i << " axis " << k;
          EXPECT_LE(scale * q.d1[k], range.high[k] + 1e-12) << i << " axis " << k;
          way += scale * std::abs(q.value[k] - last);
          last = q.value[k];
        }
        EXPECT_GE(cell.energy[k], 2 * grid.acceleration(k) * (way - 1e-12)) << i << " axis " << k;
        EXPECT_LE(cell.displacement[k], way + 1e-12) << i << " axis " << k;
      }
    }
    EXPECT_EQ(undecided, 0u);  // halved until it does not matter
    grid.refine(std::vector<unsigned char>(grid.cells().size(), 1));
  }
}

TEST(DirectionRange, EnclosesQPrimeOnAMachineWithFiveAxes) {
  const test::FiveAxes kinematics;
  const Machine machine{kinematics.axes(), 0.001};
  for (const Contour& contour : {Maker().line({40, 0}).arc({60, 20}, {40, 20}, true).line({60, 45}).done(),
                                 Maker().bezier({{30, 40}, {60, -40}, {80, 20}}, {1, 2, 0.5, 1}).done(),
                                 Maker(3).bezier({{20, 0, 10}, {40, 30, 30}, {60, 40, 10}}).done()}) {
    const KinematicAxisPath path(contour.path, kinematics);
    expect_enclosed<8>(path, machine, contour.feeds());
  }
}

TEST(DirectionRange, EnclosesQPrimeOnCartesianAxes) {
  for (unsigned i = 0; i < 20; ++i) {
    std::mt19937_64 random(90 + i);
    const Contour contour = reference::random_contour(random, 5, i % 2);
    expect_enclosed<2>(CartesianAxisPath(contour.path, 2), reference::machine(2, 500, 16000), contour.feeds());
  }
  const Contour space = Maker(3, {10, 0, 0})
                            .arc({0, 10, 3}, {0, 0, 0}, true)
                            .bezier({{-5, 15, 8}, {-10, 10, 12}, {10, 5, 0}}, {1, 0.5, 2, 1})
                            .done();
  expect_enclosed<3>(CartesianAxisPath(space.path, 3), reference::machine(3, 500, 16000), space.feeds());
}

}  // namespace
}  // namespace bahnwerk::verify
