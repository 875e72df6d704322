#pragma once
/// A job on its way from one store into another, with all that a store keeps of it beside its document, result and
/// setpoints.
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/job.hpp"

namespace bahnwerk::server {

struct MovedJob {
  std::string id, kind;
  std::optional<std::string> name, reference, owner;
  std::vector<std::string> tags;
  std::int64_t priority = 0, turn = 0;
  std::optional<std::int64_t> deadline;
  std::optional<double> time_budget;
  api::JobState state = api::JobState::queued;
  double fraction = 0;
  std::string stage, message;
  std::int64_t attempt = 0, token = 0, losses = 0;
  bool suspect = false, cancel_requested = false;
  std::int64_t created_at = 0;
  std::optional<std::int64_t> started_at, finished_at;
  std::optional<std::string> error, planned_by;
  std::int64_t revision = 1;
  std::optional<std::string> callback, callback_secret, callback_receiver;
  std::int64_t callback_attempts = 0;
  std::optional<std::int64_t> callback_due, callback_delivered;
  std::optional<std::string> callback_error;
  std::int64_t needs = 0;                                             ///< level of planners
  std::vector<std::pair<std::string, std::string>> idempotency_keys;  ///< key and hash of the body
  std::int64_t key = 0;  ///< by which its store finds what belongs to the job, beside the id
};

/// Returns the job as the store it is moved into has it: the attempt of a running one is lost with its process, and the
/// job waits in the queue, or is cancelled where that was requested. Clients may have seen revisions that were never
/// stored, and a job whose attempt was lost is planned alone. Others stay as they are.
MovedJob as_moved(MovedJob job, std::int64_t now);

/// Returns a text that two jobs share when they are equal in all but `key`.
std::string record_of(const MovedJob& job);

}  // namespace bahnwerk::server
