#include "server/keys/key_ring.hpp"

#include <gtest/gtest.h>

#include "../store/fixture.hpp"
#include "server/keys/key_text.hpp"
#include "server/store/open.hpp"

namespace bahnwerk::server {
namespace {

using namespace std::chrono_literals;

template <class Condition>
bool soon(Condition condition) {
  for (int i = 0; i < 15'000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(2ms);
  }
  return false;
}

TEST_F(StoreTest, ARingFollowsTheStore) {
  const std::string url = "sqlite:" + (folder.path / "store.db").string();
  std::atomic<int> removals{0};
  const KeyRing ring(
      *store, [&] { ++removals; }, 5ms);
  EXPECT_FALSE(ring.demanded());
  NewKey made = make_key(), stays = make_key();
  made.key.name = stays.key.name = "acme";
  made.key.scopes.read = stays.key.scopes.read = true;
  EXPECT_EQ(ring.find(made.text), nullptr);
  add_key(url, made.key);
  add_key(url, stays.key);
  EXPECT_TRUE(soon([&] { return ring.find(made.text) && ring.find(stays.text); }));
  EXPECT_TRUE(ring.demanded());
  EXPECT_EQ(ring.find(made.text.substr(0, made.text.size() - 1) + "x"), nullptr);
  const auto held = ring.find(made.text), other = ring.find(stays.text);
  EXPECT_EQ(held->key.name, "acme");
  remove_keys(url, made.key.id);
  EXPECT_TRUE(soon([&] { return held->removed.load(); }));
  EXPECT_TRUE(soon([&] { return removals == 1; }));
  EXPECT_EQ(ring.find(made.text), nullptr);
  EXPECT_EQ(ring.find(stays.text), other);
  remove_keys(url, "acme");
  EXPECT_TRUE(soon([&] { return other->removed.load(); }));
  EXPECT_TRUE(ring.demanded()) << "a service that has had keys never answers without one";
}

TEST_F(StoreTest, ARingMayDemandKeysWhereThereNeverWasOne) {
  const KeyRing open(*store), closed(*store, {}, 5ms, true);
  EXPECT_TRUE(open.known());
  EXPECT_FALSE(open.demanded());
  EXPECT_TRUE(closed.known());
  EXPECT_TRUE(closed.demanded());
}

}  // namespace
}  // namespace bahnwerk::server
