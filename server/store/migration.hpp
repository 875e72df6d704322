#pragma once
/// A step of a store's schema: a numbered SQL file of its migrations folder, embedded at build time.
#include <string>
#include <string_view>

namespace bahnwerk::server {

struct Migration {
  int number;  ///< 1, 2, …: the version of the schema after it
  std::string_view name;
  const char* sql;
};

/// Returns what is wrong with a store of an older version that is not to be brought up to date.
inline std::string not_migrated(int version, int known) {
  return "the store has schema version " + std::to_string(version) + ", this program needs " + std::to_string(known) +
         "; run `bahnwerk migrate` of this version on it, or serve with --store-migrate auto";
}

}  // namespace bahnwerk::server
