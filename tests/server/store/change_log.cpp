#include "server/store/sqlite/change_log.hpp"

#include "fixture.hpp"
#include "server/store/sqlite/connection.hpp"
#include "server/store/sqlite/migrate.hpp"

namespace bahnwerk::server {
namespace {

struct ChangeLogTest : testing::Test {
  ChangeLogTest() : connection((folder.path / "a.db").string(), true) { migrate(connection); }
  TempFolder folder;
  SqliteConnection connection;
};

TEST_F(ChangeLogTest, ListenersHearOfCommittedChangesOnly) {
  ChangeLog log;
  log.open(connection);
  std::vector<std::string> heard;
  log.listen([&](const std::vector<Changed>& list) {
    for (const Changed& changed : list) heard.push_back(std::to_string(changed.sequence) + changed.id);
  });
  log.begin();
  log.note(log.next(), "lost", api::JobState::queued);
  log.begin();  // in place of one that failed
  log.note(log.next(), "a", api::JobState::queued);
  log.note(log.next(), "b", std::nullopt);
  EXPECT_TRUE(heard.empty());
  log.committed();
  log.committed();
  EXPECT_EQ(heard, (std::vector<std::string>{"2a", "3b"})) << "numbers of a failed transaction are not used again";
  log.listen(nullptr);
  log.begin();
  log.note(log.next(), "c", std::nullopt);
  log.committed();
  EXPECT_EQ(heard.size(), 2u);
}

TEST_F(ChangeLogTest, NumbersGoOnAfterTheLastOneOfTheDatabase) {
  EXPECT_EQ(last_change(connection), 0u);
  keep_removal(connection, 41, "gone", {});
  EXPECT_EQ(last_change(connection), 41u);
  ChangeLog log;
  log.open(connection);
  EXPECT_EQ(log.next(), 42);
}

TEST_F(ChangeLogTest, RemovalsAreForgottenFromTheOldestOnAndThatIsTold) {
  for (int i = 1; i <= 1030; ++i) keep_removal(connection, i, "job" + std::to_string(i), {});
  EXPECT_EQ(last_change(connection), 1030u);
  const Changes all = changes_since(connection, 0, 2000, {});
  EXPECT_EQ(all.list.size(), 1024u);
  EXPECT_TRUE(all.gap);
  EXPECT_EQ(all.list.front().sequence, 7u);
  EXPECT_EQ(all.list.front().id, "job7");
  EXPECT_EQ(all.list.front().state, std::nullopt);
  const Changes late = changes_since(connection, 1000, 5, {});
  EXPECT_FALSE(late.gap);
  ASSERT_EQ(late.list.size(), 5u);
  EXPECT_EQ(late.list.front().sequence, 1001u);
  EXPECT_TRUE(changes_since(connection, 1030, 5, {}).list.empty());
}

}  // namespace
}  // namespace bahnwerk::server
