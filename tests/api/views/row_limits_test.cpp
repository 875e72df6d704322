#include "api/views/row_limits.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::api {
namespace {

struct RowLimit {
  double use;
  std::uint8_t limit;
};

/// Rows of columns x and v, 0.5 s apart.
std::vector<RowLimit> computed(const DeclaredLimits& list, const std::vector<double>& values) {
  const RowLimits limits(list, {{"x", "mm"}, {"v", "mm/s"}}, 0.5);
  const std::size_t count = values.size() / 2;
  std::vector<double> uses(count);
  std::vector<std::uint8_t> numbers(count);
  limits.compute(values.data(), count, 0, count, {uses.data(), numbers.data()});
  std::vector<RowLimit> rows;
  for (std::size_t k = 0; k < count; ++k) rows.push_back({uses[k], numbers[k]});
  return rows;
}

DeclaredLimit of_x(double lowest, double highest) { return {"position x", "mm", "x", 0, {lowest, highest}}; }

TEST(RowLimitsTest, SharesFollowTheFormOfTheLimit) {
  constexpr double none = unlimited;
  struct {
    double lowest, highest, x, use;
  } const cases[] = {{-4, 4, -3, 0.75}, {2, 6, 3, 0.5},       {2, 6, 6, 1},          {-none, 8, 6, 0.75},
                     {-none, 8, -6, 0}, {-8, none, -6, 0.75}, {3, none, 4, 0.75},    {0, none, 0, 1},
                     {0, none, 0.1, 0}, {-none, 0, 0, 1},     {-none, -3, -4, 0.75}, {-none, none, 9, 0}};
  for (const auto& each : cases)
    EXPECT_DOUBLE_EQ(computed({of_x(each.lowest, each.highest)}, {each.x, 1})[0].use, each.use)
        << each.lowest << " … " << each.highest << " at " << each.x;
}

TEST(RowLimitsTest, ARowBelongsToTheLargestShareFrom98HundredthsOn) {
  const DeclaredLimits list{of_x(-100, 100), {"speed", "mm/s", "", 1, {-10, 10}}};
  const auto rows = computed(list, {98, 9, 97.9, 9, 99, 9.95, 100, 10});
  EXPECT_EQ(rows[0].limit, row_states + 0);
  EXPECT_EQ(rows[1].limit, ahead);
  EXPECT_EQ(rows[2].limit, row_states + 1);
  EXPECT_EQ(rows[3].limit, row_states + 0) << "the first of equal ones";
}

TEST(RowLimitsTest, RestsAreStopsOrLastUpToTheNextRow) {
  const auto rows = computed({}, {0, 5, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0});
  EXPECT_EQ(rows[0].limit, ahead);
  EXPECT_EQ(rows[1].limit, dwell);
  EXPECT_EQ(rows[2].limit, dwell);
  EXPECT_EQ(rows[3].limit, stop);
  EXPECT_EQ(rows[4].limit, ahead);
  EXPECT_EQ(rows[5].limit, stop) << "the last row";
}

TEST(RowLimitsTest, MissingDerivativesAreDifferencesAndThoseOfTheLastRowsAreRepeated) {
  const DeclaredLimits second{{"acceleration x", "mm/s²", "x", 2, {-8, 8}}};
  const auto rows = computed(second, {0, 1, 1, 1, 3, 1, 4, 1});  // second differences 1 and −1, by 0.25 s²
  EXPECT_DOUBLE_EQ(rows[0].use, 0.5);
  EXPECT_DOUBLE_EQ(rows[1].use, 0.5);
  EXPECT_DOUBLE_EQ(rows[3].use, 0.5);
  EXPECT_EQ(computed(second, {0, 1, 9, 1})[0].use, 0) << "a series of two rows has no second difference";
}

TEST(RowLimitsTest, StepsOfAKeyChangeTheLimitAndBeforeTheFirstThereIsNone) {
  DeclaredLimit limit{"speed", "mm/s", "", 1};
  limit.key = "x";
  limit.steps = {{1, {-10, 10}}, {2, {}}, {3, {-20, 20}}};
  const auto rows = computed({limit}, {0.5, 5, 1, 5, 1.9, 5, 2, 5, 7, 5});
  const double expected[] = {0, 0.5, 0.5, 0, 0.25};
  for (std::size_t k = 0; k < 5; ++k) EXPECT_DOUBLE_EQ(rows[k].use, expected[k]) << k;
}

TEST(RowLimitsTest, ALimitWithoutItsColumnIsNeverMet) {
  const RowLimits limits({{"jerk q", "mm/s³", "q", 3, {-1, 1}}}, {{"x", "mm"}, {"v", "mm/s"}}, 0.5);
  EXPECT_EQ(limits.numbers(), row_states + 1);
  EXPECT_EQ(limits.column(0), "");
}

}  // namespace
}  // namespace bahnwerk::api
