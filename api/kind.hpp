#pragma once
/// Descriptor of a kind of job, and the list of kinds. A new kind takes its core folder, its folder in api/kinds, its
/// schemas with examples, its line in kinds.cpp and its tests.
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>

namespace bahnwerk {
class Progress;
}

namespace bahnwerk::api {
struct PlannedJob;  // api/planned_job.hpp

struct Kind {
  std::string_view name;
  std::string_view title;
  std::string_view schema;  ///< the schema's JSON text, embedded at build time; served as /v1/schemas/<name>
  std::string_view
      result_schema;  ///< JSON text of the schema that every result satisfies; served as /v1/schemas/<name>.result
  /// Checks a spec that passed the schema; throws Problem "semantic-violation" naming every fault.
  void (*check)(const nlohmann::json& spec);
  /// Plans a spec. Equal specs and versions give identical results. Throws core's errors; never returns an unverified
  /// plan as verified.
  PlannedJob (*plan)(const nlohmann::json& spec, Progress& progress);
};

std::span<const Kind> kinds();
const Kind* find_kind(std::string_view name);  ///< returns nullptr for an unknown name

}  // namespace bahnwerk::api
