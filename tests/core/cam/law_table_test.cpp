#include "core/cam/law_table.hpp"

#include <gtest/gtest.h>

#include "tests/core/cam/problems.hpp"

namespace bahnwerk::cam {
namespace {

using namespace testing_problems;

std::vector<double> row(const LawTable& table, std::size_t k) {
  std::vector<double> out(5);
  table.read(k, 1, out.data());
  return out;
}

TEST(LawTable, AnOpenLawEndsWithItsLastState) {
  MotionLawProblem p = problem(100, false, {rest(20, 0), rest(120, 40)});
  p.cycle_duration = 2;
  const LawTable table({{0.4, 2.4}, {{0, {0, 0, 0, 40, 40, 40}}}, false}, p, 2, 8);
  ASSERT_EQ(table.count(), 9u);
  EXPECT_DOUBLE_EQ(table.cycle_time(), 0.25);
  EXPECT_EQ(table.independent().name, "phi");
  EXPECT_EQ(table.independent().unit, "deg");
  EXPECT_DOUBLE_EQ(table.independent().step, 12.5);
  EXPECT_EQ(row(table, 0), (std::vector<double>{20, 0, 0, 0, 300}));
  EXPECT_DOUBLE_EQ(row(table, 4)[1], 20);
  EXPECT_EQ(row(table, 8), (std::vector<double>{120, 40, 0, 0, 300}));
}

TEST(LawTable, RowsOverAMasterInSecondsAreOverTime) {
  MotionLawProblem p = problem(2, false, {rest(0, 0), rest(2, 40)});
  p.master_unit = "s";
  const LawTable table({{0, 2}, {{0, {0, 0, 0, 40, 40, 40}}}, false}, p, 2, 8);
  EXPECT_TRUE(table.independent().time());
  EXPECT_DOUBLE_EQ(table.independent().step, 0.25);
}

TEST(LawTable, APeriodicLawBeginsWhereTheMasterDoesAndRowsAtBreaksAreBehindThem) {
  MotionLawProblem p = problem(4, true, {point(1, 0, {number(1)}), point(2, 0, {number(3)})});
  const LawTable table({{1, 2, 5}, {{0, {1, 3}}, {1, {3, 1}}}, true}, p, 4, 4);
  EXPECT_EQ(table_begin(p), 0);
  EXPECT_NEAR(row(table, 0)[1], 3 - 2.0 * 2 / 3, 1e-14);
  EXPECT_EQ(row(table, 1)[2], 2);  // behind the break
  EXPECT_NEAR(row(table, 2)[2], -2.0 / 3, 1e-15);
  EXPECT_NEAR(row(table, 4)[1], row(table, 0)[1], 1e-14);
  EXPECT_EQ(row(table, 4)[0], 4);
  std::vector<double> all(25);
  table.read(0, 5, all.data());
  for (std::size_t k = 0; k < 5; ++k)
    for (std::size_t c = 0; c < 5; ++c) EXPECT_EQ(all[5 * k + c], row(table, k)[c]);
}

}  // namespace
}  // namespace bahnwerk::cam
