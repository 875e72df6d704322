#include "server/routes/pages/result_html.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace bahnwerk::server {
namespace {

using nlohmann::ordered_json;

ordered_json check(const char* name, const char* group, double value, double limit, bool passed = true) {
  return {{"name", name},   {"group", group}, {"unit", "mm"},   {"limit", limit},
          {"value", value}, {"at", 0.5},      {"at_unit", "s"}, {"passed", passed}};
}

std::size_t count(const std::string& text, std::string_view part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

const Texts english(Language::en), german(Language::de);

TEST(ResultHtml, EachRowOfATableHasALineAndWhatIsMissingADash) {
  const ordered_json rows = {{{"planner", "filter"}, {"reason", "slower"}, {"used_duration", 2.61777798}},
                             {{"planner", "<b>"}, {"duration", nullptr}, {"centred", true}}};
  EXPECT_EQ(shown_value(rows, english),
            "planner filter, reason slower, used duration 2.61778<br>planner &lt;b&gt;, duration –, centred yes");
  EXPECT_EQ(shown_value(3, english), "3");
  EXPECT_EQ(shown_value(ordered_json::array(), english), "");
}

TEST(ResultHtml, DurationsHaveThePrecisionThatTheirLengthNeeds) {
  EXPECT_EQ(duration_label(0), "0.000 s");
  EXPECT_EQ(duration_label(3.3148), "3.315 s");
  EXPECT_EQ(duration_label(59.9994), "59.999 s");
  EXPECT_EQ(duration_label(59.9996), "60.00 s");
  EXPECT_EQ(duration_label(152.973), "152.97 s");
  EXPECT_EQ(duration_label(599.996), "10 min 0 s");
  EXPECT_EQ(duration_label(3599.7), "1 h 0 min");
  EXPECT_EQ(duration_label(7384), "2 h 3 min");
}

TEST(ResultHtml, SharesHaveTwoDigitsAndSmallOnesAreNotZero) {
  EXPECT_EQ(percent(0), "0 %");
  EXPECT_EQ(percent(1e-9), "&lt; 0.01 %");
  EXPECT_EQ(percent(0.00938), "0.94 %");
  EXPECT_EQ(percent(0.0949), "9.5 %");
  EXPECT_EQ(percent(0.0999), "10 %");
  EXPECT_EQ(percent(0.4801), "48 %");
  EXPECT_EQ(percent(1), "100 %");
  EXPECT_EQ(percent(12), "1200 %");
}

TEST(ResultHtml, NumbersHaveTheDecimalSignOfTheLanguage) {
  EXPECT_EQ(shown_value(2.5, german), "2,5");
  EXPECT_EQ(duration_label(3.3148, german), "3,315 s");
  EXPECT_EQ(percent(0.00938, german), "0,94 %");
  EXPECT_TRUE(has(verification({{"passed", true}, {"checks", {check("a", "limit", 1.5, 2)}}}, german), "1,5 mm"));
  EXPECT_TRUE(
      has(verification({{"passed", true}, {"checks", {check("path velocity (feed 400)", "limit", 1, 2)}}}, german),
          ">Bahngeschwindigkeit (Vorschub 400)</th>"));
}

TEST(ResultHtml, ExactnessIsFoldedAndLimitsAndFailedChecksAreNot) {
  const ordered_json verdict = {{"passed", false},
                                {"checks",
                                 {check("deviation", "geometry", 0.2, 1), check("chord", "geometry", 0.5, 1),
                                  check("velocity x", "limit", 75, 100), check("rest", "continuity", 3, 0, false)}}};
  const std::string text = verification(verdict, english);
  const std::size_t fold = text.find("<details>");
  EXPECT_TRUE(has(text, "Verification: failed"));
  EXPECT_LT(text.find(">rest</th>"), text.find(">velocity x</th>"));
  EXPECT_LT(text.find(">velocity x</th>"), fold);
  EXPECT_LT(fold, text.find(">deviation</th>"));
  EXPECT_TRUE(has(text, "2 exactness checks passed, largest use 50 % (chord)")) << text;
  EXPECT_TRUE(has(text, "value=\"0.7500\"")) << text;
  EXPECT_EQ(count(text, "<details"), 1U) << "all groups are folded together";
  EXPECT_EQ(count(text, "scope=\"rowgroup\""), 1U) << "a group without a check that passed has nothing to fold";
  EXPECT_TRUE(has(text, "data-at=\"0.5\" data-unit=\"s\"")) << text;
}

TEST(ResultHtml, ALeastPermittedValueIsUsedTheLessTheLargerTheValueIs) {
  const auto shown = [](double value, double limit, bool passed) {
    return verification({{"passed", passed}, {"checks", {check("clearance", "limit", value, limit, passed)}}}, english);
  };
  EXPECT_TRUE(has(shown(4, 1, true), "value=\"0.2500\""));
  EXPECT_TRUE(has(shown(1, 4, false), "optimum=\"0\" aria-label=\"clearance\" value=\"4.0000\"></meter> 400 %"));
  EXPECT_TRUE(has(shown(0, 4, true), "0 %"));
  EXPECT_FALSE(has(shown(4, 0, true), "<meter")) << "a limit of 0 has no share";
}

TEST(ResultHtml, ABoundIsASentenceWithAGauge) {
  const ordered_json result = {{"bound", {{"duration", 3.31485}, {"gap", 2e-7}, {"basis", "axis <limits>"}}}};
  const std::string text = bound_sentence(result, english);
  EXPECT_TRUE(has(text, "No motion within these limits is shorter than 3.31485 s: at most 0.00002 % to gain.")) << text;
  EXPECT_TRUE(has(text, "<meter max=\"1\"")) << text;
  EXPECT_TRUE(has(text, "axis &lt;limits&gt;")) << text;
  EXPECT_TRUE(has(bound_sentence(result, german), "3,31485 s")) << bound_sentence(result, german);
  EXPECT_TRUE(has(bound_sentence({{"bound", {{"duration", 2}, {"gap", 1}}}}, english), "at most 50 % to gain"));
  EXPECT_TRUE(
      has(bound_sentence({{"bound", {{"count", 60}, {"gap", 0.05}}}}, english), "more than 60 wires: at most 5 %"));
  EXPECT_TRUE(has(bound_sentence({{"bound", {{"objective", 1.5}, {"gap", 0}}}}, english), "below 1.5: at most 0 %"));
  EXPECT_EQ(bound_sentence({{"bound", {{"objective", 0}, {"gap", nullptr}}}}, english), "");
  EXPECT_EQ(bound_sentence(ordered_json::object(), english), "");
}

TEST(ResultHtml, MissingAndInfiniteFiguresAreNoFault) {
  EXPECT_EQ(verification(ordered_json(), english), "");
  EXPECT_EQ(figures(ordered_json(), "contour", "summary", english), "");
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(
      has(verification({{"passed", true}, {"checks", {check("a", "limit", 1, infinite)}}}, english), ">a</th>"));
  EXPECT_TRUE(has(verification({{"passed", true}, {"checks", {{{"name", "old"}, {"passed", true}}}}}, english), "old"));
}

}  // namespace
}  // namespace bahnwerk::server
