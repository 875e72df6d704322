// The vertical winder against its chain of frames, and there and back at random poses.
#include "core/machine/vertical_winder.hpp"

#include <gtest/gtest.h>

#include "frames.hpp"
#include "round_trip.hpp"
#include "winders.hpp"

namespace bahnwerk {
namespace {

using test::joint;

constexpr double pi = std::numbers::pi;

bool anywhere(const AxisArray&) { return true; }

/// [Herrmann table A.1].
TEST(VerticalWinder, ForwardIsTheProductOfItsFrames) {
  VerticalWinderSizes sizes;
  sizes.a_upper = 480, sizes.d_lower = 90;
  const VerticalWinder machine(sizes, test::vertical_limits());
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    const AxisArray q = test::random_axes(machine, random, anywhere);
    const test::Frame holder = joint(pi / 2, sizes.d_upper, sizes.a_upper, pi / 2) * joint(0, q[1], 0, pi / 2) *
                               joint(-pi / 2, q[0], sizes.o_tool, pi / 2) * joint(q[2], 0, sizes.l_tool, 0),
                      table = joint(0, sizes.d_lower, sizes.a_lower, -pi / 2) * joint(0, q[4], 0, pi / 2) *
                              joint(q[3], 0, 0, 0);
    const ToolPose pose = machine.forward(q);
    EXPECT_LE(test::largest_difference(inverse(table) * holder, test::euler(pose, -pi / 2)), 1e-12);
  }
}

TEST(VerticalWinder, PosesComeBack) { test::poses_come_back(*test::vertical(), anywhere); }

TEST(VerticalWinder, DerivativesAreDifferences) { test::derivatives_are_differences(*test::vertical(), anywhere); }

TEST(VerticalWinder, BoundsHold) { test::bounds_hold(*test::vertical(), anywhere); }

TEST(VerticalWinder, ANeedleThatGoesOutRadiallyMovesTheFeedAlone) {
  const auto machine = test::vertical();
  ToolJet tool = test::standing({{50 * std::cos(0.4), 50 * std::sin(0.4), 100}, 0.4, 0});
  tool.position.d1 = {std::cos(0.4), std::sin(0.4), 0};
  const AxisJet q = machine->inverse(tool);
  EXPECT_NEAR(q.d1[1], -1, 1e-15);
  for (const std::size_t k : {0u, 2u, 3u, 4u}) EXPECT_NEAR(q.d1[k], 0, 1e-15) << k;
  EXPECT_NEAR(q.value[4], 500, 1e-12);
}

}  // namespace
}  // namespace bahnwerk
