#include "core/plan/winding/pose_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/spline/spline_arc.hpp"

namespace bahnwerk {
namespace {

TEST(PosePath, SaysTheSameAsThePieces) {
  std::vector<BezierPiece> pieces{BezierPiece::line({50, 0, 0, 0.5, 0}, {50, 0, 40, 1, 0.2})};
  for (const BezierPiece& piece : spline_arc({50, 0, 40, 1, 0.2}, {0, 0, 40}, {0, 0, 1}, 2.5, {0, 0, 3, 2.5, -0.1}))
    pieces.push_back(piece);
  const PosePath path = pose_path(pieces);
  ASSERT_EQ(path.tool.size(), pieces.size());
  EXPECT_TRUE(path.tool[0].straight());
  EXPECT_NEAR(path.tool[0].length(), 40, 1e-12);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    EXPECT_EQ(path.tool[i].source(), i);
    for (const double v : {0.0, 0.2, 0.7, 1.0}) {
      const SplinePoint p = pieces[i].at(v)[0];
      const ToolPose pose = path.orientation->pose(path.tool[i], i, v);
      EXPECT_LE(norm(pose.position - place(p)), 1e-12);
      EXPECT_NEAR(pose.phi, p[3], 1e-13);
      EXPECT_NEAR(pose.psi, p[4], 1e-13);
    }
  }
}

TEST(PosePath, RefusesAnglesThatJump) {
  EXPECT_ANY_THROW(pose_path(
      {BezierPiece::line({0, 0, 0, 0, 0}, {1, 0, 0, 0, 0}), BezierPiece::line({1, 0, 0, 0.1, 0}, {2, 0, 0, 0.1, 0})}));
}

}  // namespace
}  // namespace bahnwerk
