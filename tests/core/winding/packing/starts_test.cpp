#include "core/winding/packing/starts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/numeric/random.hpp"
#include "core/winding/layout/potential.hpp"
#include "tests/core/winding/packing_rooms.hpp"

namespace bahnwerk::winding {
namespace {

using namespace test;

TEST(Rows, KeepTheirDistanceInTheRoom) {
  Random random(11);
  const Region usable_area = stator_room();
  const CentreArea centres(usable_area, 0.4, silent);
  const auto found = best_rows(centres, sides(centres.edges(), 1), 0.8, 300, random);
  EXPECT_GE(found.size(), 90u);
  EXPECT_TRUE(packed(usable_area, 0.4, 0, found));
}

}  // namespace
}  // namespace bahnwerk::winding
