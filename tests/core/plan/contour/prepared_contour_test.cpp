#include "core/plan/contour/prepared_contour.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"
#include "core/contour/builder.hpp"

namespace bahnwerk {
namespace {

std::shared_ptr<const Contour> corner() {
  ContourBuilder b(2, {});
  b.block(Mode::cut, 30);
  b.line({20, 0, 0});
  b.line({20, 20, 0});
  b.dwell(0.25);
  return std::make_shared<const Contour>(b.finish());
}
const Machine machine{
    {AxisLimits("x", 500, 5000, 1e5), AxisLimits("y", 500, 5000, 1e5), AxisLimits("z", 500, 5000, 1e5)}, 0.001};

TEST(PreparedContour, CornersStayWhereNoRoundingIsAskedFor) {
  Progress silent;
  ContourPlanning planning;
  planning.method = PlanningMethod::time_optimal;
  const auto given = corner();
  const PreparedContour p = prepare_contour(given, machine, planning, silent);
  EXPECT_EQ(p.given, given);
  EXPECT_EQ(p.rounded, nullptr);
  EXPECT_EQ(p.moving.axes.size(), 2u) << "the third axis stands still";
  EXPECT_EQ(p.held.axes[0].jerk, unlimited) << "the method limits none";
  const PathPlanning path = path_planning(p, given, planning);
  EXPECT_EQ(path.path->axes(), 3u);
  EXPECT_EQ(path.moving->axes(), 2u);
  EXPECT_EQ(path.feeds, (std::vector<double>{30, 30}));
  EXPECT_EQ(path.feeds_to_verify, path.feeds);
  EXPECT_EQ(path.rests, (std::vector<bool>{false, false, true}));
  ASSERT_EQ(path.dwells.size(), 1u);
  EXPECT_EQ(path.method.method, PlanningMethod::time_optimal);
}

TEST(PreparedContour, RoundedCornersKeepTheFeedsOfTheirBlocks) {
  Progress silent;
  ContourPlanning planning;
  planning.method = PlanningMethod::jerk_limited;
  planning.corner_mode = CornerMode::blend;
  planning.blend_tolerance = 0.05;
  const PreparedContour p = prepare_contour(corner(), machine, planning, silent);
  ASSERT_NE(p.rounded, nullptr);
  EXPECT_GT(p.rounded->path.size(), 2u);
  EXPECT_LT(p.rounded->path.length(), p.given->path.length());
  ASSERT_EQ(p.sections.size(), 1u);
  EXPECT_TRUE(p.sections[0].changed);
  for (const double feed : path_planning(p, p.rounded, planning).feeds_to_verify) EXPECT_EQ(feed, 30);
}

}  // namespace
}  // namespace bahnwerk
