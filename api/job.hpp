#pragma once
/// The job document as it comes in and the job resource as it goes out.
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace bahnwerk {
class Progress;
}

namespace bahnwerk::api {
struct PlannedJob;  // api/planned_job.hpp

/// A posted document that passed JSON, schema and semantic checks.
struct JobRequest {
  std::string kind;
  std::optional<std::string> name, reference, callback;
  int priority = 0;  ///< higher first
  std::optional<std::int64_t>
      deadline;  ///< ms since 1970 UTC; planning that is not finished by then ends as deadline-exceeded
  std::optional<double> time_budget;  ///< s of planning allowed
  std::string document;               ///< the whole document, byte for byte as posted; its `spec` is what is planned
};
/// Parses and checks a whole job document. Throws Problem: invalid-json (also for NaN, too deep nesting, broken UTF-8,
/// duplicate keys), unknown-kind, schema-violation, semantic-violation.
JobRequest parse_job(std::string_view body);

/// The spec of a checked document's text, numbers in one form (2.0 = 2), as it is planned. Reading asks `progress`, if
/// given.
nlohmann::json job_spec(std::string_view document, Progress* progress = nullptr);

enum class JobState { queued, running, succeeded, failed, cancelled };
std::string_view to_string(JobState state);
std::optional<JobState> job_state(std::string_view text);

/// A job as the store knows it; times are ms since 1970 UTC.
struct Job {
  std::string id;
  JobRequest request;
  JobState state = JobState::queued;
  double fraction = 0;
  std::string stage, message;
  int attempt = 0;
  std::int64_t created_at = 0;
  std::optional<std::int64_t> started_at, finished_at;
  std::optional<std::string> error;  ///< problem document, JSON text
  std::uint64_t revision = 0;        ///< grows with every change; the ETag
  /// The revision from which on the job has been in this state as far as is known; what is later than it and not later
  /// than `revision` was progress. 0: not known.
  std::uint64_t state_revision = 0;
};
/// The job resource; the document itself is not part of it: it may have megabytes.
nlohmann::ordered_json job_resource(const Job& job);

std::string rfc3339(std::int64_t ms);  ///< "2026-01-31T12:00:00.123Z"
std::optional<std::int64_t> parse_rfc3339(std::string_view text);

/// Plans a checked job document from its text: the one entry for worker and command line. Throws core's errors or
/// Problem. A plan that fails its verification is returned as not verified, with what failed, without setpoints.
PlannedJob plan_job(const std::string& kind, const std::string& document, Progress& progress);

}  // namespace bahnwerk::api
