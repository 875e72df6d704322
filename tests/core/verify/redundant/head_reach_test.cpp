#include "core/verify/redundant/head_reach.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/contour/builder.hpp"

namespace bahnwerk::verify {
namespace {

const Machine machine{{{"x", 1000, 10000}, {"y", 1000, 10000}}};

/// A move of 100 mm, a circle of radius 10 cut at 100 mm/s, 0.3 s of rest, a move of 30 mm.
Contour contour() {
  ContourBuilder b(2, {0, 0, 0});
  b.block(Mode::position, unlimited);
  b.line({100, 0, 0});
  b.block(Mode::cut, 100);
  b.arc({100, 0, 0}, {110, 0, 0}, true);
  b.dwell(0.3);
  b.block(Mode::position, unlimited);
  b.line({100, 30, 0});
  return b.finish();
}
const std::vector<SectionBound> sections{{0, 1, 0.2}, {1, 2, 0.64}, {2, 3, 0.1}};

TEST(HeadReach, AMoveFromRestIsLimitedByTheAxes) {
  const Contour c = contour();
  const CartesianAxisPath path(c.path, 2);
  const PathTask task = contour_task(path, c, machine);
  const HeadReach reach = reached(task, sections, 0, 1, {});
  EXPECT_EQ(reach.until, unlimited);
  const auto boxes = reach_at(reach, 0, 0.01, 20);
  EXPECT_NEAR(boxes[0].highest, 1, 1e-6);  // the first piece
  for (const std::size_t i : {2u, 5u, 8u})
    EXPECT_NEAR(boxes[i].highest, 0.5 * 10000 * std::pow(0.01 * static_cast<double>(i), 2), 1.01);
  EXPECT_NEAR(boxes[14].highest, 50 + 1000 * 0.04, 1.01);
  EXPECT_NEAR(boxes[20].highest, 100, 1e-6);
  EXPECT_NEAR(boxes[20].lowest, 0, 1e-6);
  EXPECT_NEAR(reach_at(reach, 1, 0.01, 20)[20].highest, 0, 1e-4);
}

TEST(HeadReach, NeighboursTakeAtLeastTheirFeedsTheirBoundsAndTheirDwells) {
  const Contour c = contour();
  const CartesianAxisPath path(c.path, 2);
  const PathTask task = contour_task(path, c, machine);
  // Back from the rest behind the circle: 0.3 s at it if dwells count, then 100 mm/s, then the move.
  for (const double dwell : {0.0, 0.3}) {
    const HeadReach reach = reached(task, sections, 2, 0, {2, 0.5, dwell > 0});
    const auto boxes = reach_at(reach, 0, 0.01, 200);
    const auto at = [&](double t) { return boxes[static_cast<std::size_t>(std::lround((t + dwell) / 0.01))]; };
    EXPECT_NEAR(at(0.1).highest, 110 - 10 * std::cos(1), 0.6);  // 10 mm along the circle
    EXPECT_NEAR(at(0.35).highest, 120, 0.1);
    EXPECT_NEAR(at(0.6).lowest, 100, 0.1);
    EXPECT_LT(at(0.75).lowest, 90);
    EXPECT_NEAR(at(1).lowest, 0, 1e-3);
  }
}

TEST(HeadReach, WhatIsNotLookedAtIsUnlimited) {
  const Contour c = contour();
  const CartesianAxisPath path(c.path, 2);
  const PathTask task = contour_task(path, c, machine);
  const HeadReach reach = reached(task, sections, 0, 3, {0.1, 1});
  EXPECT_LE(reach.until, 0.1);
  const auto boxes = reach_at(reach, 0, 0.05, 4);
  EXPECT_EQ(boxes[4].highest, unlimited);
  EXPECT_LT(boxes[1].highest, 100);
}

}  // namespace
}  // namespace bahnwerk::verify
