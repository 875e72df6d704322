/// The figures that README.md prints are those of this version: an answer copied from it can be compared.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "api/documents/job.hpp"
#include "core/base/progress.hpp"
#include "tests/api/documents.hpp"
#include "tests/support/planned.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;

constexpr double rounding = 1e-9;  // relative: another compiler may add in another order

PlannedJob planned(const std::string& example) {
  return test::planned_document(test::read_file(test::source("examples/" + example + ".json")));
}

const std::string& readme() {
  static const std::string text = test::read_file(test::source("README.md"));
  return text;
}

/// What follows `mark` in README.md, up to `end`.
std::string after(const std::string& mark, const std::string& end) {
  const std::size_t at = readme().find(mark);
  if (at == std::string::npos) throw std::runtime_error("README.md does not contain " + mark);
  const std::size_t from = at + mark.size();
  return readme().substr(from, readme().find(end, from) - from);
}

/// The numbers of a text in their order; "0.5 / 2.9 %" holds two.
std::vector<double> numbers(const std::string& text) {
  static const std::regex number(R"(-?\d+(\.\d+)?(e-?\d+)?)");
  std::vector<double> list;
  for (std::sregex_iterator at(text.begin(), text.end(), number), end; at != end; ++at)
    list.push_back(std::stod(at->str()));
  return list;
}

void expect_close(double printed, double value, const std::string& what) {
  EXPECT_NEAR(printed, value, rounding * std::max(1.0, std::abs(value))) << what;
}

TEST(Readme, TheResultOfTheBracket) {
  const json printed = json::parse(after("checks: (.verification.checks | length)}'\n", "\n$ "));
  const PlannedJob job = planned("bracket");
  const auto& result = job.result;
  for (const auto& [name, value] : printed["summary"].items()) expect_close(value, result["summary"][name], name);
  EXPECT_EQ(printed["summary"].size(), result["summary"].size());
  expect_close(printed["bound"]["duration"], result["bound"]["duration"], "bound");
  EXPECT_NEAR(printed["bound"]["gap"], result["bound"]["gap"].get<double>(), rounding);
  EXPECT_EQ(printed["bound"]["basis"], json(result["bound"]["basis"]));
  EXPECT_EQ(printed["verified"], true);
  EXPECT_EQ(printed["checks"], result["verification"]["checks"].size());

  const json check = json::parse(after("jq -c '.verification.checks[2]'\n", "\n"));
  const auto& found = result["verification"]["checks"][2];
  for (const char* name : {"name", "unit", "passed"}) EXPECT_EQ(check[name], json(found[name])) << name;
  for (const char* name : {"limit", "value", "at"}) expect_close(check[name], found[name], name);

  std::istringstream rows(after("columns=x,y,vx,vy,mode,block\"\nx,y,vx,vy,mode,block\n", "```"));
  const auto& columns = job.setpoints->columns();
  std::vector<double> row(columns.size());
  std::size_t k = 1000;
  for (std::string line; std::getline(rows, line); ++k) {
    job.setpoints->read(k, 1, row.data());
    const auto shown = numbers(line);
    std::size_t i = 0;
    for (const char* name : {"x", "y", "vx", "vy", "mode", "block"}) {
      const auto column =
          std::find_if(columns.begin(), columns.end(), [&](const Column& each) { return each.name == name; });
      expect_close(shown.at(i++), row[static_cast<std::size_t>(column - columns.begin())], name);
    }
  }
  EXPECT_EQ(k, 1003U);
}

TEST(Readme, TheLineTakesWhatTheClosedFormSays) {
  const double printed = numbers(after("| 100 mm line at 1800 mm/s, 16 000 mm/s² | ", " s,")).at(0);
  EXPECT_NEAR(printed, 2 * std::sqrt(100.0 / 16000), 1e-14);
  EXPECT_NEAR(planned("line").result["summary"]["duration"].get<double>(), 2 * std::sqrt(100.0 / 16000), 1e-12);
}

TEST(Readme, TheGapsOfTheFiveExamples) {
  const auto range = numbers(after("| gap of the five examples (`time_optimal`) | ", " |"));
  ASSERT_EQ(range.size(), 2U);
  double least = 1, most = 0;
  for (const char* name : {"bracket", "circle", "helix", "line", "polyline"}) {
    const double gap = planned(name).result["bound"]["gap"];
    least = std::min(least, gap), most = std::max(most, gap);
  }
  EXPECT_LE(most, range[1] * 1.1);
  EXPECT_GE(most, range[1] / 2);
  EXPECT_LE(least, range[0] * 2);
}

}  // namespace
}  // namespace bahnwerk::api
