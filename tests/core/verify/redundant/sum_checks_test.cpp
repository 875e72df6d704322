#include "core/verify/redundant/sum_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress.hpp"
#include "tests/core/check_names.hpp"

namespace bahnwerk {
namespace {

/// One axis, three rows; every number can be spoiled.
struct Rows final : SetpointSource {
  std::vector<Column> names{{"x", "mm"},     {"vx", "mm/s"},  {"ax", "mm/s²"},  {"xc", "mm"},    {"xf", "mm"},
                            {"vxc", "mm/s"}, {"vxf", "mm/s"}, {"axc", "mm/s²"}, {"axf", "mm/s²"}};
  std::vector<std::vector<double>> rows{{1000, 50, 700, 990, 10, 40, 10, 500, 200},
                                        {1001, 40, -700, 991, 10, 30, 10, -500, -200},
                                        {1002, 0, 0, 1011, -9, 0, 0, 0, 0}};
  const std::vector<Column>& columns() const override { return names; }
  std::size_t count() const override { return rows.size(); }
  double cycle_time() const override { return 0.001; }
  double duration() const override { return 0.002; }
  void read(std::size_t first, std::size_t n, double* out) const override {
    for (std::size_t k = first; k < first + n; ++k)
      for (const double value : rows[k]) *out++ = value;
  }
  std::vector<Check> checks() const {
    const std::vector<AxisLimits> head{{"x", 100, 1000}}, coarse{{"xc", 100, 1000}};
    std::vector<AxisLimits> fine{{"xf", 20, 300}};
    fine[0].lowest = -15, fine[0].highest = 15;
    Progress progress;
    return sum_checks({*this, head, coarse, fine}, progress);
  }
  /// Names of the checks that fail.
  std::vector<std::string> failing() const {
    std::vector<std::string> list;
    for (const Check& c : checks())
      if (!c.passed) list.push_back(check_name(c));
    return list;
  }
};

using Names = std::vector<std::string>;

TEST(SumChecks, SumsThatFitPassAndTellTheirPeaks) {
  const auto checks = Rows().checks();
  ASSERT_EQ(checks.size(), 6u);
  EXPECT_EQ(Rows().failing(), Names{});
  EXPECT_EQ(checks[3].value, 10);
  EXPECT_EQ(checks[4].value, 10);
  EXPECT_EQ(checks[5].value, 200);
}

TEST(SumChecks, WhatDoesNotAddUpFails) {
  Rows rows;
  rows.rows[1][4] += 2e-12;
  EXPECT_EQ(rows.failing(), Names{"setpoints sum"});
  EXPECT_NEAR(rows.checks()[0].at, 0.001, 1e-15);
  rows = {};
  rows.rows[1][4] += 5e-13;
  EXPECT_EQ(rows.failing(), Names{});
  rows = {};
  rows.rows[0][6] += 1e-10;
  EXPECT_EQ(rows.failing(), Names{"setpoints sum of velocities"});
  rows = {};
  rows.rows[2][8] = 1e-9;
  EXPECT_EQ(rows.failing(), Names{"setpoints sum of accelerations"});
}

TEST(SumChecks, FineAxesBeyondTheirLimitsFail) {
  Rows rows;
  rows.rows[1][3] -= 6, rows.rows[1][4] += 6;
  EXPECT_EQ(rows.failing(), Names{"setpoints stroke"});
  rows = {};
  rows.rows[1][5] -= 11, rows.rows[1][6] += 11;
  EXPECT_EQ(rows.failing(), Names{"setpoints fine velocity"});
  rows = {};
  rows.rows[1][7] += 101, rows.rows[1][8] -= 101;
  EXPECT_EQ(rows.failing(), Names{"setpoints fine acceleration"});
}

TEST(SumChecks, MissingColumnsAndWhatIsNoNumberFail) {
  Rows rows;
  rows.names[4].name = "other";
  EXPECT_FALSE(rows.failing().empty());
  rows = {};
  rows.rows[1][3] = std::nan("");
  EXPECT_FALSE(rows.failing().empty());
}

}  // namespace
}  // namespace bahnwerk
