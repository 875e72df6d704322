#include "server/routes/events.hpp"

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/keys/key_ring.hpp"
#include "server/routes/watch.hpp"

namespace bahnwerk::server {
namespace {

using Clock = Notifier::Clock;

std::string event(std::string_view name, std::uint64_t id, const nlohmann::ordered_json& data) {
  return "id: " + std::to_string(id) + "\nevent: " + std::string(name) +
         "\ndata: " + data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n\n";
}

/// The state of one client's stream. For the next piece it reads the job on the pool, and waits with the notifier when
/// there is nothing new.
class JobFeed final : public Feed, public std::enable_shared_from_this<JobFeed> {
 public:
  JobFeed(Context& context, std::string id, std::uint64_t known, const Request& request)
      : context_(context), id_(std::move(id)), key_(request.key), prefix_(request.prefix), sent_(known) {}

  void next(Ready ready) override {
    ready_ = std::move(ready);
    look_later();
  }
  void stop() override {
    stopped_ = true;
    context_.notifier.wake(token_);
  }

 private:
  void look_later() {
    context_.pool.post([self = shared_from_this()] { self->look(); });
  }
  void give(std::optional<std::string> piece) {
    last_piece_ = context_.time.now();
    std::exchange(ready_, nullptr)(std::move(piece));
  }

  void look() {
    if (ended_ || stopped_ || (key_ && key_->removed)) return give(std::nullopt);
    std::optional<api::Job> job;
    try {
      job = find_job(context_, id_);
    } catch (...) {  // the job was deleted meanwhile, or the store failed: the client's next request gets the answer
      return give(std::nullopt);
    }
    std::string text = begun_ ? "" : "retry: 3000\n\n";
    begun_ = true;
    text += news(*job);
    ended_ = final(*job) || context_.draining;
    if (text.empty() && !ended_ && context_.time.now() >= last_piece_ + context_.event_heartbeat)
      text = ": still here\n\n";
    if (!text.empty()) return give(std::move(text));
    if (ended_) return give(std::nullopt);
    const auto progress_from = last_event_ + progress_interval;
    const bool progressed = job->revision > sent_;
    auto until = last_piece_ + context_.event_heartbeat;
    if (progressed) until = std::min(until, progress_from);
    token_ = context_.notifier.wait(
        id_, until, [self = shared_from_this()] { self->look_later(); }, progress_from);
    // A change between the query and the wait would be missed.
    if (stopped_ || revision() != job->revision) context_.notifier.wake(token_);
  }

  /// Returns the job's current revision; 0, which is never one, if it cannot be read.
  std::uint64_t revision() {
    try {
      return find_job(context_, id_).revision;
    } catch (...) {
      return 0;
    }
  }

  /// Returns the events that the client has not received.
  std::string news(api::Job& job) {
    if (job.revision <= sent_) return "";
    const bool entered = job.state_revision == 0 || sent_ < job.state_revision;
    if (!entered && context_.time.now() < last_event_ + progress_interval) return "";
    std::string text;
    if (entered && final(job) && job.started_at && sent_ > 0 &&
        sent_ <= queued_) {  // planned too fast to be seen running
      api::Job before = job;
      before.state = api::JobState::running;
      before.fraction = 0;
      before.stage = before.message = "";
      before.finished_at = std::nullopt;
      before.error = std::nullopt;
      text += event("state", job.revision - 1, job_resource(before, prefix_));
    }
    const auto resource = job_resource(job, prefix_);
    text += entered ? event("state", job.revision, resource) : event("progress", job.revision, resource["progress"]);
    if (job.state == api::JobState::queued) queued_ = job.revision;
    sent_ = job.revision;
    last_event_ = context_.time.now();
    return text;
  }

  Context& context_;
  const std::string id_;
  const std::shared_ptr<const HeldKey> key_;  ///< the stream ends when it is removed
  const std::string prefix_;
  std::uint64_t sent_;        ///< the revision that the client has
  std::uint64_t queued_ = 1;  ///< the revision at which it saw the job in the queue; every job begins there with 1
  bool begun_ = false, ended_ = false;
  Clock::time_point last_event_{}, last_piece_{};
  Ready ready_;
  std::atomic<bool> stopped_{false};
  std::atomic<Notifier::Token> token_{0};
};

/// Returns the id of Last-Event-ID; 0: unknown.
std::uint64_t last_event(const Request& request) {
  const std::string text = request.header("last-event-id").value_or("");
  std::uint64_t id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
  return error == std::errc() && end == text.data() + text.size() ? id : 0;
}

Response begin(Context& context, const Request& request) {
  static constexpr std::array<std::string_view, 1> offers{"text/event-stream"};
  if (!negotiate(request.header("accept"), offers))
    throw api::Problem("not-acceptable", "Events come as text/event-stream.");
  const api::Job job = find_job(context, request.parameter("id"));
  std::uint64_t known = last_event(request);
  Response response;
  response.set("Cache-Control", "no-store");
  if (final(job) && known == job.revision) {
    response.status = 204;
    return response;
  }
  if (known > job.revision) known = 0;  // the number is of another job, or made up
  response.set("Content-Type", "text/event-stream");
  response.set("X-Accel-Buffering", "no");  // proxies hold answers back until they have a block
  response.feed = std::make_shared<JobFeed>(context, job.id, known, request);
  return response;
}

}  // namespace

void events(Context& context, const RequestPtr& request, const Reply& reply) {
  context.pool.post(
      [&context, request, reply] { reply_with(*request, reply, [&] { return begin(context, *request); }); });
}

}  // namespace bahnwerk::server
