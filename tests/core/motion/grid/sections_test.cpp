#include "core/motion/grid/sections.hpp"

#include <gtest/gtest.h>

#include "core/contour/builder.hpp"
#include "tests/core/silent_scope.hpp"

namespace bahnwerk {
namespace {

constexpr double degree = M_PI / 180;

Machine machine() {
  Machine m;
  m.axes = {{"x", 1800, 16000, unlimited}, {"y", 1800, 8000, unlimited}};
  m.cycle_time = 0.001;
  return m;
}

Contour bent(double angle) {
  ContourBuilder b(2, {});
  b.line({10, 0, 0});
  b.line({10 + 10 * std::cos(angle), 10 * std::sin(angle), 0});
  return b.finish();
}

Sections sections_of(const Contour& contour) {
  const Machine two = machine();
  const CartesianAxisPath path(contour.path, 2);
  return find_sections(contour_task(path, contour, two), 0.1 * degree, silent_scope());
}

TEST(Sections, ALargeJumpEndsASection) {
  const Sections sections = sections_of(bent(0.2 * degree));
  EXPECT_EQ(sections.begin, (std::vector<std::size_t>{0, 1, 2}));
}

TEST(Sections, ASmallJumpCapsTheSpeed) {
  const double angle = 0.05 * degree;
  const Sections sections = sections_of(bent(angle));
  EXPECT_EQ(sections.begin, (std::vector<std::size_t>{0, 2}));
  // |Δy'| v ≤ A_y T: sin(angle) v = 8 mm/s
  EXPECT_NEAR(std::sqrt(sections.joint_cap[1]), 8 / std::sin(angle), 1e-6);
}

TEST(Sections, ASmoothJointDoesNot) {
  const Sections sections = sections_of(bent(0));
  EXPECT_EQ(sections.begin.size(), 2u);
  EXPECT_EQ(sections.joint_cap[1], unlimited);
}

TEST(Sections, ACuspEndsASection) {
  ContourBuilder b(2, {0.125, -0.125, 0});
  // (w², w³) with w = u − 1/2 …: the curve turns back at u = 1/2
  b.polynomial({{0.125, -0.5, 0.5}, {-0.125, 0.75, -1.5, 1}});
  const Contour contour = b.finish();
  ASSERT_EQ(contour.path.size(), 2u);
  EXPECT_EQ(sections_of(contour).begin.size(), 3u);
}

}  // namespace
}  // namespace bahnwerk
