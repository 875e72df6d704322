#pragma once
/// Descriptor of a kind of job, and the list of kinds. A new kind takes its core folder, its folder in api/kinds, its
/// schemas with examples, its line in kinds.cpp and its tests.
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "api/result_files.hpp"
#include "api/scene.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk::api {
struct PlannedJob;  // api/planned_job.hpp
struct ViewFacts;   // api/views/view_facts.hpp

/// The files that a kind makes of a stored result, in layouts of its own.
struct ResultFiles {
  std::string_view title = {};                     ///< name of such a file for people, such as "cam table"
  std::span<const std::string_view> layouts = {};  ///< names of the layouts; each belongs to one kind only
  /// Sentence for the API's description, such as "Header X-… says by how much the file differs."; may be empty.
  std::string_view about = {};
  /// Returns the file of a result of this kind in one of `layouts`; `name` is the job's, may be empty.
  ResultFile (*make)(const nlohmann::json& result, std::string_view layout, std::string_view name) = nullptr;
};

/// How long the plan of a spec is expected to take.
struct PlanningTime {
  double seconds = 0;   ///< time of one processor
  std::string pointer;  ///< member of the document that determines it, such as /spec/effort
  std::string change;   ///< what makes it shorter, a sentence
};

struct Kind {
  std::string_view name;
  std::string_view title;
  std::string_view schema;  ///< the schema's JSON text, embedded at build time; served as /v1/schemas/<name>
  std::string_view
      result_schema;  ///< JSON text of the schema that every result satisfies; served as /v1/schemas/<name>.result
  /// Checks a spec that passed the schema; throws Problem "semantic-violation" naming every fault, and Stopped. Returns
  /// the expected planning time, if the kind can tell.
  std::optional<PlanningTime> (*check)(const nlohmann::json& spec, Progress progress);
  /// Checks like `check` and returns what can be said of the plan before it is made: `notes`, `estimate` and `outline`
  /// of the answer to POST /v1/check.
  nlohmann::ordered_json (*preview)(const nlohmann::json& spec, Progress progress);
  /// Plans a spec. Equal specs and versions give identical results. Throws core's errors; never returns an unverified
  /// plan as verified.
  PlannedJob (*plan)(const nlohmann::json& spec, Progress progress);
  /// Returns what the views of setpoints need of a spec that was planned (api/views/view_facts.hpp); nullptr where
  /// the kind has no setpoints.
  std::shared_ptr<const ViewFacts> (*view_facts)(const nlohmann::json& spec, Progress progress) = nullptr;
  /// Returns the bodies of a spec that was planned, with members of its result (scene_parts); nullopt where a spec has
  /// no scene. nullptr where the kind has none. Some ms; throws what reading the spec throws.
  std::optional<Scene> (*scene)(const nlohmann::json& spec, const nlohmann::json& result, Progress progress) = nullptr;
  std::span<const std::string_view> scene_parts = {};  ///< members of the result that `scene` reads, such as a.b
  ResultFiles files = {};                              ///< empty if the kind has no layouts of its own
};

std::span<const Kind> kinds();
const Kind* find_kind(std::string_view name);  ///< returns nullptr for an unknown name

}  // namespace bahnwerk::api
