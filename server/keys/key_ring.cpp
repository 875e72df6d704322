#include "server/keys/key_ring.hpp"

#include "server/keys/key_text.hpp"
#include "server/runtime/log.hpp"
#include "server/store/failure.hpp"

namespace bahnwerk::server {

KeyRing::KeyRing(Store& store, std::function<void()> removed, std::chrono::milliseconds interval, bool required)
    : store_(store), removed_(std::move(removed)), interval_(interval), required_(required), demanded_(required) {
  try {
    look();
  } catch (const StoreError& error) {  // they are read when it is back
    if (!error.busy || !store_.shared()) throw;
  }
  thread_.emplace([this] {
    look_again();
    return interval_;
  });
}

std::shared_ptr<const HeldKey> KeyRing::find(std::string_view text) const {
  const auto id = key_id(text);
  if (!id) return nullptr;
  std::shared_ptr<const HeldKey> held;
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = keys_.find(*id); found != keys_.end()) held = found->second;
  }
  static const Key none = [] {
    Key key;
    key.hash = std::string(64, '0');
    return key;
  }();
  return is_key(text, held ? held->key : none) ? held : nullptr;
}

void KeyRing::look() {
  const auto changed = store_.keys(version_);
  if (!changed) {
    known_ = true;
    return;
  }
  std::map<std::string, std::shared_ptr<HeldKey>, std::less<>> valid;
  bool any_removed = false;
  {
    const std::lock_guard lock(mutex_);
    for (const Key& key : changed->list) {
      const auto found = keys_.find(key.id);
      if (key.removed_at) {
        if (found != keys_.end()) any_removed = found->second->removed = true;
        continue;
      }
      valid.emplace(key.id, found != keys_.end() ? found->second : std::make_shared<HeldKey>(key));
    }
    keys_.swap(valid);
  }
  version_ = changed->version;
  demanded_ = required_ || !changed->list.empty();
  known_ = true;
  log::info("keys", {{"valid", keys_.size()}, {"known", changed->list.size()}});
  if (any_removed && removed_) removed_();
}

void KeyRing::look_again() {
  try {
    look();
  } catch (const std::exception& error) {  // those known stay valid
    log_failure("keys_not_read", error);
  }
}

}  // namespace bahnwerk::server
