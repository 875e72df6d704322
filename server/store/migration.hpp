#pragma once
/// A step of a store's schema: a numbered SQL file of its migrations folder, embedded at build time.
#include <string_view>

namespace bahnwerk::server {

struct Migration {
  int number;  ///< 1, 2, …: the version of the schema after it
  std::string_view name;
  const char* sql;
};

}  // namespace bahnwerk::server
