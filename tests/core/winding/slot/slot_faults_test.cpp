#include "core/winding/slot/slot_faults.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::winding {
namespace {

TEST(SlotFaults, AllFaultsComeTogetherEachAtItsMember) {
  SlotFaults faults;
  EXPECT_NO_THROW(faults.stop_if_any());
  faults.add("depth", "is 0");
  try {
    faults.stop("width", "is too wide");
  } catch (const InvalidInput& error) {
    ASSERT_EQ(error.faults.size(), 2u);
    EXPECT_EQ(error.faults[0].place, (std::vector<std::string>{"slot", "depth"}));
    EXPECT_EQ(error.faults[1].place, (std::vector<std::string>{"slot", "width"}));
    EXPECT_EQ(error.faults[1].message, "is too wide");
  }
  EXPECT_THROW(faults.stop_if_any(), InvalidInput);
}

TEST(SlotFaults, LengthsHaveFourDigitsAndTheirUnit) {
  EXPECT_EQ(SlotFaults::mm(12.34567), "12.35 mm");
  EXPECT_EQ(SlotFaults::mm(-0.5), "-0.5 mm");
}

}  // namespace
}  // namespace bahnwerk::winding
