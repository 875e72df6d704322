#include "server/store/keys.hpp"

#include <gtest/gtest.h>

#include "fixture.hpp"
#include "server/keys/key_text.hpp"
#include "server/store/open.hpp"

namespace bahnwerk::server {
namespace {

NewKey key_of(const std::string& name) {
  NewKey made = make_key();
  made.key.name = name;
  made.key.scopes.read = true;
  made.key.max_queued = 3;
  return made;
}

TEST(Scopes, AreReadFromAList) {
  const auto scopes = parse_scopes("admin,submit");
  ASSERT_TRUE(scopes);
  EXPECT_TRUE(scopes->submit);
  EXPECT_FALSE(scopes->read);
  EXPECT_EQ(to_string(*scopes), "submit,admin");
  for (const char* list : {"", "read,", "reader", "read submit"}) EXPECT_FALSE(parse_scopes(list)) << list;
}

TEST_F(StoreTest, KeysAreAddedAndRemovedBesideTheStoreThatUsesThem) {
  const std::string url = "sqlite:" + (folder.path / "store.db").string();
  EXPECT_EQ(store->keys(0), std::nullopt);
  const NewKey one = key_of("acme"), two = key_of("acme"), other = key_of("other");
  for (const NewKey* each : {&one, &two, &other}) add_key(url, each->key);
  auto keys = store->keys(0);
  ASSERT_TRUE(keys);
  EXPECT_EQ(keys->list.size(), 3U);
  EXPECT_EQ(keys->list.front().max_queued, 3);
  EXPECT_EQ(store->keys(keys->version), std::nullopt);
  EXPECT_EQ(remove_keys(url, "acme").size(), 2U);
  EXPECT_EQ(remove_keys(url, "acme").size(), 0U);
  EXPECT_EQ(remove_keys(url, other.key.id).size(), 1U);
  keys = store->keys(keys->version);
  ASSERT_TRUE(keys);
  for (const Key& key : keys->list) EXPECT_TRUE(key.removed_at);
  EXPECT_EQ(list_keys(url).size(), 3U);
}

TEST(Keys, TheFirstKeyMakesTheStore) {
  const TempFolder folder;
  const std::string path = (folder.path / "new.db").string();
  EXPECT_TRUE(list_keys("sqlite:" + path).empty());
  EXPECT_FALSE(std::filesystem::exists(path));
  add_key("sqlite:" + path, key_of("acme").key);
  EXPECT_EQ(list_keys("sqlite:" + path).size(), 1U);
  EXPECT_EQ(std::filesystem::status(path).permissions() & std::filesystem::perms::others_all,
            std::filesystem::perms::none);
  SqliteStore store({.path = path});
  EXPECT_TRUE(store.keys(0));
}

}  // namespace
}  // namespace bahnwerk::server
