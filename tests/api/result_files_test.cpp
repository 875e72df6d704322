/// Files that kinds make of their results: found by layout, refused for results of other kinds.
#include "api/result_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "api/kind.hpp"
#include "api/planned_job.hpp"
#include "api/problem.hpp"
#include "core/base/progress.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;
using Pointers = std::vector<std::string>;

Pointers faults(const json& result, std::string_view layout) {
  try {
    result_file(result, layout);
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.type().slug, "schema-violation");
    return test::pointers(problem);
  }
  return {};
}

TEST(ResultFiles, EveryLayoutBelongsToOneKind) {
  const std::vector<std::string> all = result_layouts();
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size());
  for (const std::string& layout : all) {
    const Kind* const kind = kind_of_layout(layout);
    ASSERT_NE(kind, nullptr) << layout;
    EXPECT_THAT(kind->files.layouts, testing::Contains(layout));
    EXPECT_FALSE(kind->files.title.empty());
    EXPECT_THAT(result_layouts_text(), testing::HasSubstr(layout));
  }
  EXPECT_EQ(kind_of_layout(""), nullptr);
  EXPECT_EQ(kind_of_layout("plain"), nullptr);
}

TEST(ResultFiles, LayoutsOfOtherKindsAreRefused) {
  for (const Kind& kind : kinds())
    for (const std::string& layout : result_layouts()) {
      if (kind_of_layout(layout) == &kind) continue;
      EXPECT_EQ(faults({{"kind", kind.name}}, layout), Pointers{"/query/layout"}) << kind.name << ", " << layout;
    }
  EXPECT_EQ(faults({{"kind", "motion_law"}}, "punched_tape"), Pointers{"/query/layout"});
  EXPECT_EQ(faults(json::object(), "isg"), Pointers{"/query/layout"});
}

TEST(ResultFiles, TheKindMakesItsFile) {
  const json spec = test::read_json(test::source("schemas/examples/motion_law/minimal.json"));
  const json job = {{"kind", "motion_law"}, {"spec", spec}};
  Progress silent;
  const json result = json::parse(plan_job("motion_law", job.dump(), silent).result.dump());
  for (const std::string_view layout : find_kind("motion_law")->files.layouts) {
    const ResultFile file = result_file(result, layout);
    EXPECT_FALSE(file.text.empty()) << layout;
    EXPECT_THAT(file.extension, testing::AnyOf("csv", "txt", "st")) << layout;
    EXPECT_THAT(file.difference, testing::StartsWith("differs from the law by position ")) << layout;
    EXPECT_EQ(file.header, "X-Refit-Error");
    EXPECT_THAT(file.header_value, testing::StartsWith("position ")) << layout;
  }
}

}  // namespace
}  // namespace bahnwerk::api
