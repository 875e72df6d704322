#include "server/routes/changes.hpp"

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/http/key_gate.hpp"
#include "server/routes/news_feed.hpp"
#include "server/routes/waiting.hpp"
#include "server/routes/watch.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t most_at_once = 1000;

nlohmann::ordered_json entry(const Changed& changed) {
  return {{"sequence", changed.sequence},
          {"id", changed.id},
          {"state", changed.state ? api::to_string(*changed.state) : "removed"}};
}

bool empty(const News& news) { return news.changes.list.empty() && !news.changes.gap; }

Response answer(const News& news) {
  auto list = nlohmann::ordered_json::array();
  for (const Changed& changed : news.changes.list) list.push_back(entry(changed));
  Response response = json_answer(200, {{"changes", std::move(list)}, {"next", news.next}, {"gap", news.changes.gap}});
  response.set("Cache-Control", "no-store");
  return response;
}

/// The changes of all jobs that the client may see.
class ChangesFeed final : public NewsFeed {
 public:
  ChangesFeed(Context& context, const Request& request, std::uint64_t since)
      : NewsFeed(context, request, since, most_at_once, sees_only(request)) {}

 private:
  std::string event_of(const Changed& changed) override {
    return event_text("change", changed.sequence, entry(changed));
  }
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
  if (const int wait = preferred_wait(*request); wait > 0) {
    const auto look = [&context, limit, owner = sees_only(*request),
                       next = from](bool last) mutable -> std::optional<Response> {
      const News found = news(context.store, next, limit, owner);
      if (last || !empty(found)) return answer(found);
      next = found.next;
      return std::nullopt;
    };
    const AnyJobWait::Schedule schedule{context.pool, wait};
    return std::make_shared<AnyJobWait>(context, request, reply, look, schedule)->look();
  }
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
