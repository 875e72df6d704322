#pragma once
/// The keys by which clients are known. A key acts for its name: jobs belong to the name, and several keys may have
/// one.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bahnwerk::server {

struct Scopes {
  bool submit = false;  ///< posts, cancels and deletes its own jobs
  bool read = false;    ///< sees its own jobs
  bool admin = false;   ///< everything, with the jobs of all
};

/// Returns the scopes of a list such as "submit,read"; nullopt: malformed, or empty.
std::optional<Scopes> parse_scopes(std::string_view list);
std::string to_string(const Scopes& scopes);

struct Key {
  std::string id;  ///< part of the key's text that is no secret
  std::string name;
  Scopes scopes;
  std::string hash;  ///< SHA-256 of the key's whole text
  /// What a post with this key may add to the jobs of its name: none beyond so many in the queue, and none on a day
  /// (UTC) on which planners spent so many ms on them.
  std::optional<std::int64_t> max_queued, max_planning_ms;
  std::int64_t created_at = 0;             ///< ms since 1970 UTC
  std::optional<std::int64_t> removed_at;  ///< when it ceased to be valid
};

/// All keys that there are or have been: a service that has had keys never answers without one.
struct Keys {
  std::uint64_t version = 0;  ///< increases with every change
  std::vector<Key> list;
};

}  // namespace bahnwerk::server
