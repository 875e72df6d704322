// The horizontal winder against the source's matrix, and there and back at random poses.
#include "core/machine/horizontal_winder.hpp"

#include <gtest/gtest.h>

#include "frames.hpp"
#include "round_trip.hpp"
#include "winders.hpp"

namespace bahnwerk {
namespace {

constexpr double pi = std::numbers::pi;

bool anywhere(const AxisArray&) { return true; }

/// [Herrmann appendix A], the last matrix: of a machine that has no swivel.
TEST(HorizontalWinder, ForwardIsTheSourcesMatrix) {
  HorizontalWinderSizes sizes;
  sizes.z_part = 17;
  const HorizontalWinder machine(sizes, test::horizontal_limits());
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    AxisArray q = test::random_axes(machine, random, anywhere);
    q[4] = 0;
    const long double c = std::cos(static_cast<long double>(q[3])), s = std::sin(static_cast<long double>(q[3]));
    const test::Frame printed{
        {{{-c, 0, s, q[0] * s + q[1] * c}, {s, 0, c, q[0] * c - q[1] * s}, {0, 1, 0, q[2] + 17}, {0, 0, 0, 1}}}};
    test::Frame mine = test::euler(machine.forward(q), -pi / 2);
    for (std::size_t row = 0; row < 3; ++row)  // its y and z axes are the opposite ones; the needle is the x axis
      for (const std::size_t column : {1u, 2u}) mine[row][column] = -mine[row][column];
    EXPECT_LE(test::largest_difference(printed, mine), 1e-12);
  }
}

/// The swivel's axis lies l behind the tip and goes where the axes q1 … q3 take it: the needle turns about it.
TEST(HorizontalWinder, TheNeedleSwivelsAboutItsAxis) {
  const auto machine = test::horizontal();
  AxisArray q{12, -60, 80, 0.9, 0};
  const double l = HorizontalWinderSizes{}.l_tool;
  const auto axis = [&](double swivel) {
    q[4] = swivel;
    const ToolPose pose = machine->forward(q);
    return pose.position - l * pose.direction();
  };
  for (const double swivel : {-1.5, -0.3, 0.7, 1.5}) EXPECT_LE(norm(axis(swivel) - axis(0)), 1e-13);
}

TEST(HorizontalWinder, PosesComeBack) { test::poses_come_back(*test::horizontal(), anywhere); }

TEST(HorizontalWinder, DerivativesAreDifferences) { test::derivatives_are_differences(*test::horizontal(), anywhere); }

TEST(HorizontalWinder, BoundsHold) { test::bounds_hold(*test::horizontal(), anywhere); }

}  // namespace
}  // namespace bahnwerk
