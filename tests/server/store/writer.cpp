#include "server/store/sqlite/writer.hpp"

#include <gtest/gtest.h>

#include <future>
#include <memory>
#include <vector>

#include "fixture.hpp"

namespace bahnwerk::server {
namespace {

struct WriterTest : testing::Test {
  WriterTest() { connection.execute("CREATE TABLE t(i INTEGER UNIQUE)"); }
  static Writer::Work insert(int i) {
    return [i](SqliteConnection& c) { (c.query("INSERT INTO t VALUES(?)") << std::int64_t{i}).run(); };
  }
  int rows() {
    int count = 0;
    writer.run([&](SqliteConnection& c) { count = c.query("SELECT count(*) FROM t").one_int(); });
    return count;
  }
  TempFolder folder;
  SqliteConnection connection{(folder.path / "a.db").string(), true};
  Reserve reserve{(folder.path / "reserve").string(), 0};
  std::vector<std::size_t> groups;  // works per commit; of the writer's thread
  Writer writer{connection, reserve, {[] {}, [this](double, std::size_t works) { groups.push_back(works); }}};
};

TEST_F(WriterTest, WorksThatWaitTogetherShareOneCommit) {
  std::promise<void> free;
  std::promise<void> begun;
  std::vector<std::future<void>> done;
  writer.post(
      [&](SqliteConnection&) {
        begun.set_value();
        free.get_future().wait();
      },
      [](const std::exception_ptr&) {}, Writer::frees);
  begun.get_future().wait();
  for (int i = 0; i < 5; ++i) {
    auto promise = std::make_shared<std::promise<void>>();
    done.push_back(promise->get_future());
    writer.post(
        insert(i),
        [promise](const std::exception_ptr& error) { error ? promise->set_exception(error) : promise->set_value(); },
        Writer::frees);
  }
  free.set_value();
  for (auto& each : done) each.get();
  EXPECT_EQ(writer.commits(), 2u);
  EXPECT_EQ(rows(), 5);
  EXPECT_EQ(groups.at(1), 5u);
}

TEST_F(WriterTest, AFailingWorkFailsAlone) {
  writer.run(insert(1));
  std::promise<void> free, begun, good;
  std::promise<std::exception_ptr> bad;
  writer.post(
      [&](SqliteConnection&) {
        begun.set_value();
        free.get_future().wait();
      },
      [](const std::exception_ptr&) {}, Writer::frees);
  begun.get_future().wait();
  writer.post(
      insert(1), [&](const std::exception_ptr& error) { bad.set_value(error); }, Writer::frees);
  writer.post(
      insert(2), [&](const std::exception_ptr& error) { error ? good.set_exception(error) : good.set_value(); },
      Writer::frees);
  free.set_value();
  EXPECT_NE(bad.get_future().get(), nullptr) << "it is there already";
  EXPECT_NO_THROW(good.get_future().get());
  EXPECT_EQ(rows(), 2);
  EXPECT_THROW(writer.run(insert(2)), StoreError);
  EXPECT_FALSE(writer.full());
}

TEST_F(WriterTest, WhatRunsOutsideMakesItsOwnTransactions) {
  writer.outside([](SqliteConnection& c) {
    c.execute("BEGIN");
    c.execute("INSERT INTO t VALUES(7)");
    c.execute("COMMIT");
    c.execute("PRAGMA wal_checkpoint(TRUNCATE)");
  });
  EXPECT_EQ(rows(), 1);
  EXPECT_THROW(writer.run([](SqliteConnection& c) { c.execute("BEGIN"); }), StoreError)
      << "inside there is one already";
  EXPECT_EQ(rows(), 1);
}

}  // namespace
}  // namespace bahnwerk::server
