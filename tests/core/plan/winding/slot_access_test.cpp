#include "core/plan/winding/slot_access.hpp"

#include <gtest/gtest.h>

#include "core/base/progress.hpp"

namespace bahnwerk {
namespace {

WindingRequest stator(double width) {
  WindingRequest r;
  r.part = winding::StatorPart{};
  r.needle.width = width;
  return r;
}

TEST(SlotAccess, AnswersWithAndWithoutPivotShift) {
  Progress progress;
  WindingRequest r = stator(2.6);
  const auto alone = slot_access(r, progress);
  ASSERT_TRUE(alone);
  EXPECT_EQ(alone->maps.size(), 1u);
  r.model.pivot_limit = 0.3;
  const auto both = slot_access(r, progress);
  ASSERT_EQ(both->shares.size(), 2u);
  EXPECT_EQ(both->shares[0], alone->shares[0]);
  EXPECT_GT(both->shares[1], both->shares[0]);
  EXPECT_NE(both->drawing.find("without pivot shift"), std::string::npos);
  // More clearance is kept in less of the slot, and by a wider needle nowhere.
  r.least_clearance = 0.3;
  EXPECT_LT(slot_access(r, progress)->shares[1], both->shares[1]);
  EXPECT_EQ(slot_access(stator(8), progress)->shares[0], 0);
}

TEST(SlotAccess, ARotorHasNone) {
  Progress progress;
  WindingRequest r;
  r.part = winding::RotorPart{};
  EXPECT_FALSE(slot_access(r, progress));
}

}  // namespace
}  // namespace bahnwerk
