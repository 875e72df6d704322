#include "core/plan/winding/needle_support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "core/plan/winding/laid_coils.hpp"
#include "tests/core/plan/winding/winding_plans.hpp"

namespace bahnwerk {
namespace {

constexpr double degree = std::numbers::pi / 180;

std::vector<std::optional<double>> tried(double degrees) {
  WindingRequest request = stator_request(1);
  request.model.pivot_limit = degrees * degree;
  return tried_swivels(request);
}

std::vector<winding::FixedPiece> supported(const WindingRequest& request, std::optional<double> swivel) {
  Progress progress;
  WindingPlan plan;
  lay_coils(request, plan, progress);
  winding::NeedleModel model = request.model;
  model.pivot_limit = swivel;
  return *needle_support(request, plan.turns, model, progress);
}

TEST(NeedleSupport, EverySwivelTriedWithOneLimitIsTriedWithEveryLargerOne) {
  std::vector<std::optional<double>> before = tried(0);
  EXPECT_EQ(before, (std::vector<std::optional<double>>{0}));
  for (double limit = 0.25; limit < 90; limit += 0.25) {
    const std::vector<std::optional<double>> now = tried(limit);
    ASSERT_GE(now.size(), before.size());
    EXPECT_TRUE(std::equal(before.rbegin(), before.rend(), now.rbegin())) << limit;
    EXPECT_LE(*now.front(), limit * degree + 1e-12);
    EXPECT_GE(*now.front(), std::min(limit - 1, 0.75 * limit) * degree - 1e-12) << "few degrees are given away";
    EXPECT_TRUE(std::is_sorted(now.rbegin(), now.rend()));
    before = now;
  }
}

TEST(NeedleSupport, WithoutSwivelAndInARotorOneIsTried) {
  WindingRequest request = stator_request(1);
  request.model.pivot_limit.reset();
  EXPECT_EQ(tried_swivels(request), (std::vector<std::optional<double>>{std::nullopt}));
  request = rotor_request(1);
  request.model.pivot_limit = 0.2;
  EXPECT_EQ(tried_swivels(request), (std::vector<std::optional<double>>{0.2}));
}

TEST(NeedleSupport, ASwivelOf0HasThePosesOfANeedleWithoutOne) {
  const WindingRequest request = stator_request(2);
  const auto without = supported(request, std::nullopt);
  EXPECT_TRUE(same_poses(without, supported(request, 0)));
  EXPECT_FALSE(same_poses(without, supported(request, 5 * degree)));
  EXPECT_FALSE(same_poses(without, supported(stator_request(1), std::nullopt)));
}

TEST(NeedleSupport, ALimitBetweenTwoSwivelsHasThePlanOfTheSmallerOne) {
  WindingRequest request = stator_request(1);
  request.feed = PlanningMethod::critical_points;
  request.model.pivot_limit = 3 * degree;
  const WindingPlan smaller = planned(request);
  request.model.pivot_limit = 3.9 * degree;
  EXPECT_TRUE(same_poses(planned(request).support, smaller.support));
}

// The needle fills the opening but for 0.04 mm on either side: a swivel on the way out of the slot touches a tooth.
TEST(NeedleSupport, ANeedleThatFillsTheOpeningIsPlannedWithEveryLimit) {
  WindingRequest request = stator_request(1);
  request.feed = PlanningMethod::critical_points, request.cycle_time = 0.004;
  request.least_clearance = 0;
  const auto& part = std::get<winding::StatorPart>(request.part);
  request.needle.width = winding::clear_way(part, winding::checked_slot(part)) - 0.08;
  request.model.pivot_limit.reset();
  expect_verified(planned(request), "without");
  for (const double limit : {0.5, 2.0, 5.0, 11.0, 25.0, 85.0}) {
    request.model.pivot_limit = limit * degree;
    expect_verified(planned(request), "with a limit of " + std::to_string(limit));
  }
}

TEST(NeedleSupport, HolderAndSwivelStayOutOfTheSlot) {
  WindingRequest request = rotor_request(1);
  const auto support = supported(request, std::nullopt);
  EXPECT_NO_THROW(check_depth(request, support));
  const auto refused_place = [&] {
    try {
      check_depth(request, support);
    } catch (const InvalidInput& error) {
      return error.faults.front().place;
    }
    return std::vector<std::string>{};
  };
  request.needle.length = 5;
  EXPECT_EQ(refused_place(), (std::vector<std::string>{"needle", "length"}));
  request = rotor_request(1);
  request.swivel_length = 5;
  EXPECT_EQ(refused_place(), (std::vector<std::string>{"machine", "l_tool"}));
}

}  // namespace
}  // namespace bahnwerk
