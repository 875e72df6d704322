#include "server/routes/events.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/routes/event_feed.hpp"
#include "server/routes/watch.hpp"

namespace bahnwerk::server {
namespace {

/// The events of one job.
class JobFeed final : public EventFeed {
 public:
  JobFeed(Context& context, std::string id, std::uint64_t known, const Request& request)
      : EventFeed(context, request.key), id_(std::move(id)), prefix_(request.prefix), sent_(known) {}

 private:
  void look() override {
    if (ended_) return give(std::nullopt);
    std::optional<api::Job> job;
    try {
      job = find_job(context_, id_);
    } catch (const StoreError& error) {
      if (error.busy) return wait_for_store();
      return give(std::nullopt);  // the client's next request gets the answer
    } catch (...) {               // the job was deleted meanwhile
      return give(std::nullopt);
    }
    std::string text(begun_ ? "" : first_piece);
    begun_ = true;
    text += news(*job);
    ended_ = final(*job) || context_.draining;
    if (text.empty() && !ended_ && silent_too_long()) text = sign_of_life;
    if (!text.empty()) return give(std::move(text));
    if (ended_) return give(std::nullopt);
    const auto progress_from = last_event_ + progress_interval;
    const bool progressed = job->revision > sent_;
    auto until = last_piece_ + context_.event_heartbeat;
    if (progressed) until = std::min(until, progress_from);
    wait(id_, until, progress_from);
    if (revision() != job->revision) look_now();  // between the query and the wait
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
      text += event_text("state", job.revision - 1, job_resource(context_, before, prefix_));
    }
    const auto resource = job_resource(context_, job, prefix_);
    text += entered ? event_text("state", job.revision, resource)
                    : event_text("progress", job.revision, resource["progress"]);
    if (job.state == api::JobState::queued) queued_ = job.revision;
    sent_ = job.revision;
    last_event_ = context_.time.now();
    return text;
  }

  const std::string id_, prefix_;
  std::uint64_t sent_;        ///< the revision that the client has
  std::uint64_t queued_ = 1;  ///< the revision at which it saw the job in the queue; every job begins there with 1
  bool begun_ = false, ended_ = false;
  Clock::time_point last_event_{};
};

Response begin(Context& context, const Request& request) {
  static constexpr std::array<std::string_view, 1> offers{"text/event-stream"};
  if (!negotiate(request.header("accept"), offers))
    throw api::Problem("not-acceptable", "Events come as text/event-stream.");
  const api::Job job = find_job(context, request.parameter("id"));
  std::uint64_t known = last_event_id(request).value_or(0);
  if (final(job) && known == job.revision) {
    Response nothing_to_come;
    nothing_to_come.status = 204;
    return nothing_to_come.set("Cache-Control", "no-store");
  }
  if (known > job.revision) known = 0;  // the number is of another job, or made up
  return event_stream(std::make_shared<JobFeed>(context, job.id, known, request));
}

}  // namespace

void events(Context& context, const RequestPtr& request, const Reply& reply) {
  context.pool.post(
      [&context, request, reply] { reply_with(*request, reply, [&] { return begin(context, *request); }); });
}

}  // namespace bahnwerk::server
