/// The commands backup, check and migrate: what an operator does with a store.
#include <iostream>
#include <nlohmann/json.hpp>

#include "server/cli/cli.hpp"
#include "server/store/open.hpp"

namespace bahnwerk::server::cli {

int backup(const std::string& store, const std::string& file) {
  const BackUp made = back_up(store, file);
  std::cout << nlohmann::ordered_json{{"file", file}, {"jobs", made.jobs}, {"bytes", made.bytes}}.dump(2) << std::endl;
  return exit_ok;
}

int check(const std::string& store) {
  const std::vector<std::string> faults = inspect(store);
  std::cout << nlohmann::ordered_json{{"whole", faults.empty()}, {"faults", faults}}.dump(2) << std::endl;
  return faults.empty() ? exit_ok : exit_failed;
}

int migrate(const std::string& store) {
  std::cout << nlohmann::ordered_json{{"version", migrate_store(store)}}.dump(2) << std::endl;
  return exit_ok;
}

}  // namespace bahnwerk::server::cli
