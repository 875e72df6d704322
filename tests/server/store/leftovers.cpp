#include "server/store/sqlite/leftovers.hpp"

#include "fixture.hpp"
#include "server/store/sqlite/migrate.hpp"

namespace bahnwerk::server {
namespace {

struct LeftoversTest : testing::Test {
  LeftoversTest() { migrate(connection); }
  /// Stores a job with that many rows of one megabyte each.
  void store(std::int64_t seq, int megabytes) {
    (connection.query("INSERT INTO jobs (seq, id, kind, priority, state, created_at) VALUES (?, ?, 'ramp', 0, "
                      "'succeeded', 1)")
     << seq << std::to_string(seq))
        .run();
    const std::string megabyte(1 << 20, 'x');
    for (std::int64_t k = 0; k < megabytes; ++k)
      (connection.query("INSERT INTO chunks (seq, first_row, row_count, data) VALUES (?, ?, 10, ?)") << seq << 10 * k)
          .blob(megabyte)
          .run();
  }
  int chunks(std::int64_t seq) {
    Query count = connection.query("SELECT count(*) FROM chunks WHERE seq = ?");
    count << seq;
    return count.one_int();
  }
  TempFolder folder;
  SqliteConnection connection{(folder.path / "store.db").string(), true};
};

TEST_F(LeftoversTest, AreFreedInPiecesAndThoseOfOthersStay) {
  store(1, 9);
  store(2, 3);
  leave_chunks(connection, "1");
  leave_chunks(connection, "1");
  EXPECT_TRUE(has_leftovers(connection, 1));
  EXPECT_FALSE(has_leftovers(connection, 2));
  EXPECT_EQ(next_leftovers(connection), 1);
  int before = chunks(1), pieces = 1;
  while (free_leftovers(connection, 1)) {
    EXPECT_LT(chunks(1), before);
    EXPECT_LE(before - chunks(1), 3) << "a piece is small";
    before = chunks(1);
    ++pieces;
  }
  EXPECT_GE(pieces, 4);
  EXPECT_EQ(chunks(1), 0);
  EXPECT_EQ(chunks(2), 3);
  EXPECT_FALSE(next_leftovers(connection));
}

TEST_F(LeftoversTest, OfAJobWithoutRowsAreNone) {
  store(1, 0);
  leave_chunks(connection, "1");
  leave_chunks(connection, "unknown");
  EXPECT_FALSE(next_leftovers(connection));
  EXPECT_FALSE(free_leftovers(connection, 1));
}

}  // namespace
}  // namespace bahnwerk::server
