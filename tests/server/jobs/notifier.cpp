#include "server/jobs/notifier.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>

#include "../manual_time.hpp"

namespace bahnwerk::server {
namespace {

using namespace std::chrono_literals;
using Clock = Notifier::Clock;

TEST(Notifier, CallsOnceWhenTheJobChanges) {
  std::atomic<int> mine{0}, others{0};  // the notifier calls whoever still waits at its end
  Notifier notifier;
  notifier.wait("a", Clock::now() + 1h, [&] { ++mine; });
  notifier.wait("a", Clock::now() + 1h, [&] { ++mine; });
  notifier.wait("b", Clock::now() + 1h, [&] { ++others; });
  notifier.changed("a");
  notifier.changed("a");
  EXPECT_EQ(mine, 2);
  EXPECT_EQ(others, 0);
}

TEST(Notifier, CallsWhenTheTimeIsOver) {
  std::promise<void> late, early;
  const auto start = Clock::now();
  Notifier notifier;
  notifier.wait("a", start + 1h, [] {});
  notifier.wait("a", start + 60ms, [&] { late.set_value(); });
  notifier.wait("a", start + 20ms, [&] { early.set_value(); });  // becomes the next deadline
  early.get_future().wait();
  EXPECT_GE(Clock::now() - start, 20ms);
  late.get_future().wait();
  EXPECT_GE(Clock::now() - start, 60ms);
}

TEST(Notifier, CallsInTheOrderOfTheirTimes) {
  ManualTime time;
  std::promise<void> early, late;
  std::atomic<bool> late_called{false};
  Notifier notifier(time);
  notifier.wait("a", time.now() + 60ms, [&] {
    late_called = true;
    late.set_value();
  });
  notifier.wait("a", time.now() + 20ms, [&] { early.set_value(); });
  time.advance(59ms);
  early.get_future().wait();
  EXPECT_FALSE(late_called);
  time.advance(1ms);
  late.get_future().wait();
}

TEST(Notifier, ProgressWakesWhomItConcernsAndNotTooEarly) {
  std::atomic<int> end{0}, soon{0}, later{0};
  std::promise<void> due;
  ManualTime time;
  Notifier notifier(time);
  const auto start = time.now();
  notifier.wait("a", start + 1h, [&] { ++end; });
  notifier.wait(
      "a", start + 1h, [&] { ++soon; }, start);
  notifier.wait(
      "a", start + 1h,
      [&] {
        ++later;
        due.set_value();
      },
      start + 80ms);
  notifier.changed("a", Change::progress);
  EXPECT_EQ(soon, 1);
  EXPECT_EQ(end, 0);
  time.advance(79ms);
  notifier.changed("a", Change::progress);
  EXPECT_EQ(later, 0) << "too early";
  time.advance(1ms);
  due.get_future().wait();  // without another change
  EXPECT_EQ(later, 1);
  EXPECT_EQ(end, 0) << "waits for the state";
  notifier.changed("a");
  EXPECT_EQ(end, 1);
}

TEST(Notifier, WakesByToken) {
  int calls = 0;
  Notifier notifier;
  const auto token = notifier.wait("a", Clock::now() + 1h, [&] { ++calls; });
  notifier.wake(token);
  notifier.wake(token);
  notifier.changed("a");
  EXPECT_EQ(calls, 1);
}

TEST(Notifier, CallsAllWhenChangesMayHaveBeenMissed) {
  int calls = 0;
  Notifier notifier;
  notifier.wait("a", Clock::now() + 1h, [&] { ++calls; });
  notifier.wait("b", Clock::now() + 1h, [&] { ++calls; });
  notifier.all_changed();
  EXPECT_EQ(calls, 2);
  notifier.wait("a", Clock::now() + 1h, [&] { ++calls; });
  EXPECT_EQ(calls, 2) << "the next one waits again";
}

TEST(Notifier, ReleasesAllAtTheEnd) {
  int calls = 0;
  {
    Notifier notifier;
    notifier.wait("a", Clock::now() + 1h, [&] { ++calls; });
    notifier.release();
    EXPECT_EQ(calls, 1);
    notifier.wait("a", Clock::now() + 1h, [&] { ++calls; });
    EXPECT_EQ(calls, 2) << "nobody waits any more";
  }
  {
    Notifier notifier;
    notifier.wait("a", Clock::now() + 1h, [&] { ++calls; });
  }
  EXPECT_EQ(calls, 3);
}

TEST(Notifier, LosesNobodyUnderLoad) {
  std::atomic<int> calls{0};
  constexpr int threads = 4, each = 500;
  {
    Notifier notifier;
    std::vector<std::thread> list;
    for (int t = 0; t < threads; ++t)
      list.emplace_back([&, t] {
        for (int i = 0; i < each; ++i) {
          const std::string job = std::to_string((t + i) % 5);
          const auto token =
              notifier.wait(job, Clock::now() + std::chrono::microseconds(i * 7 % 900), [&] { ++calls; });
          if (i % 3 == 0) notifier.changed(job);
          if (i % 5 == 0) notifier.wake(token);
        }
      });
    for (auto& thread : list) thread.join();
  }
  EXPECT_EQ(calls, threads * each);
}

}  // namespace
}  // namespace bahnwerk::server
