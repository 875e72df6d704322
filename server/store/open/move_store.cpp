#include "server/store/open/move_store.hpp"

#include "server/store/open.hpp"
#include "server/store/postgres/moving.hpp"
#include "server/store/sqlite/moving.hpp"
#include "server/store/store_url.hpp"

namespace bahnwerk::server {
namespace {

std::string name_of(const std::string& url) {
  return names_postgres(url) ? without_secrets(url) : "sqlite:" + prepared_path(url);
}

}  // namespace

std::string store_url(const std::string& name) {
  if (names_postgres(name) || name.starts_with("sqlite:") || name.find("://") != std::string::npos) return name;
  return "sqlite:" + name;
}

MoveReport move_store(const std::string& from, const std::string& to,
                      const std::function<void(const MoveProgress&)>& tell) {
  check_store(from);
  check_store(to);
  if (names_postgres(from) == names_postgres(to))
    throw StoreError(
        names_postgres(from)
            ? "between PostgreSQL databases a store is moved by PostgreSQL's own tools: pg_dump, pg_restore"
            : "an SQLite store is copied by `bahnwerk backup`; expected one store postgresql://…",
        false);
  const auto source = names_postgres(from) ? postgres::move_source(from) : sqlite::move_source(from);
  const auto target = names_postgres(to) ? postgres::move_target(to) : sqlite::move_target(to);
  return move_jobs(*source, name_of(from), *target, tell);
}

}  // namespace bahnwerk::server
