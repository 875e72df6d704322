#pragma once
/// What commands do with a PostgreSQL store; see open.hpp.
#include <string>
#include <vector>

#include "server/store/keys.hpp"

namespace bahnwerk::server::postgres {

int bring_up_to_date(const std::string& url);
std::vector<std::string> inspect(const std::string& url);
void add_key(const std::string& url, const Key& key);
std::vector<Key> remove_keys(const std::string& url, const std::string& name_or_id);
std::vector<Key> list_keys(const std::string& url, bool pooled);

}  // namespace bahnwerk::server::postgres
