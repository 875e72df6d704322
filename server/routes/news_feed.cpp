#include "server/routes/news_feed.hpp"

#include <algorithm>

namespace bahnwerk::server {
namespace {

/// Shortest time between two pieces: what changes meanwhile is sent together.
constexpr std::chrono::milliseconds between_pieces{100};

}  // namespace

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

void NewsFeed::look() {
  std::string text(begun_ ? "" : first_piece);
  if (begun_ && !context_.draining && context_.time.now() < last_piece_ + between_pieces)
    return wait("", last_piece_ + between_pieces);
  const std::uint64_t before = since_;
  try {
    const News found = news(context_.store, since_, limit_, owner_);
    since_ = found.next;
    if (found.changes.gap) text += "event: gap\ndata: {}\n\n";
    for (const Changed& changed : found.changes.list) text += event_of(changed);
    text += more();
  } catch (const StoreError& error) {
    since_ = before;
    if (error.busy) return wait_for_store();
    return give(std::nullopt);  // the client's next request gets the answer
  } catch (...) {               // the store failed: the client's next request gets the answer
    return give(std::nullopt);
  }
  begun_ = true;
  if (text.empty() && context_.draining) return give(std::nullopt);
  if (text.empty() && silent_too_long()) text = sign_of_life;
  if (!text.empty()) return give(std::move(text));
  wait(Notifier::any_job, std::min(last_piece_ + context_.event_heartbeat, look_for_more()));
  if (changed()) look_now();  // between the query and the wait
}

bool NewsFeed::changed() {
  try {
    return context_.store.last_change() != since_;
  } catch (...) {
    return true;
  }
}

}  // namespace bahnwerk::server
