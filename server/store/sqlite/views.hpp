#pragma once
/// Parts of views in the tables of the store.
#include <cstdint>
#include <vector>

#include "api/views/views.hpp"

namespace bahnwerk::server {

class SqliteConnection;

/// Bytes that a part takes in the tables beside its data.
inline constexpr std::size_t view_row = 64;
/// Inserts compressed parts, or replaces those that exist.
void insert_views(SqliteConnection& connection, std::int64_t seq, const std::vector<api::ViewPart>& parts);

}  // namespace bahnwerk::server
