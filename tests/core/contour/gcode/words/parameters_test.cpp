#include "core/contour/gcode/words/parameters.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::gcode {
namespace {

/// A control that knows #5220 and #<_feed>.
struct Control final : SystemParameters {
  std::optional<double> system_parameter(int number) const override {
    return number == 5220 ? std::optional(2.0) : std::nullopt;
  }
  std::optional<double> predefined(std::string_view name) const override {
    return name == "_feed" ? std::optional(60.0) : std::nullopt;
  }
  bool of_the_machine(std::string_view name) const override { return name == "_spindle"; }
};

TEST(Parameters, TheFirstReadWithoutAValueIsRecordedAllAreCounted) {
  const Control control;
  Parameters p(control);
  p.set(7, 1.5);
  EXPECT_EQ(p.get(7, 1), 1.5);
  EXPECT_EQ(p.unset().count, 0u);
  EXPECT_EQ(p.get(8, 4), 0);
  EXPECT_EQ(p.get(9, 5), 0);
  EXPECT_EQ(p.get(5221, 6), 0) << "of the control, unknown";
  EXPECT_EQ(p.unset().number, 8);
  EXPECT_EQ(p.unset().line, 4u);
  EXPECT_EQ(p.unset().count, 3u);
  EXPECT_EQ(p.get(5220, 7), 2);
}

TEST(Parameters, NumbersOfTheControlAreThoseOfPositionsAndOffsets) {
  for (const auto& [number, system] : std::vector<std::pair<int, bool>>{{1, false},
                                                                        {5020, false},
                                                                        {5021, true},
                                                                        {5029, true},
                                                                        {5030, false},
                                                                        {5160, false},
                                                                        {5161, true},
                                                                        {5602, true},
                                                                        {5603, false},
                                                                        {9999, false}})
    EXPECT_EQ(Parameters::system(number), system) << number;
}

TEST(Parameters, ASubprogramHasItsOwnFirstThirty) {
  const Control control;
  Parameters p(control);
  p.set(1, 10), p.set(2, 20), p.set(31, 310);
  p.enter({11});
  EXPECT_EQ(p.get(1, 1), 11) << "given";
  EXPECT_EQ(p.get(2, 1), 20) << "copied";
  p.set(2, 21), p.set(30, 5), p.set(31, 311);
  p.enter({});
  EXPECT_EQ(p.get(2, 1), 21);
  p.leave();
  p.leave();
  EXPECT_EQ(p.get(1, 1), 10);
  EXPECT_EQ(p.get(2, 1), 20);
  EXPECT_EQ(p.get(31, 1), 311) << "those above are everyone's";
  EXPECT_EQ(p.unset().count, 0u);
  EXPECT_EQ(p.get(30, 9), 0);
  EXPECT_EQ(p.unset().number, 30) << "it was set inside alone";
}

TEST(Parameters, NamesAreLocalUnlessTheyBeginWithAnUnderscore) {
  const Control control;
  Parameters p(control);
  EXPECT_TRUE(p.set("depth", 1));
  p.enter({});
  EXPECT_EQ(p.get("depth", 1), std::nullopt);
  EXPECT_TRUE(p.set("depth", 2) && p.set("_all", 3));
  EXPECT_EQ(p.get("depth", 1), 2);
  EXPECT_EQ(p.get("_call_level", 1), 1);
  p.leave();
  EXPECT_EQ(p.get("depth", 1), 1);
  EXPECT_EQ(p.get("_all", 1), 3);
  EXPECT_EQ(p.get("_call_level", 1), 0);
  EXPECT_EQ(p.get("_line", 17), 17);
  EXPECT_EQ(p.get("_feed", 1), 60);
  EXPECT_TRUE(p.kept("_feed") && p.kept("_line"));
  EXPECT_FALSE(p.kept("_all") || p.kept("depth") || p.kept("feed"));
  EXPECT_TRUE(p.of_the_machine("_spindle"));
}

TEST(Parameters, NamesOfAnEndedSubprogramMakeRoom) {
  const Control control;
  Parameters p(control);
  p.enter({});
  for (std::size_t i = 0; i < Parameters::max_names; ++i) ASSERT_TRUE(p.set("n" + std::to_string(i), 0));
  EXPECT_FALSE(p.set("more", 0));
  EXPECT_TRUE(p.set("n0", 1)) << "it is there already";
  p.leave();
  EXPECT_TRUE(p.set("more", 0));
}

}  // namespace
}  // namespace bahnwerk::gcode
