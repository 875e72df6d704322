#pragma once
/// What every store must hold. A store comes with a trait that makes it: add yours to Stores.
#include "../fixture.hpp"

namespace bahnwerk::server {

/// One database, empty at first. `one` and `other` are two processes' views of it, the same object where a second
/// process may not have it.
struct SqliteStores {
  static constexpr bool restart_ends_leases = true;  ///< else they run out in their time
  SqliteStores() { restart(); }
  void restart() {
    store.reset();
    store = std::make_unique<SqliteStore>(SqliteOptions{.path = (folder.path / "store.db").string()});
  }
  Store& one() { return *store; }
  Store& other() { return *store; }

  TempFolder folder;
  std::unique_ptr<Store> store;
};

using Stores = testing::Types<SqliteStores>;

template <class S>
struct Conformance : testing::Test {
  void restart() {
    stores.restart();
    here = &stores.one();
    other = &stores.other();
  }
  void queue(int count) {
    for (int i = 0; i < count; ++i) insert_id(*here);
  }
  S stores;
  Store* here = &stores.one();
  Store* other = &stores.other();
  SilentProgress silent;
};

}  // namespace bahnwerk::server
