#include "core/machine/tool.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace bahnwerk {
namespace {

TEST(Tool, ANeedlesDirectionIsTheFirstColumnOfItsRotation) {
  for (const double phi : {-2.0, 0.3, 1.7})
    for (const double psi : {-1.2, 0.0, 0.8}) {
      // R_z(φ) R_x(−π/2) R_z(ψ) e_x, one rotation after the other.
      const Vec a{std::cos(psi), std::sin(psi), 0}, b{a.x, a.z, -a.y},
          c{std::cos(phi) * b.x - std::sin(phi) * b.y, std::sin(phi) * b.x + std::cos(phi) * b.y, b.z};
      const Vec direction = ToolPose{{}, phi, psi}.direction();
      EXPECT_NEAR(norm(direction - c), 0, 1e-15);
      EXPECT_NEAR(norm(direction), 1, 1e-15);
      // The other two angles of the same pose.
      const Vec other = ToolPose{{}, phi + std::numbers::pi, std::numbers::pi - psi}.direction();
      EXPECT_NEAR(norm(direction - other), 0, 1e-15);
    }
}

TEST(Tool, PositiveAnglesPointDown) { EXPECT_LT((ToolPose{{}, 1, 0.1}.direction().z), 0); }

TEST(Tool, ThePoseOfAMovingToolIsItsValues) {
  ToolJet tool;
  tool.position.value = {1, 2, 3};
  tool.phi = {0.4, 9, 9, 9};
  tool.psi = {0.5, 9, 9, 9};
  EXPECT_EQ(tool.pose().coordinates(), (std::array<double, 5>{1, 2, 3, 0.4, 0.5}));
}

}  // namespace
}  // namespace bahnwerk
