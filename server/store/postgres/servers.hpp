#pragma once
/// The servers that a connection string of libpq names.
#include <string>
#include <vector>

namespace bahnwerk::server {

struct PostgresServers {
  std::vector<std::string> each;  ///< a connection string for each server, in their order; never empty
  bool written = false;           ///< whether the one is asked for that can be written
};

/// Returns the servers of a URL. Where it names one, cannot be read, or prefers some by what libpq alone knows
/// (target_session_attrs=prefer-standby), that is the URL itself.
PostgresServers servers_of(const std::string& url);

}  // namespace bahnwerk::server
