#pragma once
/// The ends of a move of jobs (server/store/moving) in a PostgreSQL store.
#include <memory>
#include <string>

#include "server/store/moving/move_ends.hpp"

namespace bahnwerk::server {

class PostgresConnection;

namespace postgres {

/// Open the store of a URL. Throw StoreError with a sentence for the operator: processes use it, there is none, or it
/// has the schema of another version. The source stays as it is while the object lives: writers wait in vain.
std::unique_ptr<MoveReader> move_source(const std::string& url);
std::unique_ptr<MoveTarget> move_target(const std::string& url);  ///< makes the schema where there is none

/// Throws StoreRefused if a move has begun to fill this store and has not come to its end.
void refuse_unfinished_move(PostgresConnection& connection);

}  // namespace postgres
}  // namespace bahnwerk::server
