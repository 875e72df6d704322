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
  planning.method = PlanningMethod::jerk_limited;
  const auto given = corner();
  const PreparedContour p = prepare_contour(given, machine, planning, silent.part(0, 0));
  EXPECT_EQ(p.driven, given);
  EXPECT_EQ(p.path.path->axes(), 3u);
  EXPECT_EQ(p.path.moving->axes(), 2u) << "the third axis stands still";
  EXPECT_EQ(p.path.feeds, (std::vector<double>{30, 30}));
  EXPECT_EQ(p.path.feeds_to_verify, p.path.feeds);
  EXPECT_EQ(p.path.rests, (std::vector<bool>{false, false, true}));
  ASSERT_EQ(p.path.dwells.size(), 1u);
  EXPECT_EQ(p.path.method, PlanningMethod::jerk_limited);
  EXPECT_EQ(p.path.planned, nullptr);
}

TEST(PreparedContour, RoundedCornersComeWithTheirLaw) {
  Progress silent;
  ContourPlanning planning;
  planning.method = PlanningMethod::jerk_limited;
  planning.corner_mode = CornerMode::blend;
  planning.blend_tolerance = 0.05;
  const auto given = corner();
  const PreparedContour p = prepare_contour(given, machine, planning, silent.part(0, 0.1));
  EXPECT_GT(p.driven->path.size(), 2u);
  EXPECT_LT(p.driven->path.length(), given->path.length());
  ASSERT_NE(p.path.planned, nullptr);
  EXPECT_NEAR(p.path.planned->law.pieces().back().s_end, p.driven->path.length(), 1e-9);
  for (const double feed : p.path.feeds_to_verify) EXPECT_EQ(feed, 30);
}

}  // namespace
}  // namespace bahnwerk
