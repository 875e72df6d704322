#pragma once
/// The ends of a move of jobs (server/store/moving) in a store's file.
#include <memory>
#include <string>

#include "server/store/moving/move_ends.hpp"

namespace bahnwerk::server {

class SqliteConnection;

namespace sqlite {

/// Open the store of a URL, and keep other processes out of it as long as the object lives. Throw StoreError with a
/// sentence for the operator: it is in use, there is none, or it has the schema of another version.
std::unique_ptr<MoveReader> move_source(const std::string& url);
std::unique_ptr<MoveTarget> move_target(const std::string& url);  ///< makes it where there is none

/// Throws StoreError if a move has begun to fill this store and has not come to its end.
void refuse_unfinished_move(SqliteConnection& connection);

}  // namespace sqlite
}  // namespace bahnwerk::server
