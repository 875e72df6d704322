#include "server/runtime/clock.hpp"

#include <gtest/gtest.h>

namespace bahnwerk::server {
namespace {

using namespace std::chrono_literals;

TEST(Clock, TimeOfDayIsThatOfTheSystemsClock) {
  const auto ms = [] {
    return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::system_clock::now().time_since_epoch())
        .count();
  };
  const std::int64_t before = ms(), now = system_time().now_ms(), after = ms();
  EXPECT_LE(before, now);
  EXPECT_LE(now, after);
}

TEST(Clock, SecondsCountFromTheGivenStart) {
  const auto start = std::chrono::steady_clock::now() - 90s;
  const double first = seconds_since(start), second = seconds_since(start);
  EXPECT_GE(first, 90);
  EXPECT_LE(first, second);
  EXPECT_LT(seconds_since(std::chrono::steady_clock::now() + 1h), 0);
}

TEST(Clock, AWaitForATimeThatIsOverReturnsWithTheLock) {
  std::mutex mutex;
  std::condition_variable signal;
  std::unique_lock lock(mutex);
  system_time().wait_until(lock, signal, system_time().now() - 1s);
  EXPECT_TRUE(lock.owns_lock());
}

}  // namespace
}  // namespace bahnwerk::server
