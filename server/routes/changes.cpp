#include "server/routes/changes.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <nlohmann/json.hpp>

#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/http/key_gate.hpp"
#include "server/routes/event_feed.hpp"
#include "server/routes/watch.hpp"

namespace bahnwerk::server {
namespace {

using Clock = Notifier::Clock;

constexpr std::size_t most_at_once = 1000;
/// Shortest time between two pieces of a stream: what changes meanwhile is sent together.
constexpr std::chrono::milliseconds between_pieces{100};

nlohmann::ordered_json entry(const Changed& changed) {
  return {{"sequence", changed.sequence},
          {"id", changed.id},
          {"state", changed.state ? api::to_string(*changed.state) : "removed"}};
}

struct News {
  Changes changes;
  std::uint64_t next = 0;  ///< sequence from which to ask on
};

/// Returns the changes after `since` that the caller may see. A number that the store has not given yet is of another
/// store: then all jobs have to be looked at.
News news(Store& store, std::uint64_t since, std::size_t limit, const std::optional<std::string>& owner) {
  News out;
  out.next = store.last_change();  // before the look: what comes during it is looked for the next time
  if (since > out.next) {
    out.changes.gap = true;
    return out;
  }
  out.changes = store.changes_since(since, limit, owner);
  if (!out.changes.list.empty()) {
    const std::uint64_t last = out.changes.list.back().sequence;
    out.next = out.changes.list.size() == limit ? last : std::max(out.next, last);
  }
  return out;
}

bool empty(const News& news) { return news.changes.list.empty() && !news.changes.gap; }

Response answer(const News& news) {
  auto list = nlohmann::ordered_json::array();
  for (const Changed& changed : news.changes.list) list.push_back(entry(changed));
  Response response = json_answer(200, {{"changes", std::move(list)}, {"next", news.next}, {"gap", news.changes.gap}});
  response.set("Cache-Control", "no-store");
  return response;
}

/// One request that waits for a change. It reads on the pool, and again whenever the notifier calls.
struct Waiting : std::enable_shared_from_this<Waiting> {
  Waiting(Context& all, RequestPtr asked, Reply give, std::uint64_t from, std::size_t most, int seconds)
      : context(all),
        request(std::move(asked)),
        reply(std::move(give)),
        owner(sees_only(*request)),
        since(from),
        limit(most),
        wait(seconds),
        until(context.time.now() + std::chrono::seconds(seconds)) {}

  void look() {
    try {
      const News found = news(context.store, since, limit, owner);
      if (!empty(found) || finished || context.draining || context.time.now() >= until) {
        Response response = answer(found);
        response.set("Preference-Applied", "wait=" + std::to_string(wait));
        return reply(std::move(response));
      }
      since = found.next;
      if (request->listen && !std::exchange(listening, true)) {
        request->listen([weak = weak_from_this()] {
          if (const auto alive = weak.lock()) {
            alive->finished = true;
            alive->context.notifier.wake(alive->token);
          }
        });
      }
      token = context.notifier.wait(std::string(Notifier::any_job), until,
                                    [self = shared_from_this()] { self->context.pool.post([self] { self->look(); }); });
      // A change between the query and the wait would be missed.
      if (finished || context.store.last_change() != since) context.notifier.wake(token);
    } catch (...) {
      reply(answer_from_current_exception(*request));
    }
  }

  Context& context;
  const RequestPtr request;
  const Reply reply;
  const std::optional<std::string> owner;
  std::uint64_t since;
  const std::size_t limit;
  const int wait;
  const Clock::time_point until;
  bool listening = false;  ///< whether the connection knows that this one waits
  std::atomic<bool> finished{false};
  std::atomic<Notifier::Token> token{0};
};

/// The changes of all jobs that the client may see.
class ChangesFeed final : public EventFeed {
 public:
  ChangesFeed(Context& context, const Request& request, std::uint64_t since)
      : EventFeed(context, request.key), owner_(sees_only(request)), since_(since) {}

 private:
  void look() override {
    std::string text(begun_ ? "" : first_piece);
    if (begun_ && !context_.draining && context_.time.now() < last_piece_ + between_pieces)
      return wait("", last_piece_ + between_pieces);
    begun_ = true;
    try {
      const News found = news(context_.store, since_, most_at_once, owner_);
      if (found.changes.gap) text += "event: gap\ndata: {}\n\n";
      for (const Changed& changed : found.changes.list) text += event_text("change", changed.sequence, entry(changed));
      since_ = found.next;
    } catch (...) {  // the store failed: the client's next request gets the answer
      return give(std::nullopt);
    }
    if (text.empty() && context_.draining) return give(std::nullopt);
    if (text.empty() && silent_too_long()) text = sign_of_life;
    if (!text.empty()) return give(std::move(text));
    wait(Notifier::any_job, last_piece_ + context_.event_heartbeat);
    if (changed()) look_now();  // between the query and the wait
  }

  bool changed() {
    try {
      return context_.store.last_change() != since_;
    } catch (...) {
      return true;
    }
  }

  const std::optional<std::string> owner_;
  std::uint64_t since_;  ///< the last change that the client has
  bool begun_ = false;
};

/// Reads a number of the query; throws Problem where it is none, or not within `most`.
std::optional<std::uint64_t> number(const Request& request, std::string_view name, std::uint64_t least,
                                    std::uint64_t most) {
  for (const auto& [key, value] : request.query) {
    if (key != name) continue;
    std::uint64_t out = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), out);
    if (error == std::errc() && end == value.data() + value.size() && out >= least && out <= most) return out;
    const std::string message = "expected an integer from " + std::to_string(least) + " to " + std::to_string(most);
    throw api::Problem("schema-violation", "The query is not valid: " + key + ": " + message,
                       {{"/query/" + key, message}});
  }
  return std::nullopt;
}

/// Returns the number of Last-Event-ID, or of `since`; nullopt: from now on.
std::optional<std::uint64_t> begin_after(const Request& request) {
  constexpr auto largest = std::uint64_t{std::numeric_limits<std::int64_t>::max()};
  const auto since = number(request, "since", 0, largest);
  const auto last = last_event_id(request);
  return last && *last <= largest ? last : since;
}

void begin(Context& context, const RequestPtr& request, const Reply& reply) {
  static constexpr std::array<std::string_view, 2> offers{"application/json", "text/event-stream"};
  const auto form = negotiate(request->header("accept"), offers);
  if (!form) throw api::Problem("not-acceptable", "Changes come as application/json or text/event-stream.");
  const auto limit = number(*request, "limit", 1, most_at_once).value_or(most_at_once);
  const auto since = begin_after(*request);
  const std::uint64_t from = since ? *since : context.store.last_change();
  if (*form == 1) return reply(event_stream(std::make_shared<ChangesFeed>(context, *request, from)));
  if (const int wait = preferred_wait(*request); wait > 0)
    return std::make_shared<Waiting>(context, request, reply, from, limit, wait)->look();
  reply(answer(since ? news(context.store, from, limit, sees_only(*request)) : News{{}, from}));
}

}  // namespace

void changes(Context& context, const RequestPtr& request, const Reply& reply) {
  context.pool.post([&context, request, reply] {
    try {
      begin(context, request, reply);
    } catch (...) {
      reply(answer_from_current_exception(*request));
    }
  });
}

}  // namespace bahnwerk::server
