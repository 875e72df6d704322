#include "server/routes/submit.hpp"

#include <time.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>

#include "api/text/pointer.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/http/gzip.hpp"
#include "server/keys/key_ring.hpp"
#include "server/routes/watch.hpp"
#include "server/runtime/clock.hpp"
#include "server/runtime/memory.hpp"
#include "server/runtime/sha256.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t large_document = 1 << 20;  ///< bytes; a parsed document takes about 25 times its text

/// A check at POST takes at most that long, counted from the end of the request, waiting included; what is more is
/// checked by the worker. The reading of the text and of the envelope is not stopped.
constexpr std::chrono::seconds check_time{2};
/// Processor time of a check beside other ones; a longer check begins again on the thread of large documents.
constexpr std::chrono::milliseconds quick_check{30};

std::chrono::nanoseconds thread_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

/// Stops a check when `over` says so.
class CheckProgress final : public Progress {
 public:
  explicit CheckProgress(std::function<bool()> over) : over_(std::move(over)) {}
  void report(std::string_view, double, std::string_view) override {
    if (over_()) throw Stopped(StopReason::budget);
    if (uses_memory() && memory_is_short()) throw std::bad_alloc();
  }

 private:
  const std::function<bool()> over_;
};

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
class Post : public std::enable_shared_from_this<Post> {
 public:
  Post(Context& context, RequestPtr request, Reply reply, bool packed)
      : context_(context),
        request_(std::move(request)),
        reply_(std::move(reply)),
        packed_(packed),
        until_(context.time.now() + check_time) {
    job_.idempotency_key = idempotency_key(*request_);
  }

  /// Takes the document of a job that has failed or was cancelled.
  void retry() {
    context_.scans.post([self = shared_from_this()] {
      try {
        self->again();
      } catch (...) {
        self->reply_(answer_from_current_exception(*self->request_));
      }
    });
  }

  void begin() {
    if (!packed_ && request_->body.size() > large_document) return take_turn();
    context_.checks.post([self = shared_from_this()] { self->answered([&] { return self->quick(); }); });
  }

 private:
  /// Runs `work`, which returns false where the document has to take its turn; answers an exception.
  template <class Work>
  void answered(Work&& work) {
    try {
      if (!work()) take_turn();
    } catch (...) {
      reply_(answer_from_current_exception(*request_));
    }
  }

  void take_turn() {
    if (request_->listen)
      request_->listen([weak = weak_from_this()] {
        if (const auto self = weak.lock()) self->finish_ = true;
      });
    context_.heavy.post([self = shared_from_this()] {
      self->answered([&] { return self->thorough(); });
      give_back_memory();
    });
  }

  /// Checks and stores a document of some kilobytes; returns false if it is none.
  bool quick() {
    if (!unpack(large_document)) return false;
    const auto begin = thread_time();
    CheckProgress progress([&] { return thread_time() - begin > quick_check; });
    try {
      job_.request = context_.parse(request_->body, &progress);
    } catch (const std::bad_alloc&) {
      return false;
    }
    if (!job_.request.checked) return false;
    check_callback();
    insert();
    return true;
  }

  bool thorough() {
    if (!unpack(context_.max_body))
      throw http_problem(413,
                         "The request body, unpacked, is larger than " + std::to_string(context_.max_body) + " bytes.");
    CheckProgress progress([&] { return finish_ || context_.time.now() >= until_; });
    try {
      const MemoryUse use;
      job_.request = context_.parse(request_->body, &progress);
    } catch (const std::bad_alloc&) {
      throw api::Problem("semantic-violation",
                         "The memory that the service may use does not suffice to check the document: divide it, or "
                         "describe it with curves instead of many short lines.");
    }
    check_callback();
    insert();
    return true;
  }

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

  /// Unpacks the body if it is packed; returns false if it has more than `most` bytes then.
  bool unpack(std::size_t most) {
    if (!packed_) return true;
    auto text = gunzip(request_->body, most);
    if (!text) return false;
    request_->body = std::move(*text);
    packed_ = false;
    return true;
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
    context_.store.insert(
        std::move(job_), [self = shared_from_this()](const Inserted& inserted, std::exception_ptr error) {
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
      reply_(accepted(context_, *request_, find_job(context_, inserted.id), planning_time_));
    } catch (...) {
      reply_(answer_from_current_exception(*request_));
    }
  }

  Context& context_;
  const RequestPtr request_;
  const Reply reply_;
  bool packed_;
  const TimeSource::Time until_;
  NewJob job_;
  std::optional<api::PlanningTime> planning_time_;
  std::atomic<bool> finish_{false};  ///< the client has left, or others need the connection
};

}  // namespace

void submit(Context& context, const RequestPtr& request, const Reply& reply) {
  require_json(*request);
  if (!is_json(request->header("content-type").value_or("")))
    throw api::Problem("unsupported-media-type", "Job documents are posted with Content-Type: application/json.");
  const auto coding = content_coding(request->header("content-encoding").value_or(""));
  if (!coding) {
    Response response =
        problem_answer(api::Problem("unsupported-media-type", "Of content codings only gzip and identity are known."),
                       request->target);
    response.set("Accept-Encoding", "gzip, identity");
    return reply(std::move(response));
  }
  if (context.draining) throw api::Problem("draining", "The server is about to stop and takes no new jobs.");
  std::make_shared<Post>(context, request, reply, *coding == Coding::gzip)->begin();
}

void retry(Context& context, const RequestPtr& request, const Reply& reply) {
  require_json(*request);
  if (context.draining) throw api::Problem("draining", "The server is about to stop and takes no new jobs.");
  std::make_shared<Post>(context, request, reply, false)->retry();
}

}  // namespace bahnwerk::server
