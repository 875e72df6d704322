// Axes through kinematics against differences of their own positions, and Cartesian ones against the path itself.
#include "core/motion/axes/axis_path.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

#include "core/base/errors.hpp"
#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"
#include "five_axes.hpp"

namespace bahnwerk {
namespace {

Path bow() {
  Path path;
  path.append(std::make_shared<Line>(Vec{0, 0, 0}, Vec{30, 0, 0}), 0);
  path.append(std::make_shared<Arc>(Vec{30, 20, 0}, Vec{0, -1, 0}, Vec{1, 0, 0}, 20, 2.0), 1);
  return path;
}

TEST(AxisPath, DerivativesThroughKinematicsAreThoseOfThePositions) {
  const Path tool = bow();
  const test::FiveAxes machine;
  const KinematicAxisPath path(tool, machine);
  ASSERT_EQ(path.axes(), 5u);
  for (std::size_t i = 0; i < path.size(); ++i)
    for (const double part : {0.2, 0.5, 0.9}) {
      const double s = path[i].s0() + part * path[i].length(), h = 0.05;
      const AxisJet q = path.at(i, s);
      for (std::size_t k = 0; k < 5; ++k) {
        const auto at = [&](double ds) { return path.at(i, s + ds).value[k]; };
        const auto scale = std::abs(q.d1[k]) + 1e-3;
        EXPECT_NEAR(q.d1[k], (8 * (at(h) - at(-h)) - at(2 * h) + at(-2 * h)) / (12 * h), 1e-7 * scale) << k;
        EXPECT_NEAR(q.d2[k], (at(h) - 2 * at(0) + at(-h)) / (h * h), 2e-5 * scale) << k;
        const auto slope = [&](double ds) { return path.at(i, s + ds).d2[k]; };
        EXPECT_NEAR(q.d3[k], (8 * (slope(h) - slope(-h)) - slope(2 * h) + slope(-2 * h)) / (12 * h), 1e-6 * scale) << k;
      }
    }
}

TEST(AxisPath, ForwardFindsTheToolAgain) {
  const Path tool = bow();
  const test::FiveAxes machine;
  const KinematicAxisPath path(tool, machine);
  for (const double s : {0.0, 12.0, 30.0, 44.0, 70.0}) {
    const std::size_t i = tool.find(s);
    EXPECT_LT(norm(machine.forward(path.at(i, s).value).position - tool.at(s).value), 1e-10) << s;
  }
}

TEST(AxisPath, WritesTheAxesThatThereAreAndNothingBehind) {
  const Path tool = bow();
  const test::FiveAxes machine;
  const KinematicAxisPath five(tool, machine);
  const CartesianAxisPath one(tool, 1), two(tool, 2), three(tool, 3, -4.5);
  const std::initializer_list<const AxisPath*> paths{&five, &one, &two, &three};
  for (const AxisPath* path : paths)
    for (const double s : {0.0, 12.0, 29.9, 30.0, 44.0, 70.0}) {
      const std::size_t i = tool.find(s), n = path->axes();
      std::vector<double> out(4 * n + 1, 12345.0);
      path->write_at(i, s, out.data());
      const AxisJet q = path->at(i, s);
      for (std::size_t k = 0; k < n; ++k) {
        EXPECT_EQ(out[k], q.value[k]);
        EXPECT_EQ(out[n + k], q.d1[k]);
        EXPECT_EQ(out[2 * n + k], q.d2[k]);
        EXPECT_EQ(out[3 * n + k], q.d3[k]);
      }
      EXPECT_EQ(out[4 * n], 12345.0);
    }
}

TEST(AxisPath, BatchesAreWhatSinglePlacesAre) {
  const Path tool = bow();
  const test::FiveAxes machine;
  const KinematicAxisPath five(tool, machine);
  const CartesianAxisPath two(tool, 2);
  for (const AxisPath* path : {static_cast<const AxisPath*>(&five), static_cast<const AxisPath*>(&two)}) {
    PathBatch batch;
    batch.count = 5;
    for (std::size_t i = 0; i < batch.count; ++i)
      batch.u.set(i, tool[1].curve().begin() +
                         (0.1 + 0.2 * static_cast<double>(i)) * (tool[1].curve().end() - tool[1].curve().begin()));
    path->at_parameters(1, batch);
    for (std::size_t i = 0; i < batch.count; ++i) {
      const AxisJet q = path->at_parameter(1, batch.u[i]);
      EXPECT_NEAR(batch.s[i], tool[1].travelled(batch.u[i]), 1e-12);
      for (std::size_t k = 0; k < path->axes(); ++k) {
        EXPECT_NEAR(batch.d1[k][i], q.d1[k], 1e-14 * (1 + std::abs(q.d1[k])));
        EXPECT_NEAR(batch.d2[k][i], q.d2[k], 1e-13 * (1 + std::abs(q.d2[k])));
        EXPECT_NEAR(batch.d3[k][i], q.d3[k], 1e-12 * (1 + std::abs(q.d3[k])));
      }
    }
  }
}

TEST(AxisPath, CartesianIsThePathItself) {
  const Path tool = bow();
  const CartesianAxisPath path(tool, 2);
  EXPECT_TRUE(path.cartesian());
  EXPECT_TRUE(path.linear(0));
  EXPECT_FALSE(path.linear(1));
  const AxisJet q = path.at(1, 40);
  const PathPoint h = tool.at(40);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(q.value[k], h.value[k]);
    EXPECT_EQ(q.d3[k], h.d3[k]);
  }
  EXPECT_EQ(q.value[2], 0);
}

}  // namespace
}  // namespace bahnwerk
