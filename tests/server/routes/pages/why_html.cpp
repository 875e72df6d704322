#include "server/routes/pages/why_html.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace bahnwerk::server {
namespace {

using nlohmann::ordered_json;

bool has(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

const Texts english(Language::en), german(Language::de);

ordered_json some_limits() {
  ordered_json list = ordered_json::array();
  int id = 0;
  for (const auto& [name, share] :
       {std::pair{"dwell", 0.0}, {"x", 0.13}, {"feed", 0.48}, {"acceleration <y>", 0.38}, {"z", 0.01}})
    list.push_back({{"id", id++}, {"name", name}, {"unit", "mm/s"}, {"value", 10}, {"time", share}, {"share", share}});
  return {{"limits", list}};
}

ordered_json some_result(bool passed = true) {
  return {{"kind", "contour"},
          {"summary", {{"duration", 152.973}}},
          {"verification",
           {{"passed", passed},
            {"checks", {{{"name", "a<b"}, {"passed", passed}}, {{"name", "held"}, {"passed", true}}}}}}};
}

TEST(WhyHtml, TheFirstLineSaysHowLongHowGoodAndWhy) {
  Reasons reasons;
  reasons.limits = some_limits();
  reasons.blocks = {{"lost", {{"to_feed", 12.2}, {"to_axes", 1.0}}}};
  reasons.feed_time = 89.0;
  const std::string line = verdict_line(some_result(), reasons, english);
  for (const char* part :
       {"data-verdict", ">152.97 s<", "state succeeded\">good<", "Feed 48 %, acceleration &lt;y&gt; 38 %, x 13 %.",
        "At the programmed feed the cuts take 89.00 s; 12.200 s more are lost in corners."})
    EXPECT_TRUE(has(line, part)) << part << "\n" << line;
  EXPECT_FALSE(has(line, "dwell")) << line;
  const std::string german_line = verdict_line(some_result(), reasons, german);
  EXPECT_TRUE(has(german_line, "152,97 s")) << german_line;
  EXPECT_TRUE(has(german_line, "Vorschub 48 %, Beschleunigung &lt;y&gt; 38 %")) << german_line;
}

TEST(WhyHtml, TheFirstLineIsThereWithoutViews) {
  const std::string line = verdict_line(some_result(), {}, english);
  EXPECT_TRUE(has(line, "152.97 s")) << line;
  EXPECT_FALSE(has(line, "feed")) << line;
  EXPECT_EQ(verdict_line(ordered_json::object(), {}, english), "");
  EXPECT_TRUE(
      has(verdict_line({{"summary", {{"count", 57}}}, {"verification", {{"passed", true}}}}, {}, english), "57 wires"));
  EXPECT_TRUE(
      has(verdict_line({{"summary", {{"cycle_duration", 0.5}}}, {"verification", {{"passed", true}}}}, {}, english),
          "0.500 s"));
}

TEST(WhyHtml, TheFirstLineNamesTheChecksThatFailed) {
  const std::string line = verdict_line(some_result(false), {}, english);
  EXPECT_TRUE(has(line, "state failed\">not good<")) << line;
  EXPECT_TRUE(has(line, "Failed: a&lt;b.")) << line;
  EXPECT_FALSE(has(line, "held")) << line;
}

TEST(WhyHtml, LimitsComeByTheirShares) {
  const std::string text = limits_table(some_limits(), english);
  EXPECT_LT(text.find(">feed</th>"), text.find(">acceleration &lt;y&gt;</th>"));
  EXPECT_LT(text.find(">acceleration &lt;y&gt;</th>"), text.find(">x</th>"));
  EXPECT_TRUE(has(text, "<tr data-limit=\"2\">")) << text;
  EXPECT_TRUE(has(text, "value=\"0.4800\"")) << text;
  EXPECT_TRUE(has(text, "10 mm/s")) << text;
  EXPECT_FALSE(has(text, ">dwell</th>")) << "no time belongs to it";
  EXPECT_EQ(limits_table({{"limits", ordered_json::array()}}, english), "");
  EXPECT_EQ(limits_table({{"limits", {{{"id", 1}, {"name", "stop"}, {"unit", nullptr}, {"share", 1.0}}}}}, english), "")
      << "no limit is declared";
}

TEST(WhyHtml, SlowestLinesHaveTheirTextLimitAndRows) {
  const ordered_json blocks = {
      {"by", "line"},
      {"lost", {{"to_feed", 1.5}, {"to_axes", 0.25}}},
      {"blocks",
       {{{"line", 7},
         {"text", "G1 <X>"},
         {"start_time", 4.0},
         {"visits", 2},
         {"time", 2.0},
         {"lost", 1.25},
         {"limit", "acceleration x"},
         {"limit_share", 0.8}},
        {{"line", 9}, {"text", nullptr}, {"time", 1.0}, {"lost", 0.0}, {"limit", nullptr}, {"limit_share", 0.0}}}}};
  const std::string text = slowest_blocks(blocks, 0.001, english);
  for (const char* part :
       {"Slowest lines", "1.500 s", "0.250 s", "G1 &lt;X&gt;", "2.000 s", "1.250 s", "acceleration x 80 %",
        "<tr data-first=\"4000\" data-count=\"1002\"><th scope=\"row\" class=\"n\">7</th>"})
    EXPECT_TRUE(has(text, part)) << part << "\n" << text;
  EXPECT_EQ(slowest_blocks({{"by", "block"}, {"blocks", ordered_json::array()}}, 0.001, english), "");
  EXPECT_TRUE(has(
      slowest_blocks({{"by", "block"}, {"blocks", {{{"block", 3}, {"mode", "cut"}, {"time", 1.0}}}}}, 0.001, german),
      "Schnitt"));
}

TEST(WhyHtml, TheWorstSectionIsASentence) {
  const ordered_json details = {{"sections", {{"worst", {{"line", 17}, {"time", 1.25}, {"gap", 0.034}}}}}};
  EXPECT_EQ(worst_section(details, english),
            "<p>Between two rests the motion is farthest from its bound from line 17 on: 1.250 s, at most 3.4 % longer "
            "than necessary.</p>\n");
  EXPECT_TRUE(has(worst_section(details, german), "Zeile 17")) << worst_section(details, german);
  EXPECT_EQ(worst_section({{"sections", {{"worst", nullptr}}}}, english), "");
  EXPECT_EQ(worst_section({{"sections", ordered_json::array()}}, english), "") << "a law's sections are others";
}

TEST(WhyHtml, WhatIfIsShownAsTimeWonOrLost) {
  const ordered_json result = {{"summary", {{"duration", 10.0}}},
                               {"details",
                                {{"what_if",
                                  {{{"limit", "tolerance"}, {"factor", 2}, {"duration", 8.0}, {"text", "…"}},
                                   {{"limit", "acceleration"}, {"factor", 0.5}, {"duration", 11.0}, {"text", "…"}},
                                   {{"limit", "jerk"}, {"factor", 2}, {"duration", nullptr}, {"text", "…"}}}}}}};
  const std::string text = what_if_bars(result, english);
  for (const char* part : {"twice the rounding tolerance", "max=\"2.0\" value=\"2.0\"", "−2.000 s", "8.000 s",
                           "half the accelerations", "value=\"1.0\"", "+1.000 s", "No plan exists with that."})
    EXPECT_TRUE(has(text, part)) << part << "\n" << text;
  EXPECT_EQ(what_if_bars({{"summary", {{"duration", 10.0}}}}, english), "");
}

}  // namespace
}  // namespace bahnwerk::server
