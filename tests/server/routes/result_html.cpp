#include "server/routes/result_html.hpp"

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

TEST(ResultHtml, EachRowOfATableHasALineAndWhatIsMissingADash) {
  const ordered_json rows = {{{"planner", "filter"}, {"reason", "slower"}, {"used_duration", 2.61777798}},
                             {{"planner", "<b>"}, {"duration", nullptr}, {"centred", true}}};
  EXPECT_EQ(shown_value(rows),
            "planner filter, reason slower, used duration 2.61778<br>planner &lt;b&gt;, duration –, centred yes");
  EXPECT_EQ(shown_value(3), "3");
  EXPECT_EQ(shown_value(ordered_json::array()), "");
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

TEST(ResultHtml, TheFirstLineHasVerdictDurationAndGap) {
  const ordered_json result = {{"kind", "contour"},
                               {"summary", {{"duration", 3.3148}}},
                               {"bound", {{"duration", 3.3}, {"gap", 0.0045}}},
                               {"verification", {{"passed", true}, {"checks", ordered_json::array()}}}};
  const std::string line = verdict_line(result);
  EXPECT_TRUE(has(line, ">verified<")) << line;
  EXPECT_TRUE(has(line, "contour")) << line;
  EXPECT_TRUE(has(line, "3.315 s")) << line;
  EXPECT_TRUE(has(line, "0.45 %")) << line;
}

TEST(ResultHtml, TheFirstLineNamesTheChecksThatFailed) {
  const ordered_json result = {
      {"verification",
       {{"passed", false}, {"checks", {check("a<b", "limit", 2, 1, false), check("held", "limit", 1, 2)}}}}};
  const std::string line = verdict_line(result);
  EXPECT_TRUE(has(line, "not verified")) << line;
  EXPECT_TRUE(has(line, "a&lt;b")) << line;
  EXPECT_FALSE(has(line, "held")) << line;
  EXPECT_EQ(verdict_line(ordered_json::object()), "");
}

TEST(ResultHtml, ThreeLimitsAreShownTheLargestFirst) {
  ordered_json list = ordered_json::array();
  for (const auto& [name, share] : {std::pair{"dwell", 0.0}, {"x", 0.1}, {"feed", 0.5}, {"<y>", 0.3}, {"z", 0.05}})
    list.push_back({{"name", name}, {"unit", "mm/s"}, {"value", 10}, {"time", share}, {"share", share}});
  const std::string text = largest_limits({{"limits", list}});
  EXPECT_LT(text.find("feed"), text.find("&lt;y&gt;"));
  EXPECT_LT(text.find("&lt;y&gt;"), text.find("<td>x<"));
  EXPECT_TRUE(has(text, "value=\"0.5000\"")) << text;
  EXPECT_TRUE(has(text, "10 mm/s")) << text;
  EXPECT_FALSE(has(text, "<td>z<")) << text;
  EXPECT_EQ(count(text, "<meter"), 3U);
  EXPECT_EQ(largest_limits({{"limits", ordered_json::array()}}), "");
}

TEST(ResultHtml, SlowestLinesAreShownWithTheirTextAndLimit) {
  const ordered_json blocks = {
      {"by", "line"},
      {"lost", {{"to_feed", 1.5}, {"to_axes", 0.25}}},
      {"blocks",
       {{{"line", 7},
         {"text", "G1 <X>"},
         {"time", 2.0},
         {"lost", 1.25},
         {"limit", "acceleration x"},
         {"limit_share", 0.8}},
        {{"line", 9}, {"text", nullptr}, {"time", 1.0}, {"lost", 0.0}, {"limit", nullptr}, {"limit_share", 0.0}}}}};
  const std::string text = slowest_blocks(blocks);
  for (const char* part : {"Slowest lines", "1.500 s", "0.250 s", "G1 &lt;X&gt;", "2.000 s", "1.250 s",
                           "acceleration x 80 %", "<td class=\"n\">7</td>"})
    EXPECT_TRUE(has(text, part)) << part << "\n" << text;
  EXPECT_EQ(slowest_blocks({{"by", "block"}, {"blocks", ordered_json::array()}}), "");
}

TEST(ResultHtml, ExactnessIsFoldedAndLimitsAndFailedChecksAreNot) {
  const ordered_json verdict = {{"passed", false},
                                {"checks",
                                 {check("deviation", "geometry", 0.2, 1), check("chord", "geometry", 0.5, 1),
                                  check("velocity x", "limit", 75, 100), check("rest", "continuity", 3, 0, false)}}};
  const std::string text = verification(verdict);
  const std::size_t fold = text.find("<details>");
  EXPECT_TRUE(has(text, "Verification: failed"));
  EXPECT_LT(text.find("<td>rest</td>"), text.find("<td>velocity x</td>"));
  EXPECT_LT(text.find("<td>velocity x</td>"), fold);
  EXPECT_LT(fold, text.find("<td>deviation</td>"));
  EXPECT_TRUE(has(text, "geometry: 2 checks passed, largest use 50 % (chord)")) << text;
  EXPECT_TRUE(has(text, "value=\"0.7500\"")) << text;
  EXPECT_EQ(count(text, "<details"), 1U) << "a group without a check that passed has nothing to fold";
}

TEST(ResultHtml, ALeastPermittedValueIsUsedTheLessTheLargerTheValueIs) {
  const auto shown = [](double value, double limit, bool passed) {
    return verification({{"passed", passed}, {"checks", {check("clearance", "limit", value, limit, passed)}}});
  };
  EXPECT_TRUE(has(shown(4, 1, true), "value=\"0.2500\""));
  EXPECT_TRUE(has(shown(1, 4, false), "optimum=\"0\" value=\"4.0000\"></meter> 400 %"));
  EXPECT_TRUE(has(shown(0, 4, true), "0 %"));
  EXPECT_FALSE(has(shown(4, 0, true), "<meter")) << "a limit of 0 has no share";
}

TEST(ResultHtml, MissingAndInfiniteFiguresAreNoFault) {
  EXPECT_EQ(verification(ordered_json()), "");
  EXPECT_EQ(figures(ordered_json(), "contour", "summary"), "");
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(has(verification({{"passed", true}, {"checks", {check("a", "limit", 1, infinite)}}}), "<td>a</td>"));
  EXPECT_TRUE(has(verification({{"passed", true}, {"checks", {{{"name", "old"}, {"passed", true}}}}}), "old"));
}

}  // namespace
}  // namespace bahnwerk::server
