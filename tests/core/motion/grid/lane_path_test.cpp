#include "core/motion/grid/lane_path.hpp"

#include <gtest/gtest.h>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/line.hpp"

namespace bahnwerk {
namespace {

Path quarter_circle() {
  Path path;
  path.append(std::make_shared<Arc>(Arc::through({5, 0, 0}, {0, 5, 0}, {0, 0, 0}, {0, 0, 1}, true)), 0);
  path.append(std::make_shared<Line>(Vec{0, 5, 0}, Vec{-4, 5, 0}), 1);
  return path;
}

TEST(LanePath, LanesOfCartesianAxesAreThePathsCoordinates) {
  const Path tool = quarter_circle();
  const CartesianAxisPath axes(tool, 2);
  const LanePath<2> path(axes);
  const double u = tool[0].curve().begin() + 0.3 * (tool[0].curve().end() - tool[0].curve().begin());
  const Station<2> at = path.at(0, u);
  const PathPoint p = tool[0].at_parameter(u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(at.d1[k], p.d1[k]);
    EXPECT_EQ(at.d2[k], p.d2[k]);
    EXPECT_EQ(at.d3[k], p.d3[k]);
  }
  EXPECT_EQ(at.s, tool[0].travelled(u));
  EXPECT_NEAR(std::sqrt(sum(at.d2 * at.d2)), 0.2, 1e-12);  // 1/radius
}

TEST(LanePath, LanesWithoutAnAxisRepeatTheFirst) {
  const Path tool = quarter_circle();
  const CartesianAxisPath axes(tool, 2);
  const LanePath<3> path(axes);
  const Station<3> at = path.derivatives(0, tool[0].curve().begin());
  EXPECT_EQ(at.d1[2], at.d1[0]);
  EXPECT_EQ(at.d2[2], at.d2[0]);
  Machine machine;
  machine.axes = {{"x", 100, 1000, 20000}, {"y", 200, 3000, 40000}};
  const Machine lanes = path.limits(machine);
  ASSERT_EQ(lanes.axes.size(), 3u);
  EXPECT_EQ(lanes.axes[2].velocity, 100);
  EXPECT_EQ(lanes.axes[2].jerk, 20000);
  EXPECT_EQ(lanes.axes[1].acceleration, 3000);
}

TEST(LanePath, TheLeastNumberOfLanesHoldsAllAxes) {
  const std::size_t expected[] = {2, 2, 3, 5, 5, 8, 8, 8};
  for (std::size_t axes = 1; axes <= max_axes; ++axes)
    EXPECT_EQ(with_lanes(axes, [](auto n) { return static_cast<std::size_t>(n); }), expected[axes - 1]);
}

}  // namespace
}  // namespace bahnwerk
