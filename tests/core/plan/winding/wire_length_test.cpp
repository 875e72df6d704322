#include "core/plan/winding/wire_length.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace bahnwerk::winding {
namespace {

TEST(WireLength, StraightAboutARotorsTooth) {
  Turn turn;
  turn.at[0] = {{0, 5, 100}, {0, 5, 0}, {}};
  turn.at[1] = {{0, 5, -3}, {0, -5, -3}, {}};
  turn.at[2] = {{0, -5, 0}, {0, -5, 100}, {}};
  turn.at[3] = {{0, -5, 103}, {0, 5, 103}, {}};
  EXPECT_DOUBLE_EQ(wire_length(RotorPart{}, {{0, 1}}, {turn}), 100 + 3 + 10 + 3 + 100 + 3 + 10);
  Turn next = turn;
  next.number = 1;
  EXPECT_DOUBLE_EQ(wire_length(RotorPart{}, {{0, 1}}, {turn, next}), 2 * 229 + 3);
  next.coil = 1;  // what the wire takes between coils does not count
  EXPECT_DOUBLE_EQ(wire_length(RotorPart{}, {{0, 1}, {1, 1}}, {turn, next}), 2 * 229);
}

TEST(WireLength, AboutTheAxisBehindAStatorsTools) {
  const double r = 100, a = 0.6;
  const auto at = [&](double angle, double z) { return Vec3{r * std::cos(angle), r * std::sin(angle), z}; };
  Turn turn;
  turn.at[0] = {at(0, 200), at(0, 0), {}};
  turn.at[1] = {at(0, 0), at(a, 0), {}};
  turn.at[2] = {at(a, 0), at(a, 200), {}};
  turn.at[3] = {at(a, 200), at(0, 200), {}};
  EXPECT_NEAR(wire_length(StatorPart{}, {{0, 5}}, {turn}), 400 + 2 * r * a, 1e-9);
  // Wound the other way round, the heads' wires go the long way about the axis.
  EXPECT_NEAR(wire_length(StatorPart{}, {{0, -5}}, {turn}), 400 + 2 * r * (2 * std::numbers::pi - a), 1e-9);
}

}  // namespace
}  // namespace bahnwerk::winding
