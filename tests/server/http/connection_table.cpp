#include "server/http/connection_table.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::server {
namespace {

using Place = ConnectionTable::Place;
using Phase = ConnectionTable::Phase;
using namespace std::chrono_literals;

struct ConnectionTableTest : testing::Test {
  ConnectionTable::Time now{};
  ConnectionTable::Admission admit(ConnectionTable& table, const std::string& address = "a") {
    return table.admit(address, now += 1ms);
  }
  ConnectionTable::Id regular(ConnectionTable& table, const std::string& address = "a") {
    const auto admission = admit(table, address);
    EXPECT_EQ(admission.place, Place::regular);
    EXPECT_FALSE(admission.leave);
    return admission.id;
  }
};

TEST_F(ConnectionTableTest, LongestWaitingMakesRoom) {
  ConnectionTable table({.most = 3, .max_per_address = 0, .spare = 1});
  const auto first = regular(table), second = regular(table), third = regular(table);
  table.enter(first, Phase::busy, now += 1ms);
  table.enter(second, Phase::waiting, now += 1ms);  // between two requests: its wait begins anew
  auto next = admit(table);
  EXPECT_EQ(next.place, Place::regular);
  EXPECT_EQ(next.leave, third);
  next = admit(table);
  EXPECT_EQ(next.leave, second) << "the one that leaves does not count any more, and is not named twice";
  table.remove(third);
  table.remove(second);
  EXPECT_EQ(table.size(), 3U);
}

TEST_F(ConnectionTableTest, SparesWhereAllAreBusy) {
  ConnectionTable table({.most = 2, .max_per_address = 0, .spare = 2});
  for (int i = 0; i < 2; ++i) table.enter(regular(table), Phase::busy, now);
  const auto first = admit(table), second = admit(table);
  EXPECT_EQ(first.place, Place::spare);
  EXPECT_EQ(second.place, Place::spare);
  const auto third = admit(table);
  EXPECT_EQ(third.place, Place::spare);
  EXPECT_EQ(third.leave, first.id) << "whoever holds a spare place without asking loses it to the next";
  table.enter(second.id, Phase::busy, now);
  table.enter(third.id, Phase::busy, now);
  EXPECT_EQ(admit(table).place, Place::none);
}

TEST_F(ConnectionTableTest, AnAddressGivesUpItsOwn) {
  ConnectionTable table({.most = 10, .max_per_address = 2, .spare = 4});
  const auto other = regular(table, "b");
  const auto first = regular(table), second = regular(table);
  EXPECT_EQ(admit(table).leave, first) << "although b waits longer";
  table.enter(second, Phase::busy, now);
  const auto fourth = admit(table);
  EXPECT_EQ(fourth.place, Place::regular);
  table.enter(fourth.id, Phase::busy, now);
  EXPECT_EQ(admit(table).place, Place::spare) << "all of its own are busy";
  EXPECT_EQ(admit(table, "b").place, Place::regular);
  table.remove(other);
  table.remove(fourth.id);
  EXPECT_EQ(admit(table).place, Place::regular);
}

TEST_F(ConnectionTableTest, ABodyThatStandsStillMakesRoom) {
  ConnectionTable table({.most = 2, .max_per_address = 0, .spare = 1, .stalled = 100ms});
  const auto slow = regular(table), quick = regular(table);
  table.enter(slow, Phase::body, now);
  table.enter(quick, Phase::body, now += 1ms);
  EXPECT_EQ(admit(table).place, Place::spare);
  table.enter(quick, Phase::body, now += 99ms);
  const auto next = admit(table);
  EXPECT_EQ(next.place, Place::regular);
  EXPECT_EQ(next.leave, slow);
}

TEST_F(ConnectionTableTest, ABodyThatTricklesMakesRoomAndAQuickOneDoesNot) {
  ConnectionTable table({.most = 2, .max_per_address = 0, .spare = 1, .stalled = 100ms});
  const auto trickling = regular(table), quick = regular(table);
  const auto begin = now;
  std::chrono::milliseconds slow{0}, fast{0};  // what the bytes so far allow
  for (int k = 0; k < 150; ++k) {
    now += 1ms;
    if (k % 50 == 0) slow += 1ms;
    fast += 2ms;
    table.enter(trickling, Phase::body, ConnectionTable::body_since(begin, slow, now));
    table.enter(quick, Phase::body, ConnectionTable::body_since(begin, fast, now));
  }
  const auto next = admit(table);
  EXPECT_EQ(next.place, Place::regular);
  EXPECT_EQ(next.leave, trickling) << "although its last byte came a moment ago";
  EXPECT_EQ(admit(table).leave, next.id) << "the quick one keeps its place";
}

TEST_F(ConnectionTableTest, TakesNoEndOfThem) {
  ConnectionTable table({.most = 5, .max_per_address = 0, .spare = 1});
  std::size_t taken = 0;
  for (int i = 0; i < 100; ++i) taken += admit(table).place != Place::none;
  EXPECT_EQ(taken, 11U) << "those that were asked to leave still hold their sockets";
}

TEST_F(ConnectionTableTest, NamesOneForWantOfDescriptors) {
  ConnectionTable table({.most = 5, .max_per_address = 0, .spare = 1});
  EXPECT_FALSE(table.longest_waiting(now));
  const auto first = regular(table), second = regular(table);
  EXPECT_EQ(table.longest_waiting(now), first);
  EXPECT_EQ(table.longest_waiting(now), second);
  EXPECT_FALSE(table.longest_waiting(now));
}

TEST_F(ConnectionTableTest, TheOldestListenerEndsWhenMoreThanThreeQuartersListen) {
  ConnectionTable table({.most = 8, .max_per_address = 0, .spare = 1});
  std::vector<ConnectionTable::Id> ids;
  for (int i = 0; i < 8; ++i) ids.push_back(regular(table));
  for (std::size_t i = 0; i < 6; ++i) EXPECT_FALSE(table.enter(ids[i], Phase::listening, now += 1ms));
  EXPECT_EQ(table.enter(ids[6], Phase::listening, now += 1ms), ids[0]);
  EXPECT_EQ(table.enter(ids[7], Phase::listening, now += 1ms), ids[1]) << "the first one is not named twice";
  EXPECT_FALSE(table.enter(ids[0], Phase::busy, now += 1ms));
  EXPECT_FALSE(table.enter(ids[2], Phase::waiting, now += 1ms));
  EXPECT_FALSE(table.enter(ids[2], Phase::listening, now += 1ms)) << "there is room again";
  EXPECT_EQ(admit(table).place, Place::spare) << "listeners are not closed in favour of new connections";
}

TEST_F(ConnectionTableTest, AnAddressHasListenersOnThreeQuartersOfItsOwn) {
  ConnectionTable table({.most = 100, .max_per_address = 4, .spare = 1});
  const auto other = regular(table, "b");
  EXPECT_FALSE(table.enter(other, Phase::listening, now += 1ms));
  std::vector<ConnectionTable::Id> ids;
  for (int i = 0; i < 4; ++i) ids.push_back(regular(table));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FALSE(table.enter(ids[i], Phase::listening, now += 1ms));
  EXPECT_EQ(table.enter(ids[3], Phase::listening, now += 1ms), ids[0]) << "not that of b, which is older";
}

TEST_F(ConnectionTableTest, AProxysConnectionCountsForTheClientThatItAsksFor) {
  ConnectionTable table({.most = 10, .max_per_address = 1, .spare = 1});
  const auto one = regular(table, ""), two = regular(table, ""), direct = regular(table, "b");
  EXPECT_TRUE(table.assign(one, "a", now));
  EXPECT_TRUE(table.assign(one, "a", now));
  EXPECT_FALSE(table.assign(two, "a", now));
  EXPECT_FALSE(table.assign(two, "b", now));
  table.remove(direct);
  EXPECT_TRUE(table.assign(two, "b", now));
  EXPECT_TRUE(table.assign(one, "", now));
  EXPECT_TRUE(table.assign(two, "a", now));
  table.remove(one);
  table.remove(two);
  EXPECT_EQ(table.size(), 0U);
}

}  // namespace
}  // namespace bahnwerk::server
