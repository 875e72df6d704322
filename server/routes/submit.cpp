#include "server/routes/submit.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "api/pointer.hpp"
#include "server/http/answer.hpp"
#include "server/keys/key_ring.hpp"
#include "server/routes/document_check.hpp"
#include "server/routes/watch.hpp"
#include "server/runtime/clock.hpp"
#include "server/runtime/sha256.hpp"
#include "server/store/rules.hpp"

namespace bahnwerk::server {
namespace {

std::string idempotency_key(const Request& request) {
  const auto named = [](const auto& header) { return header.first == "idempotency-key"; };
  const auto key = std::find_if(request.headers.begin(), request.headers.end(), named);
  if (key == request.headers.end()) return "";
  if (std::any_of(key + 1, request.headers.end(), named))
    throw api::Problem("bad-request", "Idempotency-Key is given more than once.");
  const std::string& text = key->second;
  const bool visible = std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c < 127; });
  if (text.empty() || text.size() > 255 || !visible)
    throw api::Problem("bad-request", "Idempotency-Key takes 1 to 255 printable ASCII characters.");
  return text;
}

/// Returns the answer where the job was not taken; throws the problem of most reasons.
std::optional<Response> refused(const Context& context, const Request& request, const Inserted& inserted) {
  switch (inserted.what) {
    case Inserted::What::conflict:
      throw api::Problem("idempotency-conflict", "This Idempotency-Key was used before with another body.");
    case Inserted::What::full:
      throw api::Problem("too-many-jobs",
                         std::to_string(context.max_queued) + " jobs are waiting; no more are taken now.");
    case Inserted::What::owner_full:
      throw api::Problem("too-many-jobs", "As many jobs of the key " + request.key->key.name +
                                              " are waiting as its quota allows (max-queued).");
    case Inserted::What::planning_spent: {
      Response response = problem_answer(
          api::Problem("too-many-jobs", "The planning time of the key " + request.key->key.name +
                                            " for this day is spent (max-planning); it begins anew at midnight, UTC."),
          request.target);
      const std::int64_t left = ms_per_day - context.time.now_ms() % ms_per_day;
      return response.set("Retry-After", std::to_string(left / 1000 + 1));
    }
    case Inserted::What::created:
    case Inserted::What::replayed:
      break;
  }
  return std::nullopt;
}

/// From here on a plan's expected time is worth a note.
constexpr double long_planning = 60;  // s

std::string about(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, seconds < 100 ? "%.0f s" : "%.3g s", seconds);
  return text;
}

/// Throws Problem semantic-violation where the plan of a request cannot end within its time. Estimates hold within a
/// factor of two, on processors like that on which they were made: a plan is refused beyond three times its limit.
void require_time(const api::JobRequest& request, std::chrono::milliseconds most_planning) {
  if (!request.planning_time) return;
  const double service = std::chrono::duration<double>(most_planning).count();
  const bool own = request.time_budget && *request.time_budget < service;
  const double limit = own ? *request.time_budget : service;
  const auto& [seconds, pointer, change] = *request.planning_time;
  if (seconds <= 3 * limit) return;
  const std::string message =
      "the plan takes about " + about(seconds) + "; " +
      (own ? "time_budget allows " : "the service plans no job for longer than (--max-planning-time) ") + about(limit) +
      ". Smaller values of " + change;
  throw api::Problem("semantic-violation", pointer + ": " + message, {{pointer, message}});
}

/// Answers with the job, and a note where its plan will take long.
Response accepted(const Context& context, const Request& request, const api::Job& job,
                  const std::optional<api::PlanningTime>& time = {}) {
  Response response = job_answer(context, 202, request, job);
  if (time && time->seconds >= long_planning && !final(job)) {
    auto resource = nlohmann::ordered_json::parse(response.body);
    resource["notes"] = {"the plan takes about " + about(time->seconds) + ". Smaller values of " + time->change};
    response.body = resource.dump();
  }
  response.set("Location", "/v1/jobs/" + job.id);
  return response;
}

/// A posted document on its way into the store.
class Post final : public DocumentCheck {
 public:
  Post(Context& context, const RequestPtr& request, const Reply& reply, bool packed)
      : DocumentCheck(context, request, reply, packed) {
    job_.idempotency_key = idempotency_key(*request_);
  }

