#include "core/winding/wire.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::winding {
namespace {

// Spot values of IEC 60317-0-1: nominal, grade, largest and smallest overall diameter. Those of R 40 sizes are not
// stored but follow from their neighbours, so they test the rule.
TEST(Wire, HasTheStandardsDiameters) {
  const struct {
    double copper;
    int grade;
    double most, least;
  } values[] = {{0.2, 1, 0.226, 0.214},  {0.3, 3, 0.369, 0.353},  {0.375, 2, 0.434, 0.415}, {0.5, 2, 0.566, 0.545},
                {0.63, 2, 0.704, 0.680}, {0.75, 1, 0.805, 0.780}, {0.9, 2, 0.989, 0.960},   {0.95, 2, 1.044, 1.013},
                {1.0, 3, 1.124, 1.095},  {1.12, 2, 1.217, 1.185}, {1.32, 1, 1.388, 1.356},  {1.6, 2, 1.706, 1.671},
                {1.9, 2, 2.012, 1.975},  {2.12, 1, 2.196, 2.161}, {2.8, 2, 2.922, 2.881},   {5.0, 1, 5.093, 5.050}};
  for (const auto& v : values) {
    const auto wire = standard_wire(v.copper, v.grade);
    ASSERT_TRUE(wire) << v.copper;
    EXPECT_NEAR(wire->outer, v.most, 1e-9) << v.copper;
    EXPECT_NEAR(wire->outer * (1 - wire->tolerance), v.least, 1e-9) << v.copper;
  }
}

TEST(Wire, EnamelGrowsWithGradeAndDiameter) {
  for (int grade = 1; grade <= 3; ++grade) {
    const auto list = standard_wires(grade, 0, 10, Series::r40);
    EXPECT_EQ(list.size(), 57u);
    for (std::size_t i = 1; i < list.size(); ++i) {
      EXPECT_GT(list[i].copper, list[i - 1].copper);
      EXPECT_GE(list[i].outer - list[i].copper, list[i - 1].outer - list[i - 1].copper - 1e-12);
      EXPECT_LE(list[i].tolerance, 0.058);
      if (grade == 1) continue;
      EXPECT_GT(list[i].outer, standard_wire(list[i].copper, grade - 1)->outer);
    }
  }
}

TEST(Wire, RangeAndSeriesAreChosen) {
  EXPECT_EQ(standard_wires(2, 0.5, 1.6, Series::r20).size(), 11u);
  EXPECT_EQ(standard_wires(2, 0.5, 1.6, Series::r40).size(), 21u);
  EXPECT_TRUE(standard_wires(2, 0.51, 0.52, Series::r40).empty());
  EXPECT_FALSE(standard_wire(0.91, 2));
}

TEST(NearestGrade, IsThatOfTheEnamel) {
  for (const int grade : {1, 2, 3})
    for (const double copper : {0.25, 0.71, 1.5}) {
      const Wire wire = *standard_wire(copper, grade);
      EXPECT_EQ(nearest_grade(wire), grade);
      EXPECT_EQ(nearest_grade({copper * 1.003, wire.outer + copper * 0.003, 0}), grade) << "a copper of its own";
    }
  EXPECT_EQ(nearest_grade({1, 1, 0}), 1) << "bare";
}

}  // namespace
}  // namespace bahnwerk::winding
