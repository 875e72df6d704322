#pragma once
/// A kind of job is one descriptor in one list. Adding one: its core folder, its folder in api/kinds, its schemas with
/// examples, its line in kinds.cpp, its tests. Nothing else.
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
  std::string_view schema;         ///< the schema's JSON text, embedded at build time; served as /v1/schemas/<name>
  std::string_view result_schema;  ///< every result keeps it; served as /v1/schemas/<name>.result
  /// Semantic checks of a spec that passed the schema; throws Problem "semantic-violation" naming every fault.
  void (*check)(const nlohmann::json& spec);
  /// Plans. Deterministic: same spec and version, same bits. Throws core's errors; never returns an unverified plan as
  /// verified.
  PlannedJob (*plan)(const nlohmann::json& spec, Progress& progress);
};

std::span<const Kind> kinds();
const Kind* find_kind(std::string_view name);  ///< nullptr when unknown

}  // namespace bahnwerk::api
