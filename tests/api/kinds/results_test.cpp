// Results of every kind keep the schema that is served for them: of all examples, of the part files, of random
// documents.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "api/documents/job.hpp"
#include "api/planned_job.hpp"
#include "api/problem.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "tests/api/documents.hpp"
#include "tests/support/planned.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;

PlannedJob planned(const json& document) { return test::planned_document(document.dump()); }

/// The duration of a plan, s, how many wires a slot takes, or J of a motion law: what golden.json says of the example,
/// to a thousandth. A change of it is a change of what users get, and has to be meant.
void expect_golden(const std::string& path, const PlannedJob& job) {
  static const json golden = test::read_json(test::source("tests/api/kinds/golden.json"));
  const std::string name = std::filesystem::path(path).lexically_relative(test::source("")).string();
  const auto& summary = job.result["summary"];
  const char* figure = summary.contains("duration") ? "duration" : summary.contains("count") ? "count" : "objective";
  const double value = summary[figure];
  ASSERT_TRUE(golden.contains(name)) << "tests/api/kinds/golden.json lacks \"" << name << "\": " << value;
  EXPECT_NEAR(value, golden[name].get<double>(), 1e-3 * value) << name;
}

TEST(Results, KeepSchemaAndFiguresForAllExamples) {
  for (const auto& kind : kinds())
    for (const auto& file : test::json_files("schemas/examples/" + std::string(kind.name))) {
      SCOPED_TRACE(file);
      json spec = test::read_json(file);
      if (spec.contains("robustness")) {  // every wire, each sampled 20 times, takes minutes
        spec["robustness"]["samples"] = 2;
        spec["wire_range"] = {{"least", 1.25}, {"most", 1.4}};
      }
      expect_golden(file, planned(test::job_with_spec(kind.name, spec)));
    }
  for (const auto& file : test::json_files("examples")) {
    SCOPED_TRACE(file);
    expect_golden(file, planned(test::read_json(file)));
  }
}

TEST(Results, KeepTheirSchemaForPartFiles) {
  for (const auto& entry : std::filesystem::directory_iterator(test::source("examples/parts"))) {
    const auto path = entry.path();
    SCOPED_TRACE(path.string());
    if (path.extension() == ".json") {
      expect_golden(path.string(), planned(test::read_json(path.string())));
      continue;
    }
    json job = test::read_json(
        test::source(path.stem() == "thread" ? "examples/parts/mill.json" : "examples/parts/laser.json"));
    job["spec"]["contour"] = {{path.extension() == ".dxf" ? "dxf" : "gcode", test::read_file(path.string())},
                              {"feed", 100}};
    planned(job);
  }
}

/// The documents that tests/compare plans with two binaries.
TEST(Results, KeepTheirSchemaForRandomDocuments) {
  const auto folder = std::filesystem::path(testing::TempDir()) / ("bahnwerk_results_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const std::string script = test::source("tests/compare/compare.py");
  const std::string command =
      "python3 '" + script + "' --random 100 --seed 7 --only ' ' --write '" + folder.string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::size_t count = 0, windings = 0, refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    const json document = test::read_json(entry.path().string());
    if (!name.starts_with("winding")) {
      planned(document);
      ++count;
      continue;
    }
    ++windings;
    try {
      planned(document);
    } catch (const PlanningError&) {  // some lie out of reach or do not fit
      ++refused;
    } catch (const Problem& problem) {  // or have sizes that do not fit each other, which is refused at their places
      ASSERT_FALSE(problem.errors().empty()) << problem.what();
      EXPECT_TRUE(problem.errors()[0].pointer.starts_with("/spec/")) << problem.what();
      ++refused;
    } catch (const std::exception& error) {  // a plan that is not verified, say
      ADD_FAILURE() << error.what();
    }
  }
  EXPECT_GE(count, 100u);
  EXPECT_GE(windings, 10u);
  EXPECT_LE(2 * refused, windings);
  std::filesystem::remove_all(folder);
}

TEST(Results, TheSchemaNoticesWhatIsWrong) {
  Progress progress;
  const auto request = parse_job(test::read_file(test::source("examples/line.json")));
  const auto good = plan_job(request.kind, request.document, progress).result;
  EXPECT_EQ(test::result_faults(good), std::vector<std::string>{});
  const auto faults = [&](const char* place, const nlohmann::ordered_json& value) {
    auto bad = good;
    bad[nlohmann::ordered_json::json_pointer(place)] = value;
    return test::result_faults(bad);
  };
  EXPECT_EQ(faults("/kind", "knitting").size(), 1u);
  EXPECT_EQ(faults("/summary/speed", 1).size(), 1u) << "a member that the schema does not know";
  EXPECT_EQ(faults("/summary/duration", "7").size(), 1u);
  EXPECT_EQ(faults("/verification/checks/0/value", std::nan("")).size(), 1u) << "null on the wire";
  EXPECT_EQ(faults("/verification/checks/0/name", "elegance").size(), 1u);
  EXPECT_EQ(faults("/setpoints/columns/0/name", "").size(), 1u);
  EXPECT_EQ(faults("/setpoints/columns/0/unit", "furlong").size(), 1u);
  EXPECT_EQ(faults("/details/method", "guess").size(), 1u);
  auto bad = good;
  bad.erase("bound");
  EXPECT_EQ(test::result_faults(bad).size(), 1u);
}

TEST(Results, ChecksAreKnownByTheirStem) {
  EXPECT_EQ(test::check_stem("velocity x"), "velocity");
  EXPECT_EQ(test::check_stem("jerk q3"), "jerk");
  EXPECT_EQ(test::check_stem("path velocity (feed 12.5)"), "path velocity");
  EXPECT_EQ(test::check_stem("overlap with the boundary needle, head_top"), "overlap with the boundary");
  EXPECT_EQ(test::check_stem("distance from contour"), "distance from contour");
}

}  // namespace
}  // namespace bahnwerk::api
