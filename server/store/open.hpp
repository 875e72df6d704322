#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server/store/keys.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

/// Throws StoreError unless open_store accepts such a URL; opens nothing.
void check_store(const std::string& url);

/// Returns the path of an SQLite store's file, whatever links lead to it; makes its folder. Throws StoreError.
std::string prepared_path(const std::string& url);

/// How a process uses a store, beside others where these share it.
struct SharedStoreOptions {
  bool migrate = true;          ///< whether an older schema is brought up to date, or refused
  std::string planned_by = {};  ///< version of the program, which jobs keep that it has ended
  std::size_t connections = 8;  ///< most connections to its server
  bool signals = true;          ///< whether processes tell each other of changes, beside polling
  bool pooled = false;          ///< whether a pooler gives each transaction another session of the server
  std::string listen_url = {};  ///< where signals come from, past a pooler; empty: the store's URL, if it is not pooled
  /// Called, from any thread and maybe again, where a server that was away at the start refuses this process for good.
  std::function<void(const std::string&)> refused = [](const std::string&) {};
  /// Called, from any thread, with the jobs whose attempt a claim has found lost.
  std::function<void(const std::vector<std::string>&)> lost = [](const std::vector<std::string>&) {};

  /// Returns whether signals of others can come.
  bool hears() const { return signals && (!pooled || !listen_url.empty()); }
};

/// Opens the store named by a URL: sqlite:PATH (a missing directory is created), or a connection URI of PostgreSQL.
/// `observer` receives every commit (seconds, writes); `reserve` bytes of disk are set aside for a full one, in a file
/// beside SQLite's; ended jobs are kept as `retention` says. A server that is away may come later. Throws StoreError
/// with a sentence for the operator.
std::unique_ptr<Store> open_store(const std::string& url, std::function<void(double, std::size_t)> observer,
                                  std::size_t reserve = 0, const Retention& retention = {},
                                  const SharedStoreOptions& shared = {});

struct BackUp {
  std::size_t jobs = 0, bytes = 0;
};
/// Copies the store named by a URL into `file`, readable by its owner alone, as it is at one moment: jobs that are
/// accepted meanwhile do not delay it. The file appears when it is complete, in place of an older one. Throws
/// StoreError with a sentence for the operator, also for a PostgreSQL store, which has tools of its own.
BackUp back_up(const std::string& url, const std::string& file);

/// Brings the schema of the store named by a URL up to date, in a PostgreSQL store with partitions for the next days,
/// and returns its version: for those whose services may not. Throws StoreError with a sentence for the operator.
int migrate_store(const std::string& url);

/// Returns what is wrong with the store named by a URL, in sentences: damaged pages, jobs without their document,
/// results whose setpoints are not complete. It may be in use. Throws StoreError if it cannot be opened.
std::vector<std::string> inspect(const std::string& url);

/// Changes and lists the keys of the store named by a URL, also while a service uses it. The first key of a store that
/// does not exist makes it. Removal takes all keys of a name, or the one with an id, and returns them. Throws
/// StoreError with a sentence for the operator.
void add_key(const std::string& url, const Key& key);
std::vector<Key> remove_keys(const std::string& url, const std::string& name_or_id);
/// `pooled`: see SharedStoreOptions.
std::vector<Key> list_keys(const std::string& url, bool pooled = false);  ///< removed ones included

}  // namespace bahnwerk::server
