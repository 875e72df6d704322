#include "api/documents/job.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "api/kind.hpp"
#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "api/schema/embedded.hpp"
#include "api/schema/schema.hpp"
#include "api/text/json_range.hpp"
#include "api/text/json_text.hpp"
#include "api/text/rfc3339.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::array<std::string_view, 5> state_names{"queued", "running", "succeeded", "failed", "cancelled"};

const Schema& envelope_schema() {
  static const Schema schema(embedded("job"));
  return schema;
}

const Schema& kind_schema(const Kind& kind) {
  static const auto schemas = [] {
    std::vector<Schema> list;
    for (const auto& each : kinds()) list.emplace_back(each.schema);
    return list;
  }();
  return schemas[static_cast<std::size_t>(&kind - kinds().data())];
}

/// Tells whether a text is a URL scheme://host… with http or https, of printable ASCII without blanks, and without a
/// user, whose password everybody would see, or a fragment, which is not sent.
bool is_web_address(std::string_view uri) {
  const auto scheme = uri.find("://");
  if (scheme == uri.npos || (uri.substr(0, scheme) != "http" && uri.substr(0, scheme) != "https")) return false;
  const auto host = uri.substr(scheme + 3);
  const auto authority = host.substr(0, host.find_first_of("/?"));
  if (authority.empty() || authority.find('@') != authority.npos || uri.find('#') != uri.npos) return false;
  return std::all_of(uri.begin(), uri.end(),
                     [](char c) { return c > 0x20 && c < 0x7F && c != '"' && c != '<' && c != '>' && c != '\\'; });
}

std::optional<std::string> optional_string(const json& document, const char* key) {
  const auto at = document.find(key);
  if (at == document.end() || !at->is_string()) return std::nullopt;
  return at->get<std::string>();
}

template <class T>
ordered_json nullable(const std::optional<T>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}
ordered_json nullable_time(const std::optional<std::int64_t>& ms) {
  return ms ? ordered_json(rfc3339(*ms)) : ordered_json(nullptr);
}

bool control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

/// Checks the members of the envelope whose grammar the schema does not express.
void check_texts(const json& document, std::vector<FieldError>& errors) {
  for (const char* key : {"name", "reference"})
    if (const auto value = optional_string(document, key); value && std::any_of(value->begin(), value->end(), control))
      errors.push_back({pointer("", {key}), "must not contain control characters"});
  if (const auto value = optional_string(document, "deadline"); value && !parse_rfc3339(*value))
    errors.push_back({"/deadline", "must be an RFC 3339 time such as 2026-01-31T12:00:00Z"});
  if (const json callback = document.value("callback", json()); callback.is_object())
    if (!is_web_address(callback.at("url").get_ref<const std::string&>()))
      errors.push_back({"/callback/url", "must be an absolute http or https address, without user and fragment"});
  const json tags = document.value("tags", json::array());
  for (std::size_t k = 0; k < tags.size(); ++k) {
    const auto& tag = tags[k].get_ref<const std::string&>();
    if (std::any_of(tag.begin(), tag.end(), [](char c) { return control(c) || c == ' ' || c == ','; }))
      errors.push_back(
          {pointer("/tags", {std::to_string(k)}), "must be a word, without blanks, commas and control characters"});
  }
}

/// Throws Problem schema-violation if there are errors.
void refuse(std::vector<FieldError> errors) {
  if (errors.empty()) return;
  std::string detail = summary(errors, Schema::max_faults);
  throw Problem("schema-violation", detail, std::move(errors));
}

/// Returns the document with null in place of the secret of its callback.
std::string without_secret(std::string_view document) {
  std::string text(document);
  if (const auto secret = value_range(document, {"callback", "secret"}))
    text.replace(secret->begin, secret->end - secret->begin, "null");
  return text;
}

