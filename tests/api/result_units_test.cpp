#include "api/result_units.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::api {
namespace {

TEST(ResultUnits, DescriptionsEndTheirFirstStatementWithAUnit) {
  EXPECT_EQ(described_unit("Planned duration, t_e, s."), "s");
  EXPECT_EQ(described_unit("Space left, mm; negative: none, in truth."), "mm");
  EXPECT_EQ(described_unit("Roughness, mm²/s³"), "mm²/s³");
  EXPECT_EQ(described_unit("Per minute, n, 1/min."), "1/min");
  EXPECT_EQ(described_unit("Wires, n_D (1)."), "");
  EXPECT_EQ(described_unit("In mm, s, deg, or none."), "");
  EXPECT_EQ(described_unit(""), "");
}

TEST(ResultUnits, FiguresOfAllKindsHaveTheirs) {
  EXPECT_EQ(result_unit("contour", "summary", "duration"), "s");
  EXPECT_EQ(result_unit("contour", "summary", "path_length"), "mm");
  EXPECT_EQ(result_unit("contour", "summary", "iterations"), "");
  EXPECT_EQ(result_unit("contour", "summary", "coarse_smoothness"), "mm²/s³");
  EXPECT_EQ(result_unit("contour", "summary", "peak_coarse_acceleration"), "mm/s²");
  EXPECT_EQ(result_unit("contour", "summary", "rms_acceleration"), "mm/s²");
  EXPECT_EQ(result_unit("fill_factor", "summary", "wire"), "") << "its members have several";
  EXPECT_EQ(result_unit("contour", "bound", "duration"), "s");
  EXPECT_EQ(result_unit("contour", "bound", "gap"), "");
  EXPECT_EQ(result_unit("winding", "summary", "resistance"), "Ω");
  EXPECT_EQ(result_unit("winding", "summary", "strokes_per_minute"), "1/min");
  EXPECT_EQ(result_unit("winding", "summary", "clearance"), "mm");
  EXPECT_EQ(result_unit("fill_factor", "bound", "count"), "");
  EXPECT_EQ(result_unit("fill_factor", "summary", "electrical_fill"), "");
  EXPECT_EQ(result_unit("nothing", "summary", "duration"), "");
}

}  // namespace
}  // namespace bahnwerk::api
