#include "server/store/open.hpp"

#include <filesystem>

#include "server/store/sqlite/sqlite_store.hpp"

namespace bahnwerk::server {

void check_store(const std::string& url) {
  if (url.starts_with("postgresql:") || url.starts_with("postgres:"))
    throw StoreError("PostgreSQL is not available in this version; use sqlite:PATH", false);
  if (!url.starts_with("sqlite:") || url.size() == 7)
    throw StoreError("unsupported store '" + url + "'; expected sqlite:PATH, for example sqlite:var/bahnwerk.db",
                     false);
}

std::unique_ptr<Store> open_store(const std::string& url, std::function<void(double, std::size_t)> observer,
                                  std::size_t reserve) {
  check_store(url);
  SqliteOptions options;
  options.path = url.substr(7);
  options.observer = std::move(observer);
  options.reserve = reserve;
  const auto folder = std::filesystem::path(options.path).parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) throw StoreError("cannot make the store's directory " + folder.string() + ": " + error.message(), false);
  if (std::filesystem::is_directory(options.path, error))
    throw StoreError("the store " + options.path + " is a directory; expected a file", false);
  return std::make_unique<SqliteStore>(std::move(options));
}

}  // namespace bahnwerk::server
