#include "server/store/moving/moved_job.hpp"

#include <bit>

#include "server/store/rules.hpp"

namespace bahnwerk::server {
namespace {

/// Appends values, each with its length, so that no two lists of values make one text.
class Record {
 public:
  Record& operator<<(std::string_view value) {
    text_.append(std::to_string(value.size())).append(":").append(value);
    return *this;
  }
  Record& operator<<(std::int64_t value) { return *this << std::to_string(value); }
  Record& operator<<(double value) { return *this << std::bit_cast<std::int64_t>(value); }
  template <class Value>
  Record& operator<<(const std::optional<Value>& value) {
    if (value) return *this << *value;
    text_ += '-';
    return *this;
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

}  // namespace

MovedJob as_moved(MovedJob job, std::int64_t now) {
  if (job.state != api::JobState::running) return job;
  const Fate fate = after_requeue(job.id, job.cancel_requested);
  job.state = fate.state;
  job.revision += lost_leap;
  job.suspect = true;
  if (fate.state == api::JobState::queued) {
    job.started_at.reset();
    job.error.reset();
    job.fraction = 0;
    job.stage.clear();
    job.message.clear();
  } else {
    job.finished_at = now;
    job.error = fate.error;
    if (job.callback_receiver) job.callback_due = now;
  }
  return job;
}

std::string record_of(const MovedJob& job) {
  Record record;
  record << job.id << job.kind << job.name << job.reference << job.owner << static_cast<std::int64_t>(job.tags.size());
  for (const std::string& tag : job.tags) record << tag;
  record << job.priority << job.turn << job.deadline << job.time_budget << api::to_string(job.state) << job.fraction
         << job.stage << job.message << job.attempt << job.token << job.losses << std::int64_t{job.suspect}
         << std::int64_t{job.cancel_requested} << job.created_at << job.started_at << job.finished_at << job.error
         << job.revision << job.callback << job.callback_secret << job.callback_receiver << job.callback_attempts
         << job.callback_due << job.callback_delivered << job.callback_error << job.needs << job.planned_by;
  for (const auto& [key, hash] : job.idempotency_keys) record << key << hash;
  return record.take();
}

}  // namespace bahnwerk::server
