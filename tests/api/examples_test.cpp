// The documents under schemas/examples and examples: what has to be accepted, and what refused at which pointer.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "api/kind.hpp"
#include "tests/api/documents.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;

/// Checks every case of a file of faulty documents, specs of a kind or whole jobs; returns how many there were.
std::size_t check_cases(const std::string& file, const std::string& folder, std::string_view kind = {}) {
  const json cases = test::read_json(file);
  for (const auto& each : cases) {
    SCOPED_TRACE(std::filesystem::path(file).filename().string() + ": " + each["why"].get<std::string>());
    json document = test::read_json(test::source(folder + "/" + each.value("of", "complete.json")));
    document.patch_inplace(each["patch"]);
    const auto problem = test::refusal((kind.empty() ? document : test::job_with_spec(kind, document)).dump());
    if (!problem) {
      ADD_FAILURE() << "accepted";
      continue;
    }
    EXPECT_EQ(problem->type().slug, each["slug"].get<std::string>()) << problem->document().dump(1);
    const auto pointers = test::pointers(*problem);
    for (const std::string expected : each["pointers"])
      EXPECT_THAT(pointers, testing::Contains(expected)) << problem->document().dump(1);
    if (each["slug"] == "schema-violation") {
      EXPECT_EQ(pointers.size(), each["pointers"].size())
          << "noise beside what matters: " << problem->document().dump(1);
    }
    for (const auto& error : problem->errors()) {
      EXPECT_GT(error.message.size(), 8u);
      EXPECT_NE(error.message, "does not follow the schema") << "no rule was named";
    }
  }
  return cases.size();
}

TEST(Examples, AreAcceptedForEveryKind) {
  for (const auto& kind : kinds()) {
    const auto files = test::json_files("schemas/examples/" + std::string(kind.name));
    EXPECT_FALSE(files.empty()) << kind.name;
    for (const auto& file : files) {
      const auto problem = test::refusal(test::job_with_spec(kind.name, test::read_json(file)).dump());
      EXPECT_FALSE(problem) << file << problem->document().dump(1);
    }
  }
  for (const char* folder : {"schemas/examples/job", "examples", "examples/parts"})
    for (const auto& file : test::json_files(folder)) {
      const auto problem = test::refusal(test::read_file(file));
      EXPECT_FALSE(problem) << file << problem->document().dump(1);
    }
}

TEST(Examples, FaultyDocumentsAreRefusedAtTheRightPlace) {
  std::size_t count = 0;
  for (const auto& kind : kinds()) {
    const std::string folder = "schemas/examples/" + std::string(kind.name);
    for (const auto& file : test::json_files(folder + "/invalid")) count += check_cases(file, folder, kind.name);
  }
  for (const auto& file : test::json_files("schemas/examples/job/invalid"))
    count += check_cases(file, "schemas/examples/job");
  EXPECT_GE(count, 40u);
}

}  // namespace
}  // namespace bahnwerk::api
