// The free wire between the needle and where it lies.
#include "core/winding/path/payout.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/progress.hpp"
#include "core/numeric/random.hpp"
#include "core/winding/fill.hpp"
#include "core/winding/part/vec3.hpp"
#include "tests/core/winding/needle/quiet_support.hpp"

namespace bahnwerk::winding {
namespace {

PoseRates standing(const NeedlePose& pose) { return {pose.tip.x, pose.tip.y, pose.tip.z, pose.phi, pose.psi}; }

TEST(FreeWire, StraightOutOfTheNeedleItIsTheDistance) {
  const Anchor anchor{.begin = {30, 0, 0}};
  const FreeWire wire = free_wire(standing({{10, 0, 0}, 0, 0}), anchor, 5, 2);
  EXPECT_NEAR(wire.length.value(), 20, 1e-3);
  EXPECT_NEAR(wire.bend.value(), 0, 1e-3);
}

TEST(FreeWire, ARightAngleIsAQuarterOfTheCircle) {
  // Out of the needle along x, over a circle of 5 mm, straight along y.
  const FreeWire wire = free_wire(standing({{0, 0, 0}, 0, 0}), {.begin = {5, 5 + 12, 0}}, 5, 2);
  EXPECT_NEAR(wire.length.value(), 12 + 5 * std::numbers::pi / 2, 1e-6);
  EXPECT_NEAR(wire.bend.value(), std::numbers::pi / 2, 1e-6);
}

TEST(FreeWire, AnyBendLeadsToWhereTheWireLies) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const double bend = random.uniform(0.02, 2.8), run = random.uniform(0.1, 300), rho = random.uniform(0.1, 20);
    const NeedlePose pose{{random.uniform(-90, 90), random.uniform(-90, 90), random.uniform(-90, 90)},
                          random.uniform(-3, 3),
                          random.uniform(-1.5, 1.5)};
    const Vec3 d = pose.direction();
    const Vec3 some{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const Vec3 side = (1 / norm(cross(d, some))) * cross(d, some);
    const Vec3 place = pose.tip + (rho * std::sin(bend) + run * std::cos(bend)) * d +
                       (rho * (1 - std::cos(bend)) + run * std::sin(bend)) * side;
    const FreeWire wire = free_wire(standing(pose), {.begin = place}, rho, 2);
    EXPECT_NEAR(wire.length.value(), run + rho * bend, 1e-3);
    EXPECT_NEAR(wire.bend.value(), bend, 1e-3);
  }
}

TEST(FreeWire, RatesAreThoseOfTheLength) {
  const auto pose = [](Rate s) {  // along a curve, turning
    return PoseRates{80.0 + 3.0 * s - 0.2 * (s * s), 5.0 + 0.5 * s, 20.0 - 1.5 * (s * s), 0.3 + 0.05 * s,
                     0.2 - 0.03 * (s * s)};
  };
  for (const Anchor& anchor :
       {Anchor{.begin = {95, 30, 4}}, Anchor{.begin = {99, -30, 4}, .sweep = 0.7, .out = 1, .up = -2}})
    for (const double s : {0.3, 1.1, 2.0}) {
      const auto length = [&](double at) { return free_wire(pose(Rate(at)), anchor, 5, 2).length.value(); };
      const Rate found = free_wire(pose(Rate::from(s, 1.0)), anchor, 5, 2).length;
      const double h = 1e-3;
      EXPECT_NEAR(found.derivative(1), (length(s + h) - length(s - h)) / (2 * h), 1e-6);
      EXPECT_NEAR(found.derivative(2), (length(s + h) - 2 * length(s) + length(s - h)) / (h * h), 1e-4);
    }
}

/// Of both parts: two coils of three turns.
template <class Part>
void expect_continuous(const Part& part, const std::vector<Coil>& coils, double slack) {
  Progress progress;
  const Slot slot = checked_slot(part);
  std::vector<LayingRegions> regions;
  for (const Coil& coil : coils) regions.push_back(coil_regions(part, slot, coil));
  const Wire wire = *standard_wire(0.9, 2);
  const auto turns =
      turns_of(regions, needle(regions.front(), wire.radius(), slot.tension_point, progress), 3, wire.radius());
  NeedleModel model;
  std::vector<FixedPiece> support;
  if constexpr (std::is_same_v<Part, StatorPart>)
    support = support_points(part, coils, turns, model);
  else
    support = support_points(part, turns, model);
  std::vector<NeedlePiece> pieces;
  for (std::size_t i = 0; i < support.size(); ++i) {
    pieces.push_back({BezierPiece::line({}, {1}), i, false, 0});
    if (i + 1 < support.size()) pieces.push_back({BezierPiece::line({}, {1}), i, true, 0});
  }
  const std::vector<Anchor> list = anchors(pieces, support, turns);
  ASSERT_EQ(list.size(), pieces.size());
  std::size_t free = 0;
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
    free += list[i + 1].free;
    if (list[i + 1].free) continue;
    // Where the piece ends: the wire's length grows as fast, whatever way the needle goes on and turns.
    const FixedPiece& fixed = support[pieces[i + 1].fixed];
    const NeedlePose& pose = pieces[i].link ? fixed.begin.pose : fixed.end.pose;
    for (int k = 0; k < 5; ++k) {
      std::array<double, 5> way{};
      way[k] = k < 3 ? 1 : 0.02;  // mm, rad
      const PoseRates moving{Rate::from(pose.tip.x, way[0]), Rate::from(pose.tip.y, way[1]),
                             Rate::from(pose.tip.z, way[2]), Rate::from(pose.phi, way[3]),
                             Rate::from(pose.psi, way[4])};
      const FreeWire before = free_wire(moving, list[i], bend_radius(model.pull), model.pull.free_length),
                     after = free_wire(moving, list[i + 1], bend_radius(model.pull), model.pull.free_length);
      EXPECT_NEAR(before.length.derivative(1), after.length.derivative(1), slack) << i << ' ' << k;
    }
  }
  EXPECT_EQ(free, coils.size() - 1);
}

TEST(Anchors, TheWireIsDrawnWithoutStepsAlongAWholeWinding) {
  const RotorPart rotor;
  expect_continuous(rotor, repeated(coil_between(rotor, 0, 1), rotor.poles, 1, 2, true), 1e-6);
  const StatorPart stator;
  // Behind the winding tools the needle goes farther out and farther from the stack than its support points ask for.
  expect_continuous(stator, repeated(coil_between(stator, 0, 5), stator.slots, 10, 2, true), 0.15);
}

}  // namespace
}  // namespace bahnwerk::winding
