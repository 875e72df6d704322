#pragma once
/// What commands do with a store's file, beside the process that owns it; see open.hpp.
#include <string>
#include <vector>

#include "server/store/keys.hpp"
#include "server/store/open.hpp"

namespace bahnwerk::server::sqlite {

BackUp back_up(const std::string& url, const std::string& file);
int bring_up_to_date(const std::string& url);
std::vector<std::string> inspect(const std::string& url);
void add_key(const std::string& url, const Key& key);
std::vector<Key> remove_keys(const std::string& url, const std::string& name_or_id);
std::vector<Key> list_keys(const std::string& url);

}  // namespace bahnwerk::server::sqlite
