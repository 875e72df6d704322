#pragma once
/// Every result that a test plans is held against the schema of its kind's results.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "api/kind.hpp"
#include "api/planned_job.hpp"
#include "api/schema/schema.hpp"

namespace bahnwerk::api::test {

/// "velocity x" → "velocity", "jerk q3" → "jerk", "overlap with the boundary needle, head_top" → "overlap with the
/// boundary": what the schema's description of a check's name has to contain.
inline std::string check_stem(std::string name) {
  for (const char* end : {" (feed ", " orthocyclic_", " raabe", " potential", " needle", " x", " y", " z"})
    if (const auto at = name.rfind(end); at != name.npos && (end[1] == '(' || end[2] != 0 || at + 2 == name.size()))
      name.resize(at);
  // A coarse or fine axis.
  if (const std::size_t n = name.size(); n > 3 && name[n - 3] == ' ' && (name[n - 1] == 'c' || name[n - 1] == 'f'))
    name.resize(n - 3);
  // An axis of a machine along a contour, by its name.
  for (const char* of : {"velocity ", "acceleration ", "jerk "})
    if (name.starts_with(of) && name.find(' ') == name.rfind(' ')) name.resize(name.find(' '));
  // An axis of a winding machine.
  if (const std::size_t n = name.size(); n > 3 && name.compare(n - 3, 2, " q") == 0) name.resize(n - 3);
  return name;
}

/// The faults of a result document as clients get it, checks included that the schema does not name.
inline std::vector<std::string> result_faults(const nlohmann::ordered_json& result) {
  static std::map<std::string, Schema> schemas;
  const auto document = nlohmann::json::parse(result.dump());  // what is not finite becomes null, as on the wire
  const std::string name = document.value("kind", "");
  const Kind* kind = find_kind(name);
  if (!kind) return {"no kind " + name};
  auto schema = schemas.find(name);
  if (schema == schemas.end()) schema = schemas.emplace(name, Schema(kind->result_schema)).first;
  std::vector<std::string> faults;
  for (const auto& error : schema->second.validate(document)) faults.push_back(error.pointer + " " + error.message);
  if (!faults.empty()) return faults;
  const auto text = nlohmann::json::parse(kind->result_schema);
  const std::string names = text["$defs"]["check"]["properties"]["name"]["description"];
  for (const auto& check : document["verification"]["checks"])
    if (const auto stem = check_stem(check["name"]); names.find(stem) == names.npos)
      faults.push_back("the schema does not name the check " + stem);
  return faults;
}

inline PlannedJob checked(PlannedJob job) {
  const auto faults = result_faults(job.result);
  EXPECT_EQ(faults, std::vector<std::string>{});
  if (job.setpoints) {
    EXPECT_EQ(job.result["setpoints"]["columns"].size(), job.setpoints->columns().size());
    EXPECT_EQ(job.result["setpoints"]["count"], job.setpoints->count());
  } else {
    EXPECT_FALSE(job.result.contains("setpoints"));
  }
  return job;
}

}  // namespace bahnwerk::api::test
