#include "server/store/sqlite/connection.hpp"

#include <gtest/gtest.h>

#include "fixture.hpp"

namespace bahnwerk::server {
namespace {

constexpr const char* insertion = "INSERT INTO t VALUES(?,?,?,?)";

struct Database {
  TempFolder folder;
  std::string path = (folder.path / "a.db").string();
  SqliteConnection connection{path, true};
  Database() { connection.execute("CREATE TABLE t(i INTEGER UNIQUE, x REAL, s TEXT, b BLOB)"); }
  void add(std::int64_t i) {
    Query query = connection.query(insertion);
    query << i << 0.5 << std::string("text");
    query.blob("");
    EXPECT_EQ(query.run(), 1);
  }
  int rows() { return connection.query("SELECT count(*) FROM t").one_int(); }
};

TEST(SqliteConnection, ValuesComeBackAsTheyWereBoundAndAbsentOnesAreNull) {
  Database db;
  const std::string bytes("a\0b", 3);
  {
    Query query = db.connection.query(insertion);
    query << (std::int64_t{1} << 60) << 0.1 << std::string("ü");
    query.blob(bytes);
    EXPECT_EQ(query.run(), 1);
  }
  {
    Query query = db.connection.query(insertion);  // the same statement, without its bindings
    query << std::optional<std::int64_t>() << std::optional<double>() << std::optional<std::string>();
    EXPECT_EQ(query.run(), 1);
  }
  Query rows = db.connection.query("SELECT i, x, s, b FROM t ORDER BY rowid");
  ASSERT_TRUE(rows.step());
  EXPECT_EQ(rows.integer(0), std::int64_t{1} << 60);
  EXPECT_EQ(rows.number(1), 0.1);
  EXPECT_EQ(rows.text(2), "ü");
  EXPECT_EQ(rows.bytes(3), bytes);
  EXPECT_EQ(rows.optional_text(2), "ü");
  ASSERT_TRUE(rows.step());
  EXPECT_TRUE(rows.null(0));
  EXPECT_EQ(rows.optional_integer(0), std::nullopt);
  EXPECT_EQ(rows.optional_text(2), std::nullopt);
  EXPECT_TRUE(rows.null(3)) << "not bound";
  EXPECT_FALSE(rows.step());
}

TEST(SqliteConnection, ATransactionIsRolledBackAndAReaderSeesWhatIsCommitted) {
  Database db;
  SqliteConnection reader(db.path, false);
  db.connection.execute("BEGIN IMMEDIATE");
  db.add(1);
  EXPECT_EQ(reader.query("SELECT count(*) FROM t").one_int(), 0);
  db.connection.rollback();
  EXPECT_EQ(db.rows(), 0);
  db.connection.rollback();  // none is open
  db.add(2);
  EXPECT_EQ(reader.query("SELECT count(*) FROM t").one_int(), 1);
  EXPECT_THROW(reader.execute("DELETE FROM t"), StoreError);
}

TEST(SqliteConnection, FaultsAreTheStoresAndSayWhetherTheDiskIsFull) {
  Database db;
  db.add(1);
  const auto full = [](const auto& call) {
    try {
      call();
    } catch (const StoreError& error) {
      return error.full;
    }
    ADD_FAILURE() << "no error";
    return false;
  };
  EXPECT_FALSE(full([&] { db.connection.execute("INSERT INTO t(i) VALUES(1)"); })) << "not unique";
  EXPECT_FALSE(full([&] { db.connection.query("SELECT nothing FROM nowhere"); }));
  SqliteConnection small(db.path, true, 3);
  EXPECT_TRUE(full([&] {
    small.execute(
        "INSERT INTO t(s) WITH RECURSIVE n(k) AS (SELECT 1 UNION ALL SELECT k+1 FROM n WHERE k<999) "
        "SELECT hex(randomblob(500)) FROM n");
  }));
  EXPECT_EQ(db.rows(), 1);
}

}  // namespace
}  // namespace bahnwerk::server
