#include "server/runtime/look_thread.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>

#include "../manual_time.hpp"

namespace bahnwerk::server {
namespace {

using namespace std::chrono_literals;

template <class Condition>
bool soon(Condition condition) {
  for (int i = 0; i < 15'000 && !condition(); ++i) std::this_thread::sleep_for(2ms);
  return condition();
}

TEST(LookThread, LooksAtOnceThenWhenTheTimeOfTheLastLookHasPassed) {
  ManualTime time;
  std::atomic<int> looks{0};
  const LookThread thread(
      [&] {
        ++looks;
        return 100ms;
      },
      time);
  EXPECT_TRUE(soon([&] { return looks == 1; }));
  time.advance(99ms);
  EXPECT_EQ(looks, 1);
  time.advance(1ms);
  EXPECT_TRUE(soon([&] { return looks == 2; }));
}

TEST(LookThread, ANotificationDuringALookIsNotMissed) {
  ManualTime time;
  std::atomic<int> looks{0};
  std::promise<void> go;
  LookThread thread(
      [&] {
        if (++looks == 1) go.get_future().wait();
        return 1h;
      },
      time);
  EXPECT_TRUE(soon([&] { return looks == 1; }));
  thread.notify();
  go.set_value();
  EXPECT_TRUE(soon([&] { return looks == 2; }));
}

TEST(LookThread, NoLookBeginsAfterItsEnd) {
  ManualTime time;
  std::atomic<int> looks{0};
  LookThread thread(
      [&] {
        ++looks;
        return 100ms;
      },
      time);
  thread.stop();
  const int before = looks;
  thread.notify();
  time.advance(1h);
  thread.stop();
  EXPECT_EQ(looks, before);
}

}  // namespace
}  // namespace bahnwerk::server
