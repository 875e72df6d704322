#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/http/key_gate.hpp"
#include "server/routes/events.hpp"
#include "server/routes/news_feed.hpp"
#include "server/routes/watch.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t most_at_once = 200;

/// The events of all jobs that the client may see and asks for.
class AllJobsFeed final : public NewsFeed {
 public:
  AllJobsFeed(Context& context, const Request& request, JobFilter filter, std::uint64_t since)
      : NewsFeed(context, request, since, most_at_once, filter.owner),
        filter_(std::move(filter)),
        prefix_(request.prefix) {}

 private:
  Clock::time_point look_for_more() const override {
    return progress_due_ ? context_.time.now() + progress_interval : Clock::time_point::max();
  }

  std::string event_of(const Changed& changed) override {
    if (!changed.state) return filter_.state ? "" : event_text("removed", changed.sequence, {{"id", changed.id}});
    const auto job = visible(changed.id);
    return job ? event_text("state", changed.sequence, job_resource(context_, *job, prefix_)) : "";
  }

  /// Returns the progress of running jobs since the last time, at most once a second.
  std::string more() override {
    progress_due_ = !filter_.state || *filter_.state == api::JobState::running;
    if (!progress_due_ || context_.time.now() < last_progress_ + progress_interval) return "";
    std::string text;
    std::map<std::string, std::uint64_t> sent;
    const auto running = context_.running.all();
    progress_due_ = !running.empty();
    for (const auto& [id, revision] : running) {
      const auto before = sent_.find(id);
      sent.emplace(id, revision);
      if (before != sent_.end() && before->second == revision) continue;
      const auto job = visible(id);
      if (!job || job->state != api::JobState::running) continue;
      nlohmann::ordered_json data{{"id", job->id}};
      data.update(job_resource(context_, *job, prefix_)["progress"]);
      text += event_text("progress", since_, data);
    }
    sent_ = std::move(sent);
    if (!text.empty()) last_progress_ = context_.time.now();
    return text;
  }

  /// Returns the job as it is now, if the client may see it and asks for it.
  std::optional<api::Job> visible(const std::string& id) {
    auto job = context_.store.at_hand(id);
    if (!job) job = context_.store.get(id, false);
    if (!job || (filter_.owner && job->owner != filter_.owner)) return std::nullopt;
    context_.live.overlay(*job);
    if ((filter_.state && job->state != *filter_.state) || (filter_.kind && job->request.kind != *filter_.kind))
      return std::nullopt;
    return job;
  }

  const JobFilter filter_;
  const std::string prefix_;
  Clock::time_point last_progress_{};
  bool progress_due_ = true;                   ///< whether progress has to be looked for again
  std::map<std::string, std::uint64_t> sent_;  ///< revisions of running jobs whose progress the client has
};

Response begin(Context& context, const Request& request) {
  static constexpr std::array<std::string_view, 1> offers{"text/event-stream"};
  if (!negotiate(request.header("accept"), offers))
    throw api::Problem("not-acceptable", "Events come as text/event-stream.");
  JobFilter filter;
  filter.owner = sees_only(request);
  for (const auto& [name, value] : request.query) {
    if (name == "kind") filter.kind = value;
    if (name != "state") continue;
    filter.state = api::job_state(value);
    const std::string message = "expected queued, running, succeeded, failed or cancelled";
    if (!filter.state)
      throw api::Problem("schema-violation", "The query is not valid: state: " + message, {{"/query/state", message}});
  }
  const std::uint64_t since = last_event_id(request).value_or(context.store.last_change());
  return event_stream(std::make_shared<AllJobsFeed>(context, request, std::move(filter), since));
}

}  // namespace

void all_events(Context& context, const RequestPtr& request, const Reply& reply) {
  context.pool.post(
      [&context, request, reply] { reply_with(*request, reply, [&] { return begin(context, *request); }); });
}

}  // namespace bahnwerk::server
