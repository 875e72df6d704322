#include "server/routes/watch.hpp"

#include <algorithm>
#include <atomic>
#include <charconv>

#include "server/http/answer.hpp"

namespace bahnwerk::server {
namespace {

constexpr int longest_wait = 60;

Response current(const Context& context, const Request& request, const api::Job& job) {
  return unless_known(request, job_etag(job), [&] { return job_answer(context, 200, request, job); });
}

/// One delayed request. It reads the job on the pool, and again whenever the notifier calls.
struct Waiting : std::enable_shared_from_this<Waiting> {
  using Answer = std::function<Response(const Context&, const Request&, const api::Job&)>;
  /// What is waited for.
  struct Wish {
    std::string job;          ///< id
    int seconds;              ///< longest wait, s
    bool any_change = false;  ///< whether a change of the job, not its end alone, is waited for
  };
  Waiting(Context& all, RequestPtr asked, Reply give, Wish wish, Answer answer)
      : context(all),
        request(std::move(asked)),
        reply(std::move(give)),
        id(std::move(wish.job)),
        answer_with(std::move(answer)),
        any_change(wish.any_change),
        wait(wish.seconds),
        until(context.time.now() + std::chrono::seconds(wait)),
        progress_from(context.time.now() + progress_interval) {}

  /// The connection has to be free: the answer is given as at the end of the time.
  void finish() {
    finished = true;
    context.notifier.wake(token);
  }
  bool over() const { return finished || context.draining || context.time.now() >= until; }
  /// Tells whether the client's condition is fulfilled.
  bool due(const api::Job& job) const {
    if (final(job)) return true;
    if (!any_change || matches_etag(*request, job_etag(job))) return false;
    return !knows_state(*request, job) || context.time.now() >= progress_from;
  }
  Notifier::Clock::time_point next_look(const api::Job& job) const {
    const bool progressed = any_change && !matches_etag(*request, job_etag(job));
    return progressed ? std::min(until, progress_from) : until;
  }

  /// Returns the call that looks on a thread of the pool.
  std::function<void()> look_again() {
    return [self = shared_from_this()] { self->context.pool.post([self] { self->look(); }); };
  }
  /// Tells whether the job has changed since it was read, or cannot be read any more.
  bool missed(const api::Job& job) const {
    try {
      const api::Job now = find_job(context, id);
      return now.revision != job.revision && (due(now) || next_look(now) != next_look(job));
    } catch (...) {
      return true;
    }
  }

  void look() {
    try {
      const api::Job job = find_job(context, id);
      if (over() || due(job)) {
        if (job.state == api::JobState::queued) context.places.look();
        Response response = answer_with(context, *request, job);
        response.set("Preference-Applied", "wait=" + std::to_string(wait));
        return reply(std::move(response));
      }
      if (request->listen && !std::exchange(listening, true)) {
        request->listen([weak = weak_from_this()] {
          if (const auto alive = weak.lock()) alive->finish();
        });
      }
      token = context.notifier.wait(id, next_look(job), look_again(),
                                    any_change ? std::optional(progress_from) : std::nullopt);
      // A change between the query and the wait would be missed.
      if (finished || missed(job)) context.notifier.wake(token);
    } catch (const StoreError& error) {
      if (!error.busy || over()) return reply(answer_from_current_exception(*request));
      token = context.notifier.wait("", std::min(until, context.time.now() + store_retry), look_again());
      if (finished) context.notifier.wake(token);
    } catch (...) {
      reply(answer_from_current_exception(*request));
    }
  }

  Context& context;
  const RequestPtr request;
  const Reply reply;
  const std::string id;
  const Answer answer_with;
  const bool any_change;
  const int wait;
  const Notifier::Clock::time_point until, progress_from;
  bool listening = false;  ///< whether the connection knows that this one waits
  std::atomic<bool> finished{false};
  std::atomic<Notifier::Token> token{0};
};

}  // namespace

bool knows_state(const Request& request, const api::Job& job) {
  if (job.state_revision == 0) return false;
  const std::string tags = request.header("if-none-match").value_or("");
  for (std::size_t at = tags.find('"'); at != std::string::npos; at = tags.find('"', at + 1)) {
    std::uint64_t revision = 0;
    const char* const begin = tags.data() + at + 1;
    const auto [end, error] = std::from_chars(begin, tags.data() + tags.size(), revision);
    if (error == std::errc() && *end == '"' && revision >= job.state_revision && revision <= job.revision) return true;
  }
  return false;
}

int preferred_wait(const Request& request) {
  const std::string preferences = request.header("prefer").value_or("");
  std::string_view rest = preferences;
  while (!rest.empty()) {
    const std::size_t end = rest.find_first_of(",;");
    std::string_view item = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    while (item.starts_with(' ') || item.starts_with('\t')) item.remove_prefix(1);
    // Names of preferences are case-insensitive [RFC 7240, 2].
    constexpr std::string_view name = "wait=";
    const auto same = [](char small, char c) { return c == small || (c >= 'A' && c <= 'Z' && c - 'A' + 'a' == small); };
    if (item.size() < name.size() || !std::equal(name.begin(), name.end(), item.begin(), same)) continue;
    item.remove_prefix(name.size());
    int seconds = 0;
    const auto read = std::from_chars(item.data(), item.data() + item.size(), seconds);
    if (read.ec == std::errc::result_out_of_range) seconds = item.starts_with('-') ? 0 : longest_wait;
    return std::clamp(seconds, 0, longest_wait);
  }
  return 0;
}

void answer_at_end(Context& context, const RequestPtr& request, const Reply& reply, const std::string& id, int seconds,
                   std::function<Response(const Context&, const Request&, const api::Job&)> answer) {
  std::make_shared<Waiting>(context, request, reply, Waiting::Wish{id, seconds}, std::move(answer))->look();
}

void watch(Context& context, const RequestPtr& request, const Reply& reply) {
  require_json(*request);
  if (const int wait = preferred_wait(*request); wait > 0) {
    const Waiting::Wish wish{request->parameter("id"), wait, request->header("if-none-match").has_value()};
    auto waiting = std::make_shared<Waiting>(context, request, reply, wish, current);
    context.pool.post([waiting = std::move(waiting)] { waiting->look(); });
    return;
  }
  // Most queries are for a job that was read a moment ago: no other thread is woken for those.
  if (auto job = context.store.at_hand(request->parameter("id"));
      job && (job->state != api::JobState::queued || !context.places.outdated())) {
    context.live.overlay(*job);
    return reply(current(context, *request, *job));
  }
  context.pool.post([&context, request, reply] {
    reply_with(*request, reply, [&] {
      const api::Job job = find_job(context, request->parameter("id"));
      if (job.state == api::JobState::queued) context.places.look();
      return current(context, *request, job);
    });
  });
}

}  // namespace bahnwerk::server
