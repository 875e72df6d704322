#include "core/redundant/head/following.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "tests/core/redundant/coarse_fine_machines.hpp"

namespace bahnwerk {
namespace {

/// One cell of 1 ms: at 100 mm with 500 mm/s, acceleration between 70 000 and 72 000 mm/s².
HeadCells one_cell() {
  HeadCells head;
  head.times = {0, 1e-3};
  head.nodes = {{{100, 500, 70000}, {100.5355, 571, 72000}}};
  head.cells = {{{{70000, 72000}, {2e6, 2e6}}}};
  head.pieces = {0};
  return head;
}

TEST(Following, LeavesTheCoarseAxisWhatTheFineOneCannotDo) {
  const CoarseFineAxis axis = test::md2().axes[0];
  const ChainUnits u = chain_units(axis);
  EXPECT_EQ(u.length, 20);
  EXPECT_DOUBLE_EQ(u.time, std::sqrt(20.0 / 16000));
  EXPECT_DOUBLE_EQ(u.acceleration(), 16000);
  const Chain<2> chain = following<2>(one_cell(), 0, axis).value();
  EXPECT_DOUBLE_EQ(chain.steps[0] * u.time, 1e-3);
  EXPECT_DOUBLE_EQ(chain.controls[0].lowest * 16000, 72000 - 60000);
  EXPECT_DOUBLE_EQ(chain.controls[0].highest * 16000, 16000);
  // Stroke less A_f h²/8; velocity less w h/4; both less a millionth.
  EXPECT_NEAR(chain.states[0][0].lowest * 20, 100 - 20 + 60000 * 1e-6 / 8, 1e-4);
  EXPECT_NEAR(chain.states[0][0].highest * 20, 100 + 20 - 60000 * 1e-6 / 8, 1e-4);
  EXPECT_NEAR(chain.states[0][1].lowest * u.velocity(), 500 - 2000 + 0.5, 1e-2);
  EXPECT_NEAR(chain.states[0][1].highest * u.velocity(), 1800, 1e-2);
}

TEST(Following, WithJerkTheControlIsJerk) {
  CoarseFineAxis axis = test::md2().axes[0];
  axis.coarse.jerk = 1e6;
  axis.fine.jerk = 8e6;
  const ChainUnits u = chain_units(axis);
  const Chain<3> chain = following<3>(one_cell(), 0, axis).value();
  EXPECT_NEAR(chain.controls[0].lowest * u.jerk(), -1e6, 1e-6);
  EXPECT_NEAR(chain.controls[0].highest * u.jerk(), 1e6, 1e-6);
  EXPECT_NEAR(chain.states[1][2].lowest * 16000, 72000 - 60000, 1e-6);
  EXPECT_NEAR(chain.states[1][2].highest * 16000, 16000, 1e-6);
}

TEST(Following, WhereTheHeadJumpsBothSidesCount) {
  CoarseFineAxis axis = test::md2().axes[0];
  axis.coarse.jerk = 1e6;
  axis.fine.jerk = 8e6;
  const ChainUnits u = chain_units(axis);
  HeadCells head = one_cell();
  head.nodes[0][1].v_jump = 30;
  head.nodes[0][1].a_jump = -2000;
  const Chain<3> chain = following<3>(head, 0, axis).value();
  EXPECT_NEAR(chain.states[1][1].lowest * u.velocity(), 571 - 2000 + 0.5 + 0.125, 1e-2);
  EXPECT_NEAR(chain.states[1][2].lowest * 16000, 74000 - 60000, 1e-6);
}

TEST(Following, AStretchedHeadIsSlowerAndMilder) {
  const CoarseFineAxis axis = test::md2().axes[0];
  const ChainUnits u = chain_units(axis);
  const Chain<2> chain = following<2>(one_cell(), 0, axis, 2).value();
  EXPECT_DOUBLE_EQ(chain.steps[0] * u.time, 2e-3);
  EXPECT_DOUBLE_EQ(chain.controls[0].lowest * 16000, -16000);
  EXPECT_NEAR(chain.states[0][1].lowest * u.velocity(), 250 - 2000 + 0.25, 1e-2);
}

TEST(Following, AHeadBeyondBothAxesIsNotToBeFollowed) {
  HeadCells head = one_cell();
  head.cells[0][0].acceleration = {70000, 76001};
  EXPECT_FALSE(following<2>(head, 0, test::md2().axes[0]));
  head.cells[0][0].acceleration = {76000, 76000 * (1 + 1e-9)};  // rounding
  const Chain<2> chain = following<2>(head, 0, test::md2().axes[0]).value();
  EXPECT_LE(chain.controls[0].lowest, chain.controls[0].highest);
  EXPECT_LE(chain.controls[0].highest, 1);
}

TEST(Following, RangesOfCoarseAxesAreHeld) {
  CoarseFineAxis axis = test::md2().axes[0];
  axis.coarse.lowest = 95;
  axis.coarse.highest = 110;
  const HeadCells head = one_cell();
  const Chain<2> chain = following<2>(head, 0, axis).value();
  const double between = 16000 * std::pow(head.times[1] - head.times[0], 2) / 8;  // what it may do between nodes
  EXPECT_NEAR(chain.states[0][0].lowest * 20, 95 + between, 1e-12);
  EXPECT_NEAR(chain.states[0][0].highest * 20, 110 - between, 1e-12);
}

}  // namespace
}  // namespace bahnwerk
