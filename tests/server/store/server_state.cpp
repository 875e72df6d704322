#include "server/store/postgres/server_state.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::server {
namespace {

using namespace std::chrono_literals;

TEST(PostgresServerState, DelaysGrowToTenSecondsAndAreDrawnEvenly) {
  EXPECT_EQ(reconnection_delay(1, 1), 100ms);
  EXPECT_EQ(reconnection_delay(4, 1), 800ms);
  EXPECT_EQ(reconnection_delay(4, 0.5), 400ms);
  EXPECT_EQ(reconnection_delay(4, 0), 100ms);
  EXPECT_EQ(reconnection_delay(1000, 1), 10s);
}

TEST(PostgresServerState, OneAttemptAtATimeWhileItIsAway) {
  PostgresServerState state;
  EXPECT_EQ(state.now(), StoreState::away);
  EXPECT_NO_THROW(state.begin_attempt());
  EXPECT_THROW(state.begin_attempt(), StoreAway);
  state.failed("no answer");
  EXPECT_EQ(state.now(), StoreState::away);
  EXPECT_THROW(state.begin_attempt(), StoreAway) << "before the delay has passed";
  state.connected(false);
  EXPECT_EQ(state.now(), StoreState::up);
  EXPECT_NO_THROW(state.begin_attempt());
  EXPECT_NO_THROW(state.begin_attempt());
}

TEST(PostgresServerState, AStandbyIsReadOnlyUntilItIsPromoted) {
  PostgresServerState state;
  state.read_only(true);
  EXPECT_EQ(state.now(), StoreState::away) << "what an old connection says is no connection";
  state.connected(true);
  EXPECT_EQ(state.now(), StoreState::read_only);
  state.read_only(false);
  EXPECT_EQ(state.now(), StoreState::up);
}

}  // namespace
}  // namespace bahnwerk::server
