#pragma once
/// The job document, which clients post, and the job resource, which they read.
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api/kind.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk::api {
struct PlannedJob;  // api/planned_job.hpp

/// Whom to call when a job has ended.
struct Callback {
  std::string url;
  /// What calls are signed with; nullopt where it is not needed, and in a document that was stored: it is shown to
  /// nobody.
  std::optional<std::string> secret = {};
  bool operator==(const Callback&) const = default;
};

inline constexpr std::size_t most_tags = 16;

/// A posted document that passed JSON, schema and semantic checks.
struct JobRequest {
  std::string kind;
  std::optional<std::string> name, reference;
  std::optional<Callback> callback;
  std::vector<std::string> tags;         ///< words, at most most_tags, each once
  int priority = 0;                      ///< jobs with a higher priority are planned first
  std::optional<std::int64_t> deadline;  ///< ms since 1970 UTC; planning that takes longer ends as deadline-exceeded
  std::optional<double> time_budget;     ///< s, largest planning time
  /// The whole document, exactly as posted but for the callback's secret, in whose place null stands; its `spec` is
  /// planned.
  std::string document;
  std::optional<PlanningTime> planning_time;  ///< expected one, if the check has found it
  bool checked = true;                        ///< false: the check of the spec was stopped; planning begins with it
};
/// Parses and checks a whole job document. Throws Problem: invalid-json (also for NaN, too deep nesting, broken UTF-8,
/// duplicate keys), unknown-kind, schema-violation, semantic-violation. The check of the spec asks `progress`, if
/// given; where that throws Stopped, the request is returned as not checked. Reading the text and checking the envelope
/// ask nobody, because without them there is no request.
JobRequest parse_job(std::string_view body, Progress progress = {});

/// Checks the spec of a request that is not checked. Asks `progress` from the first byte on. Throws Problem, as
/// parse_job does, and what `progress` throws.
void check_job(std::string_view document, Progress progress);

/// Checks a job document as parse_job() does and returns {"kind", "notes", "estimate", "outline"}, which is what can be
/// said of its plan before it is made; with `checked` false and null members where `progress` stopped the check.
nlohmann::ordered_json preview_job(std::string_view body, Progress progress = {});

/// Returns the spec of a checked document, with each number in its canonical form (2.0 = 2), as it is planned. Asks
/// `progress` while reading, if given.
nlohmann::json job_spec(std::string_view document, Progress progress = {});

enum class JobState { queued, running, succeeded, failed, cancelled };
std::string_view to_string(JobState state);
std::optional<JobState> job_state(std::string_view text);

/// What became of a job's callback.
struct Delivery {
  int attempts = 0;
  std::optional<std::int64_t> delivered_at, next_at;  ///< when it was answered with 2xx, or is tried next
  std::optional<std::string> error;                   ///< why the last attempt failed
};

/// A job as the store knows it; times are ms since 1970 UTC.
struct Job {
  std::string id;
  JobRequest request;
  std::optional<std::string> owner;  ///< name of the key that posted it
  JobState state = JobState::queued;
  double fraction = 0;
  std::string stage, message;
  int attempt = 0;
  /// Number of the last claim, not shown to clients. A requeue gives the attempt's number to the next claim, this one
  /// never.
  std::int64_t token = 0;
  std::int64_t created_at = 0;
  std::optional<std::int64_t> started_at, finished_at;
  std::optional<std::string> error;       ///< problem document, JSON text
  std::optional<std::string> planned_by;  ///< version of the program whose attempt has ended the job
  Delivery delivery;                      ///< state of the request's callback
  std::uint64_t revision = 0;             ///< grows with every change; the ETag
  /// The revision at which the job entered its state, if known, else 0; later revisions up to `revision` were progress
  /// only.
  std::uint64_t state_revision = 0;
};
/// Returns the job resource without the document, which may have megabytes.
nlohmann::ordered_json job_resource(const Job& job);

/// Plans a checked job document; worker and command line use this function. A plan that fails its verification is
/// returned as not verified, with its failed checks and without setpoints. Throws core's errors or Problem.
PlannedJob plan_job(const std::string& kind, const std::string& document, Progress progress);

}  // namespace bahnwerk::api
