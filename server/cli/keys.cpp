/// The commands key add, key list and key remove.
#include <iostream>
#include <nlohmann/json.hpp>

#include "api/documents/job.hpp"
#include "api/text/rfc3339.hpp"
#include "server/cli/cli.hpp"
#include "server/keys/key_text.hpp"
#include "server/runtime/clock.hpp"
#include "server/store/open.hpp"

namespace bahnwerk::server::cli {
namespace {

using nlohmann::ordered_json;

ordered_json shown(const std::vector<Key>& keys) {
  ordered_json list = ordered_json::array();
  for (const Key& key : keys) {
    ordered_json entry{{"id", key.id}, {"name", key.name}, {"scopes", to_string(key.scopes)}};
    entry["max_queued"] = key.max_queued ? ordered_json(*key.max_queued) : ordered_json();
    entry["max_planning"] =
        key.max_planning_ms ? ordered_json(static_cast<double>(*key.max_planning_ms) * 1e-3) : ordered_json();
    entry["created_at"] = api::rfc3339(key.created_at);
    entry["removed_at"] = key.removed_at ? ordered_json(api::rfc3339(*key.removed_at)) : ordered_json();
    list.push_back(std::move(entry));
  }
  return {{"keys", std::move(list)}};
}

}  // namespace

int add_key(const std::string& store, const std::string& name, const std::string& scopes,
            std::optional<std::int64_t> max_queued, std::optional<std::chrono::milliseconds> max_planning) {
  if (!is_key_name(name))
    throw std::runtime_error("'" + name + "' is no name for a key; expected 1 to 64 letters, digits and . _ - @");
  const auto granted = parse_scopes(scopes);
  if (!granted) throw std::runtime_error("'" + scopes + "' are no scopes; expected submit, read, admin, with commas");
  NewKey made = make_key();
  made.key.name = name;
  made.key.scopes = *granted;
  made.key.max_queued = max_queued;
  if (max_planning) made.key.max_planning_ms = max_planning->count();
  made.key.created_at = now_ms();
  server::add_key(store, made.key);
  std::cerr << "bahnwerk: key " << made.key.id << " of " << name << " (" << to_string(*granted)
            << "); it is shown this once\n";
  std::cout << made.text << std::endl;
  return exit_ok;
}

int list_keys(const std::string& store) {
  std::cout << shown(server::list_keys(store)).dump(2) << std::endl;
  return exit_ok;
}

int remove_keys(const std::string& store, const std::string& name_or_id) {
  const std::vector<Key> removed = server::remove_keys(store, name_or_id);
  if (removed.empty()) throw std::runtime_error("there is no valid key '" + name_or_id + "'");
  std::cout << shown(removed).dump(2) << std::endl;
  return exit_ok;
}

}  // namespace bahnwerk::server::cli
