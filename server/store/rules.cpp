#include "server/store/rules.hpp"

#include <nlohmann/json.hpp>

#include "api/problem.hpp"

namespace bahnwerk::server {
namespace {

using api::JobState;

std::string document(const std::string& id, const char* type, const std::string& detail) {
  return api::Problem(type, detail).document("/v1/jobs/" + id).dump();
}

}  // namespace

api::Job accepted_job(const NewJob& job, const std::string& id) {
  const api::JobRequest& request = job.request;
  api::Job accepted;
  accepted.id = id;
  accepted.request.kind = request.kind;
  accepted.request.name = request.name;
  accepted.request.reference = request.reference;
  if (request.callback) accepted.request.callback = api::Callback{request.callback->url};
  accepted.request.tags = request.tags;
  accepted.request.priority = request.priority;
  accepted.request.deadline = request.deadline;
  accepted.request.time_budget = request.time_budget;
  accepted.owner = job.owner;
  accepted.created_at = job.now;
  accepted.revision = accepted.state_revision = 1;
  return accepted;
}

Fate after_cancel(const std::string& id) {
  return {JobState::cancelled, document(id, "cancelled", "The job was cancelled.")};
}

Fate after_loss(const std::string& id, std::int64_t losses, bool cancel_requested) {
  if (cancel_requested) return after_cancel(id);
  if (losses < max_losses_alone) return {JobState::queued, ""};
  const std::string detail = "The process ended " + std::to_string(losses) +
                             " times while it planned this job and no other; it is not tried again.";
  return {JobState::failed, document(id, "worker-lost", detail)};
}

Fate after_requeue(const std::string& id, bool cancel_requested) {
  return cancel_requested ? after_cancel(id) : Fate{JobState::queued, ""};
}

Fate after_deadline(const std::string& id) {
  return {JobState::failed,
          document(id, "deadline-exceeded", "The deadline passed while the job waited in the queue.")};
}

}  // namespace bahnwerk::server
