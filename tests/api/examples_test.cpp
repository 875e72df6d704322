// The documents under schemas/examples and examples: what has to be accepted, and what refused at which pointer.
#include "api/documents/examples.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "api/documents/job.hpp"
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

TEST(Examples, AreInTheProgramAsTheyAreInTheTree) {
  std::set<std::string> names;
  for (const Example& example : examples()) {
    EXPECT_TRUE(names.insert(example.name).second) << example.name;
    EXPECT_FALSE(test::refusal(example.text)) << example.name;
    EXPECT_FALSE(example.title.empty());
  }
  for (const char* folder : {"examples", "examples/feeds", "examples/parts"})
    for (const auto& file : test::json_files(folder)) {
      const std::string name = std::filesystem::path(file).stem().string();
      const auto at = std::find_if(examples().begin(), examples().end(), [&](const auto& e) { return e.name == name; });
      ASSERT_NE(at, examples().end()) << name;
      EXPECT_EQ(at->text, test::read_file(file));
    }
  for (const char* program : {"sheet.ngc", "thread.ngc", "gear.dxf"}) EXPECT_TRUE(names.contains(program));
  for (const auto& kind : kinds())
    EXPECT_TRUE(std::any_of(examples().begin(), examples().end(), [&](const auto& e) { return e.kind == kind.name; }));
}

TEST(Machines, ShippedOnesAreMachinesAndOthersAreRefused) {
  std::map<std::string, std::string> kind_of;
  for (const MachineFile& machine : shipped_machines()) kind_of[machine.name] = machine.kind + " " + machine.type;
  EXPECT_EQ(kind_of["vertical"], "winding vertical");
  EXPECT_EQ(kind_of["md2"], "contour coarse_fine");
  EXPECT_EQ(kind_of["mill"], "contour cartesian");
  for (const char* text : {"{}", "[]", "7", R"({"type": "robot"})", R"({"kinematics": "cartesian", "axes": {}})", "{"})
    EXPECT_THROW(read_machine("x", text), Problem) << text;
}

TEST(CheckJob, TellsWhatCanBeSaidBeforePlanning) {
  const auto contour = preview_job(test::read_file(test::source("examples/bracket.json")));
  EXPECT_EQ(contour["kind"], "contour");
  EXPECT_EQ(contour["checked"], true);
  EXPECT_GT(contour["estimate"]["duration"], 0);
  EXPECT_LE(contour["outline"]["vertices"].size(), 5000U);
  EXPECT_EQ(contour["outline"]["vertices"].size(), contour["outline"]["cut"].size());
  const auto probe = preview_job(test::read_file(test::source("examples/probe_space.json")));
  EXPECT_EQ(probe["outline"]["vertices"].size(), 6U);
  EXPECT_NEAR(probe["estimate"]["path_length"].get<double>(), 57.6, 1);
  const auto slot = preview_job(test::read_file(test::source("examples/rotor_slot.json")));
  EXPECT_TRUE(slot["estimate"].is_null() && slot["outline"].is_null());
  EXPECT_THROW(preview_job("{}"), Problem);
}

TEST(CheckJob, FaultsOfProgramsHaveTheirLine) {
  auto document = test::read_json(test::source("examples/parts/laser.json"));
  document["spec"]["contour"] = {{"gcode", "G1 X10 F100\nG1 X20 Q\n"}};
  const auto problem = test::refusal(document.dump());
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->document()["errors"][0]["line"], 2);
  document["spec"]["contour"] = {{"points", {{0, 0}, {0, 0}}}};
  const auto other = test::refusal(document.dump());
  ASSERT_TRUE(other);
  EXPECT_FALSE(other->document()["errors"][0].contains("line"));
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
