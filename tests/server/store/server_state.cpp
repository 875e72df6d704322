#include "server/store/postgres/server_state.hpp"

#include <gtest/gtest.h>

#include <thread>

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
  PostgresServerState state(5min);
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
  PostgresServerState state(5min);
  state.read_only(true);
  EXPECT_EQ(state.now(), StoreState::away) << "what an old connection says is no connection";
  state.connected(true);
  EXPECT_EQ(state.now(), StoreState::read_only);
  state.read_only(false);
  EXPECT_EQ(state.now(), StoreState::up);
}

TEST(PostgresServerState, SilenceIsAnOutageAndTheStartOfTheProcessIsNone) {
  PostgresServerState patient(5min), state(0ms);
  for (PostgresServerState* each : {&patient, &state}) {
    each->connected(false);
    each->answered();
    EXPECT_FALSE(each->since_outage());
    std::this_thread::sleep_for(20ms);
    EXPECT_GE(each->unbroken(), 20ms);
    each->answered();
  }
  EXPECT_FALSE(patient.since_outage());
  ASSERT_TRUE(state.since_outage()) << "nothing was heard for longer than it may be";
  EXPECT_LE(*state.since_outage(), state.unbroken());
  patient.lost();
  EXPECT_TRUE(patient.since_outage());
}

TEST(PostgresServerState, WhereItCouldOnlyBeReadThatWasAnOutage) {
  PostgresServerState state(5min);
  state.connected(true);
  std::this_thread::sleep_for(20ms);
  EXPECT_FALSE(state.since_outage());
  state.read_only(false);
  ASSERT_TRUE(state.since_outage()) << "no lease could be renewed";
  EXPECT_LE(*state.since_outage(), state.unbroken());
}

TEST(PostgresServerState, OneCallerLooksForAServerThatCanBeWritten) {
  PostgresServerState state(5min);
  EXPECT_FALSE(state.search()) << "none is there";
  state.connected(true);
  EXPECT_TRUE(state.search());
  EXPECT_FALSE(state.search()) << "not sooner than a second later";
  state.connected(false);
  EXPECT_FALSE(state.search()) << "it is found";
}

}  // namespace
}  // namespace bahnwerk::server
