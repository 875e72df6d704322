#include "server/jobs/change_feed.hpp"

#include "server/runtime/log.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t at_once = 1000;

}  // namespace

ChangeFeed::ChangeFeed(ChangeSource& source, Hooks hooks, std::chrono::milliseconds interval)
    : source_(source), hooks_(std::move(hooks)), interval_(interval) {
  source_.listen(hooks_.changed);
  if (!source_.shared()) return;
  seen_ = source_.last_change();
  thread_.emplace([this] {
    ask();
    return interval_;
  });
}

ChangeFeed::~ChangeFeed() {
  source_.listen(nullptr);
  thread_.reset();
}

void ChangeFeed::ask() {
  try {
    ask_all();
  } catch (const std::exception& error) {  // the store may be back the next time; nothing is missed
    log::error("changes_failed", {{"detail", error.what()}});
  }
}

void ChangeFeed::ask_all() {
  for (;;) {
    const Changes changes = source_.changes_since(seen_, at_once);
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
