#include "core/plan/winding/laid_coils.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "tests/core/plan/winding/winding_requests.hpp"

namespace bahnwerk {
namespace {

std::vector<std::string> refused_place(const WindingRequest& request) {
  Progress progress;
  WindingPlan plan;
  try {
    lay_coils(request, plan, progress);
  } catch (const InvalidInput& error) {
    return error.faults.front().place;
  }
  return {};
}

TEST(LaidCoils, EveryTurnHasItsPlaceInTheLayout) {
  for (WindingRequest request : {stator_request(2), rotor_request(2)}) {
    Progress progress;
    WindingPlan plan;
    lay_coils(request, plan, progress);
    EXPECT_EQ(plan.turns.size(), 2u);
    EXPECT_TRUE(plan.windable.can_be_wound(2));
    EXPECT_GE(plan.layout[0].wires.size(), plan.windable.wires);
    EXPECT_TRUE(plan.support.empty()) << "support points come later";
  }
}

TEST(LaidCoils, AsManyTurnsAreLaidAsTheSlotTakes) {
  WindingRequest request = rotor_request(0);
  request.parallel = 2;
  Progress progress;
  WindingPlan plan;
  lay_coils(request, plan, progress);
  EXPECT_EQ(plan.turns.size(), plan.layout[0].wires.size() / 2);
  request.parallel = plan.layout[0].wires.size() + 1;
  EXPECT_EQ(refused_place(request), (std::vector<std::string>{"coil", "parallel"}));
}

}  // namespace
}  // namespace bahnwerk
