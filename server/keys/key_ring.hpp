#pragma once
/// The keys that are valid now, in memory: requests never wait for the store to learn who asks.
#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "server/runtime/look_thread.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

/// A key in use. Streams that last longer than a request look whether it was removed.
struct HeldKey {
  explicit HeldKey(Key k) : key(std::move(k)) {}
  const Key key;
  std::atomic<bool> removed{false};
};

class KeyRing {
 public:
  /// Reads the keys, then looks every `interval` for changes, which other processes make; `removed` is called from its
  /// thread after a key was removed. `required`: everyone needs a key, also where there never was one.
  explicit KeyRing(Store& store, std::function<void()> removed = {},
                   std::chrono::milliseconds interval = std::chrono::milliseconds(250), bool required = false);

  bool known() const { return known_; }  ///< whether the keys were read; until then the store is away
  /// Returns whether there are or have been keys, or they are required: then everyone needs one.
  bool demanded() const { return demanded_; }
  std::shared_ptr<const HeldKey> find(std::string_view text) const;  ///< nullptr: it is no valid key

 private:
  void look();
  void look_again();

  Store& store_;
  const std::function<void()> removed_;
  const std::chrono::milliseconds interval_;
  const bool required_;
  std::atomic<bool> known_{false}, demanded_{false};
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<HeldKey>, std::less<>> keys_;  ///< valid ones by id
  std::uint64_t version_ = 0;  ///< version of the keys read last; used by the thread alone
  std::optional<LookThread> thread_;
};

}  // namespace bahnwerk::server
