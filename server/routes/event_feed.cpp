#include "server/routes/event_feed.hpp"

#include <charconv>
#include <nlohmann/json.hpp>

#include "server/keys/key_ring.hpp"

namespace bahnwerk::server {

void EventFeed::next(Ready ready) {
  ready_ = std::move(ready);
  look_later();
}

void EventFeed::stop() {
  stopped_ = true;
  look_now();
}

void EventFeed::look_later() {
  context_.pool.post([self = shared_from_this()] {
    if (self->stopped_ || (self->key_ && self->key_->removed)) return self->give(std::nullopt);
    self->look();
  });
}

void EventFeed::give(std::optional<std::string> piece) {
  last_piece_ = context_.time.now();
  std::exchange(ready_, nullptr)(std::move(piece));
}

void EventFeed::wait(std::string_view job, Clock::time_point until, std::optional<Clock::time_point> progress_from) {
  token_ = context_.notifier.wait(
      std::string(job), until, [self = shared_from_this()] { self->look_later(); }, progress_from);
  if (stopped_) look_now();
}

void EventFeed::wait_for_store() {
  if (context_.draining) return give(std::nullopt);
  if (silent_too_long()) return give(std::string(sign_of_life));
  wait("", context_.time.now() + store_retry);
}

std::string event_text(std::string_view name, std::uint64_t id, const nlohmann::ordered_json& data) {
  return "id: " + std::to_string(id) + "\nevent: " + std::string(name) +
         "\ndata: " + data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n\n";
}

Response event_stream(std::shared_ptr<Feed> feed) {
  Response response;
  response.set("Cache-Control", "no-store");
  response.set("Content-Type", "text/event-stream");
  response.set("X-Accel-Buffering", "no");  // proxies hold answers back until they have a block
  response.feed = std::move(feed);
  return response;
}

std::optional<std::uint64_t> last_event_id(const Request& request) {
  const std::string text = request.header("last-event-id").value_or("");
  std::uint64_t id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(id) : std::nullopt;
}

}  // namespace bahnwerk::server
