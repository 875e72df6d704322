#pragma once
/// The procedure that all kinds share: read, check, plan and report a document. A kind is a type K with the static
/// members
///
///   name, title                                     string constants
///   Request read(const json& spec, Progress)       the spec in core's terms; throws InvalidInput naming every fault
///   Plan plan(Request&, Progress)                  throws core's errors
///   KindReport report(const Request&, Plan&, Progress)
///
/// and, if something can be said of a plan before it is made,
///
///   ordered_json preview(const Request&, Progress)   any of the members `notes`, `estimate`, `outline`
///
/// and, if some faults of a document require computation, check(const Request&), which throws InvalidInput when the
/// document is submitted; if the kind knows how long its plans take, expected_time(const Request&); if it has
/// setpoints, view_facts(const Request&), which returns the ViewFacts of a series, and document_segments(const
/// Request&, Progress) for ViewFacts::document; if it has a scene, scene(const
/// Request&, const json& result, Progress), which returns it with the members `scene_parts` of a result, and
/// has_scene(const json& spec) where not every spec has one; and if it makes files of a result,
/// `ResultFiles files`. The file api/kinds/<name>/<name>.cpp contains `Kind describe_<name>() { return kind_of<K>();
/// }`, and api/kinds.cpp lists it.
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "api/kind.hpp"
#include "api/planned_job.hpp"
#include "api/problem.hpp"
#include "api/schema/embedded.hpp"
#include "api/views/view_facts.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"

namespace bahnwerk::api {

/// A kind's report on its plan.
struct KindReport {
  nlohmann::ordered_json summary;
  nlohmann::ordered_json verification;  ///< result of api/verification.hpp, possibly extended by the kind
  nlohmann::ordered_json bound;         ///< value, gap and basis, as api/verification.hpp writes them
  nlohmann::ordered_json details;
  nlohmann::ordered_json drawings = nullptr;               ///< SVG and DXF texts by file name; null: none
  std::unique_ptr<SetpointSource> setpoints = nullptr;     ///< nullptr if the kind has none
  std::shared_ptr<const SegmentTable> segments = nullptr;  ///< what is driven when; nullptr if the kind has none
};

/// Returns the result document with its setpoints; the plan is verified if `verification.passed` is true.
PlannedJob planned_job(std::string_view kind, KindReport report);

template <class K>
/// Returns the request of a spec, checked.
auto checked_request(const nlohmann::json& spec, Progress progress) {
  try {
    auto request = K::read(spec, progress);
    if constexpr (requires { K::check(request); }) K::check(request);
    return request;
  } catch (const InvalidInput&) {
    throw problem_from_current_exception("/spec");
  }
}

template <class K>
/// Implements Kind::check.
std::optional<PlanningTime> check_spec(const nlohmann::json& spec, Progress progress) {
  const auto request = checked_request<K>(spec, progress);
  if constexpr (requires { K::expected_time(request); }) return K::expected_time(request);
  return std::nullopt;
}

template <class K>
/// Implements Kind::preview.
nlohmann::ordered_json preview_spec(const nlohmann::json& spec, Progress progress) {
  const auto request = checked_request<K>(spec, progress);
  nlohmann::ordered_json preview{
      {"notes", nlohmann::ordered_json::array()}, {"estimate", nullptr}, {"outline", nullptr}};
  if constexpr (requires { K::preview(request, progress); }) preview.update(K::preview(request, progress));
  return preview;
}

template <class K>
concept HasViewFacts = requires(const nlohmann::json& spec, Progress progress) {
  K::view_facts(K::read(spec, progress));
};

template <class K>
/// Implements Kind::plan.
PlannedJob plan_spec(const nlohmann::json& spec, Progress progress) {
  progress.report("read", 0.0);
  auto request = K::read(spec, progress);
  auto facts = std::make_shared<ViewFacts>();
  if constexpr (HasViewFacts<K>) *facts = K::view_facts(request);  // first: a plan may take its request apart
  auto plan = K::plan(request, progress);
  KindReport report = K::report(request, plan, progress);
  facts->segments = std::move(report.segments);
  PlannedJob job = planned_job(K::name, std::move(report));
  job.view_facts = std::move(facts);
  return job;
}

template <class K>
/// Implements Kind::view_facts.
std::shared_ptr<const ViewFacts> view_facts_of_spec(const nlohmann::json& spec, Progress progress) {
  const auto request = K::read(spec, progress);
  auto facts = std::make_shared<ViewFacts>(K::view_facts(request));
  if constexpr (requires { K::document_segments(request, progress); })
    facts->document = K::document_segments(request, progress);
  return facts;
}

/// Implements Kind::scene.
template <class K>
std::optional<Scene> scene_of_spec(const nlohmann::json& spec, const nlohmann::json& result, Progress progress) {
  if constexpr (requires { K::has_scene(spec); })
    if (!K::has_scene(spec)) return std::nullopt;
  return K::scene(K::read(spec, progress), result, progress);
}

template <class K>
Kind kind_of() {
  Kind kind{K::name,       K::title,        embedded(K::name), embedded(std::string(K::name) + ".result"),
            check_spec<K>, preview_spec<K>, plan_spec<K>};
  if constexpr (HasViewFacts<K>) kind.view_facts = view_facts_of_spec<K>;
  if constexpr (requires { K::scene_parts; }) kind.scene = scene_of_spec<K>, kind.scene_parts = K::scene_parts;
  if constexpr (requires { K::files; }) kind.files = K::files;
  return kind;
}

}  // namespace bahnwerk::api
