// A machine of its own in a few lines, and what every one of them has in common.
#include "core/machine/formula_kinematics.hpp"

#include <gtest/gtest.h>

#include "round_trip.hpp"

namespace bahnwerk {
namespace {

/// A needle on a slide that turns about the part: azimuth, radius, height, swivel.
class Carousel final : public FormulaKinematics<Carousel> {
 public:
  Carousel() : FormulaKinematics(numbered_axes<4>(std::vector<Limits>(4), {true, false, false, true})) {}
  template <class T>
  std::array<T, 4> solve(const NeedleOf<T>& n) const {
    return {atan2(n.y, n.x), sqrt(n.x * n.x + n.y * n.y), n.z, n.psi};
  }
  void check(const ToolPose& pose, const AxisArray&) const {
    if (!(std::hypot(pose.position.x, pose.position.y) > 1e-3))
      throw UnreachablePose("on the axis", std::numeric_limits<double>::quiet_NaN(), pose.coordinates());
  }
  ToolPose forward(const AxisArray& q) const override {
    return {{q[1] * std::cos(q[0]), q[1] * std::sin(q[0]), q[2]}, q[0], q[3]};
  }
};

TEST(FormulaKinematics, ANewMachineIsOneFormula) {
  const Carousel machine;
  EXPECT_EQ(machine.axes().size(), 4u);
  EXPECT_EQ(machine.axes()[3].name, "q4");
  EXPECT_EQ(machine.axes()[3].unit, "rad");
  ToolJet tool = test::standing({{30, 40, 5}, 0, 0.2});
  tool.position.d1 = {-0.8, 0.6, 0};  // across
  const AxisJet q = machine.inverse(tool);
  EXPECT_NEAR(q.d1[0], 1 / 50.0, 1e-15);
  EXPECT_NEAR(q.d1[1], 0, 1e-15);
  EXPECT_NEAR(q.d2[1], 1 / 50.0, 1e-15);
  EXPECT_LE(norm(machine.forward(q.value).position - tool.position.value), 1e-13);
  EXPECT_THROW(machine.inverse(test::standing({})), UnreachablePose);
}

TEST(FormulaKinematics, BoundsComeFromTheSameFormula) {
  const Carousel machine;
  const ToolPose centre{{30, 40, 5}, 0, 0.2};
  const MapBounds bounds = machine.bounds(centre, 10);
  EXPECT_GE(bounds.order[0][0], 1 / 40.0);
  EXPECT_LE(machine.bounds(centre, 2).order[0][0], 2 / 48.0);  // sums of coordinates are bounded term by term
  EXPECT_EQ(bounds.order[0][2], 1);
  EXPECT_EQ(bounds.order[1][2], 0);
  EXPECT_EQ(bounds.order[0][3], 1 / machine.lever());
  EXPECT_TRUE(std::isinf(machine.bounds(centre, 60).order[0][0]));  // the axis may be in it
  EXPECT_EQ(machine.bounds(centre, 60).order[0][2], 1);
}

TEST(FormulaKinematics, PlacesOfPartsAreUndone) {
  const PartPlace place{{12, -7, 3}, 0.4};
  const NeedleOf<double> n = place.placed(NeedleOf<double>{5, 6, 7, 0.1, 0.2});
  const ToolPose back = place.taken_back({{n.x, n.y, n.z}, n.phi, n.psi});
  EXPECT_LE(norm(back.position - Vec{5, 6, 7}), 1e-14);
  EXPECT_NEAR(back.phi, 0.1, 1e-16);
  EXPECT_EQ(back.psi, 0.2);
}

}  // namespace
}  // namespace bahnwerk
