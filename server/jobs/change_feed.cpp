#include "server/jobs/change_feed.hpp"

#include <utility>

#include "server/runtime/jitter.hpp"
#include "server/store/failure.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t at_once = 1000;

}  // namespace

ChangeFeed::ChangeFeed(ChangeSource& source, Hooks hooks, std::chrono::milliseconds interval)
    : source_(source), hooks_(std::move(hooks)), interval_(interval) {
  source_.listen(hooks_.changed);
  if (!source_.shared()) return;
  begin();
  thread_.emplace([this] {
    ask();
    return jittered(interval_);
  });
  source_.listen_to_others([this] { thread_->notify(); });
}

ChangeFeed::~ChangeFeed() {
  source_.listen_to_others(nullptr);
  source_.listen(nullptr);
  thread_.reset();
}

void ChangeFeed::begin() {
  try {
    seen_ = source_.last_change();
  } catch (const std::exception& error) {
    away_ = true;
    log_failure("changes_failed", error);
  }
}

void ChangeFeed::ask() {
  try {
    if (!seen_) seen_ = source_.last_change();
    ask_all();
    if (std::exchange(away_, false)) hooks_.all();
    hooks_.caught_up();
  } catch (const std::exception& error) {  // the store may be back the next time; nothing is missed
    away_ = true;
    log_failure("changes_failed", error);
  }
}

void ChangeFeed::ask_all() {
  for (;;) {
    const Changes changes = source_.changes_since(*seen_, at_once);
    if (changes.gap) {
      if (changes.list.empty()) seen_ = source_.last_change();  // before the look: what comes during it is asked for
      hooks_.all();
    }
    if (changes.list.empty()) return;
    seen_ = changes.list.back().sequence;
    hooks_.changed(changes.list);
    if (changes.list.size() < at_once) return;
  }
}

}  // namespace bahnwerk::server
