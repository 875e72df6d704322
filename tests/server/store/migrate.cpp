#include "server/store/sqlite/migrate.hpp"

#include "fixture.hpp"
#include "server/store/sqlite/connection.hpp"

namespace bahnwerk::server {
namespace {

int version(SqliteConnection& connection) { return connection.query("PRAGMA user_version").one_int(); }

TEST(Migrate, NumbersRunFromOneWithoutAGap) {
  int number = 0;
  for (const Migration& migration : migrations()) {
    EXPECT_EQ(migration.number, ++number);
    EXPECT_FALSE(migration.name.empty());
  }
  EXPECT_GT(number, 0);
}

TEST(Migrate, AnEmptyDatabaseComesUpToDateOnce) {
  const TempFolder folder;
  SqliteConnection connection((folder.path / "a.db").string(), true);
  EXPECT_EQ(version(connection), 0);
  migrate(connection);
  EXPECT_EQ(version(connection), static_cast<int>(migrations().size()));
  const int tables = connection.query("SELECT count(*) FROM sqlite_master").one_int();
  EXPECT_GT(tables, 0);
  migrate(connection);
  EXPECT_EQ(connection.query("SELECT count(*) FROM sqlite_master").one_int(), tables);
}

TEST(Migrate, ADatabaseOfAnOlderVersionGoesOnWhereItIs) {
  const TempFolder folder;
  SqliteConnection connection((folder.path / "a.db").string(), true);
  connection.execute(migrations().front().sql);
  connection.execute("PRAGMA user_version = 1");
  migrate(connection);
  EXPECT_EQ(version(connection), static_cast<int>(migrations().size()));
}

TEST(Migrate, ADatabaseOfANewerVersionIsLeftAlone) {
  const TempFolder folder;
  SqliteConnection connection((folder.path / "a.db").string(), true);
  connection.execute("PRAGMA user_version = 999");
  EXPECT_THROW(migrate(connection), StoreError);
  EXPECT_EQ(version(connection), 999);
  EXPECT_EQ(connection.query("SELECT count(*) FROM sqlite_master").one_int(), 0);
}

}  // namespace
}  // namespace bahnwerk::server
