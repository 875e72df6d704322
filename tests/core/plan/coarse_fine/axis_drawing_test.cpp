#include "core/plan/coarse_fine/axis_drawing.hpp"

#include <gmock/gmock.h>

#include "core/base/progress.hpp"
#include "core/plan/contour/contour_drawing.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"

namespace bahnwerk {
namespace {

using testing::HasSubstr;

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(AxisDrawing, HasSixPanelsPerAxisAndStaysSmall) {
  Progress progress;
  const CoarseFinePlan plan = plan_coarse_fine(test::holes(6, 6, 12, 2), test::md2(), {}, {}, progress);
  const std::string svg = axis_drawing(plan, test::md2(), progress);
  EXPECT_EQ(count(svg, "<rect"), 1u + 12);
  EXPECT_EQ(count(svg, "class=\"curve\""), 14u);
  EXPECT_EQ(count(svg, "class=\"limit\""), 20u);
  EXPECT_LT(svg.size(), 200'000u);
  const std::string contour =
      contour_drawing(*plan.contour.path, {.title = "holes", .way = coarse_way(plan)}, progress);
  EXPECT_THAT(contour, HasSubstr("class=\"coarse\""));
  EXPECT_THAT(contour, HasSubstr("coarse axes"));
  EXPECT_LT(contour.size(), 200'000u);
}

TEST(AxisDrawing, TheWayOfTheCoarseAxesStaysWithinTheStrokeOfThePath) {
  Progress progress;
  const CoarseFinePlan plan = plan_coarse_fine(test::holes(3, 1, 12, 2), test::md2(), {}, {}, progress);
  const std::vector<Vec> way = coarse_way(plan);
  ASSERT_EQ(way.size(), plan.coarse->pieces() + 1);
  for (const Vec& p : way) {
    EXPECT_GE(p.x, -20);
    EXPECT_LE(p.x, 27 + 20);
  }
}

}  // namespace
}  // namespace bahnwerk