  /// Takes the document of a job that has failed or was cancelled.
  void retry() {
    context_.scans.post([self = this_post()] {
      try {
        self->again();
      } catch (...) {
        self->reply_(answer_from_current_exception(*self->request_));
      }
    });
  }

 private:
  /// Throws Problem where the document has a callback that this service would not make, or could not sign.
  void check_callback() const {
    const auto& callback = job_.request.callback;
    if (!callback) return;
    const std::string refusal = context_.callback_hosts.refusal(callback->url);
    if (!refusal.empty())
      throw api::Problem("semantic-violation", "/callback/url: " + refusal, {{"/callback/url", refusal}});
    const std::string unsigned_call = "is missing: the receiver checks with it who calls";
    if (!callback->secret)
      throw api::Problem("semantic-violation", "/callback/secret: " + unsigned_call,
                         {{"/callback/secret", unsigned_call}});
  }

  std::shared_ptr<Post> this_post() { return std::static_pointer_cast<Post>(shared_from_this()); }
  bool check(std::string_view document, Progress progress) override {
    job_.request = context_.parse(document, progress);
    return job_.request.checked;
  }
  void done() override {
    check_callback();
    insert();
  }

  void again() {
    const std::string& id = request_->parameter("id");
    auto job = context_.store.get(id);
    if (!job) throw api::Problem("not-found", "There is no job " + api::shortened(id) + ".");
    if (job->state != api::JobState::failed && job->state != api::JobState::cancelled)
      throw api::Problem("job-not-failed", "The job is " + std::string(api::to_string(job->state)) + ".");
    job_.owner = job->owner;  // who may see the old job sees the new one
    job_.request = std::move(job->request);
    job_.request.checked = false;
    request_->body = "retry " + id;  // what is asked for, where an Idempotency-Key is given
    insert();
  }

  void insert() {
    require_time(job_.request, context_.max_planning);
    planning_time_ = job_.request.planning_time;
    if (!job_.idempotency_key.empty()) job_.body_hash = sha256(request_->body);
    request_->body = std::string();
    job_.now = context_.time.now_ms();
    job_.max_queued = context_.max_queued;
    if (const auto& callback = job_.request.callback) job_.callback_receiver = receiver_of(callback->url);
    if (const auto& held = request_->key) {
      if (!job_.owner) job_.owner = held->key.name;
      job_.max_owned = held->key.max_queued;
      job_.max_planning_ms = held->key.max_planning_ms;
    }
    accepted_ = accepted_job(job_, "");
    context_.store.insert(std::move(job_), [self = this_post()](const Inserted& inserted, std::exception_ptr error) {
      // This runs on the store's thread: it hands over at once.
      self->context_.pool.post([self, inserted, error = std::move(error)] { self->answer(inserted, error); });
    });
  }

  /// Answers with the job, at once or when it has ended, as the client prefers.
  void answer(const Inserted& inserted, const std::exception_ptr& error) {
    try {
      if (error) std::rethrow_exception(error);
      if (auto response = refused(context_, *request_, inserted)) return reply_(std::move(*response));
      if (const int wait = preferred_wait(*request_); wait > 0)
        return answer_at_end(context_, request_, reply_, inserted.id, wait,
                             [](const Context& context, const Request& request, const api::Job& job) {
                               return accepted(context, request, job);
                             });
      accepted_.id = inserted.id;
      const bool replayed = inserted.what == Inserted::What::replayed;
      reply_(accepted(context_, *request_, replayed ? find_job(context_, inserted.id) : accepted_, planning_time_));
    } catch (...) {
      reply_(answer_from_current_exception(*request_));
    }
  }

  NewJob job_;
  api::Job accepted_;  ///< the job as it was accepted
  std::optional<api::PlanningTime> planning_time_;
};

}  // namespace

void submit(Context& context, const RequestPtr& request, const Reply& reply) {
  const auto packed = packed_document(*request, reply);
  if (!packed) return;
  if (context.draining) throw api::Problem("draining", "The server is about to stop and takes no new jobs.");
  std::make_shared<Post>(context, request, reply, *packed)->begin();
}

void retry(Context& context, const RequestPtr& request, const Reply& reply) {
  require_json(*request);
  if (context.draining) throw api::Problem("draining", "The server is about to stop and takes no new jobs.");
  std::make_shared<Post>(context, request, reply, false)->retry();
}

}  // namespace bahnwerk::server
