#pragma once
#include <functional>
#include <string>

#include "server/store/moving/move.hpp"

namespace bahnwerk::server {

/// Moves all jobs and keys of one store into another one, from an SQLite file to a PostgreSQL database or back, and
/// compares both: see moving/move.hpp. No process may use either of them. The source stays as it is. Throws StoreError
/// with a sentence for the operator.
MoveReport move_store(const std::string& from, const std::string& to,
                      const std::function<void(const MoveProgress&)>& tell);

/// Returns the URL of a store that is named by its URL, or by the path of an SQLite file.
std::string store_url(const std::string& name);

}  // namespace bahnwerk::server
