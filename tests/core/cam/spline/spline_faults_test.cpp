#include "core/cam/spline/spline_faults.hpp"

#include <gtest/gtest.h>

#include "tests/core/cam/problems.hpp"

namespace bahnwerk::cam {
namespace {

using Place = std::vector<std::string>;
using namespace testing_problems;

TEST(SplineFaults, ValuesStandWhereTheDocumentHasThem) {
  EXPECT_EQ(value_place(3, 0), (Place{"points", "3", "position"}));
  EXPECT_EQ(value_place(0, 3), (Place{"points", "0", "jerk"}));
  EXPECT_EQ(value_place(3, 4), (Place{"points", "3", "derivatives", "4"}));
  EXPECT_EQ(order_name(2), "acceleration");
  EXPECT_EQ(order_name(5), "derivative of order 5");
}

TEST(SplineFaults, ConditionsThatFollowFromEachOtherAreEachNamedAtTheirPlace) {
  const MotionLawProblem law = problem(2, false, {rest(0, 0), rest(1, 1), rest(2, 0)});
  SingularSystem why;
  why.dependent = {{1, 0, false}, {2, 1, false}};
  why.undetermined = {{1, 2, false}};
  const InvalidInput error = singular_faults(law, why);
  ASSERT_FALSE(error.faults.empty());
  bool position = false, velocity = false;
  for (const InputFault& fault : error.faults) {
    position = position || fault.place == value_place(1, 0);
    velocity = velocity || fault.place == value_place(2, 1);
    EXPECT_FALSE(fault.message.empty());
  }
  EXPECT_TRUE(position);
  EXPECT_TRUE(velocity);
}

}  // namespace
}  // namespace bahnwerk::cam