/// Reads and checks a whole document; `check(kind, spec, progress)` is the check of its spec.
template <class Check>
JobRequest checked_job(std::string_view body, Progress progress, const Check& check) {
  const json document = parse_json(body);
  auto errors = envelope_schema().validate(document);
  if (errors.empty()) check_texts(document, errors);

  // The spec's faults are reported even if the envelope has some.
  const Kind* kind = nullptr;
  if (document.is_object() && document.contains("kind") && document["kind"].is_string())
    kind = find_kind(document["kind"].get_ref<const std::string&>());
  if (!kind && errors.empty()) {
    std::string known;
    for (const auto& each : kinds()) known += (known.empty() ? "" : ", ") + std::string(each.name);
    const std::string message =
        in_quotes(document["kind"].get_ref<const std::string&>()) + " is not a kind of this server; known: " + known;
    throw Problem("unknown-kind", message, {{"/kind", message}});
  }
  JobRequest request;
  try {
    progress.report("read", 0);
    if (kind && document.contains("spec") && document["spec"].is_object())
      for (auto& error : kind_schema(*kind).validate(document["spec"], "/spec", progress))
        errors.push_back(std::move(error));
    progress.report("read", 0);
    if (errors.empty()) check(*kind, document["spec"], progress);
  } catch (const Stopped&) {
    request.checked = false;
  }
  refuse(std::move(errors));

  request.kind = kind->name;
  request.name = optional_string(document, "name");
  request.reference = optional_string(document, "reference");
  request.priority = document.value("priority", 0);
  if (const auto deadline = optional_string(document, "deadline")) request.deadline = parse_rfc3339(*deadline);
  if (const auto budget = document.find("time_budget"); budget != document.end() && !budget->is_null())
    request.time_budget = budget->get<double>();
  for (const auto& tag : document.value("tags", json::array()))
    if (std::find(request.tags.begin(), request.tags.end(), tag) == request.tags.end()) request.tags.push_back(tag);
  const json callback = document.value("callback", json());
  if (callback.is_object())
    request.callback = Callback{callback.at("url").get<std::string>(), optional_string(callback, "secret")};
  request.document = callback.is_object() ? without_secret(body) : std::string(body);
  return request;
}

}  // namespace

std::string_view to_string(JobState state) { return state_names[static_cast<std::size_t>(state)]; }

std::optional<JobState> job_state(std::string_view text) {
  for (std::size_t i = 0; i < state_names.size(); ++i)
    if (state_names[i] == text) return static_cast<JobState>(i);
  return std::nullopt;
}

JobRequest parse_job(std::string_view body, Progress progress) {
  std::optional<PlanningTime> time;
  JobRequest request = checked_job(
      body, progress, [&](const Kind& kind, const json& spec, Progress part) { time = kind.check(spec, part); });
  request.planning_time = std::move(time);
  return request;
}

ordered_json preview_job(std::string_view body, Progress progress) {
  ordered_json said{{"notes", ordered_json::array()}, {"estimate", nullptr}, {"outline", nullptr}};
  const JobRequest request = checked_job(
      body, progress, [&](const Kind& kind, const json& spec, Progress part) { said = kind.preview(spec, part); });
  ordered_json answer{{"kind", request.kind}, {"checked", request.checked}};
  answer.update(said);
  return answer;
}

void check_job(std::string_view document, Progress progress) {
  const json read = parse_json(document, progress);
  const Kind& kind = *find_kind(read.at("kind").get_ref<const std::string&>());
  refuse(kind_schema(kind).validate(read.at("spec"), "/spec", progress));
  progress.report("read", 0);
  kind.check(read.at("spec"), progress);
}

json job_spec(std::string_view document, Progress progress) {
  return std::move(parse_json(document, progress).at("spec"));
}

ordered_json job_resource(const Job& job) {
  const auto& request = job.request;
  const std::string self = "/v1/jobs/" + job.id;
  ordered_json resource{{"id", job.id},
                        {"kind", request.kind},
                        {"name", nullable(request.name)},
                        {"reference", nullable(request.reference)},
                        {"priority", request.priority},
                        {"deadline", nullable_time(request.deadline)},
                        {"time_budget", nullable(request.time_budget)},
                        {"tags", request.tags},
                        {"callback", nullptr}};
  if (request.callback) {
    resource["callback"] = {{"url", request.callback->url},
                            {"attempts", job.delivery.attempts},
                            {"delivered_at", nullable_time(job.delivery.delivered_at)},
                            {"next_at", nullable_time(job.delivery.next_at)},
                            {"error", nullable(job.delivery.error)}};
  }
  resource["state"] = to_string(job.state);
  resource["progress"] = {
      {"fraction", job.fraction}, {"stage", job.stage}, {"message", job.message}, {"remaining", nullptr}};
  resource["queue"] = nullptr;
  resource["attempt"] = job.attempt;
  resource["created_at"] = rfc3339(job.created_at);
  resource["started_at"] = nullable_time(job.started_at);
  resource["finished_at"] = nullable_time(job.finished_at);
  resource["planned_by"] = nullable(job.planned_by);
  resource["error"] = job.error ? ordered_json::parse(*job.error) : ordered_json(nullptr);
  auto& links = resource["links"] = {{"self", self}};
  for (const char* part : {"spec", "events", "result", "setpoints", "cancel"}) links[part] = self + "/" + part;
  return resource;
}

}  // namespace bahnwerk::api
