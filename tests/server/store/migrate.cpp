#include "server/store/sqlite/migrate.hpp"

#include "fixture.hpp"
#include "server/store/open.hpp"
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

TEST(Migrate, ANewerDatabaseIsUsedAsItIsIfThisVersionIsNotBelowItsLeastReader) {
  const TempFolder folder;
  SqliteConnection connection((folder.path / "a.db").string(), true);
  migrate(connection);
  const int known = version(connection);
  connection.execute(("PRAGMA user_version = " + std::to_string(known + 1)).c_str());
  EXPECT_THROW(migrate(connection), StoreError) << "it does not say who may use it";
  connection.execute(
      ("INSERT INTO schema_version VALUES (" + std::to_string(known + 1) + ", " + std::to_string(known) + ")").c_str());
  migrate(connection);
  require_up_to_date(connection);
  EXPECT_EQ(version(connection), known + 1);
  connection.execute(("UPDATE schema_version SET min_reader = " + std::to_string(known + 1)).c_str());
  EXPECT_THROW(migrate(connection), StoreError);
}

TEST(Migrate, AnOlderDatabaseIsRefusedWhereItMayNotBeChanged) {
  const TempFolder folder;
  const std::string url = "sqlite:" + (folder.path / "a.db").string();
  const auto open = [&](bool migrates) {
    SharedStoreOptions options;
    options.migrate = migrates;
    open_store(
        url, [](double, std::size_t) {}, 0, {}, options);
  };
  EXPECT_THROW(open(false), StoreError) << "there is no schema";
  EXPECT_EQ(migrate_store(url), static_cast<int>(migrations().size()));
  EXPECT_NO_THROW(open(false));
  const auto store = open_store(url, [](double, std::size_t) {});
  EXPECT_THROW(migrate_store(url), StoreError) << "a service has it";
}

}  // namespace
}  // namespace bahnwerk::server
