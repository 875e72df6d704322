#include "server/runtime/pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>

namespace bahnwerk::server {
namespace {

using namespace std::chrono_literals;

TEST(Pool, AllPostedWorkRunsBeforeThePoolIsGone) {
  std::atomic<int> ran = 0;
  {
    Pool pool(3);
    for (int i = 0; i < 500; ++i) pool.post([&] { ++ran; });
  }
  EXPECT_EQ(ran, 500);
}

TEST(Pool, JoinWaitsForPostedWork) {
  std::atomic<int> ran = 0;
  Pool pool(2);
  for (int i = 0; i < 50; ++i) pool.post([&] { ++ran; });
  pool.join();
  EXPECT_EQ(ran, 50);
}

TEST(Pool, IsNotIdleWhileWorkRuns) {
  Pool pool(1);
  std::promise<void> gate;
  pool.post([wait = gate.get_future().share()] { wait.wait(); });
  EXPECT_FALSE(pool.wait_idle(5ms));
  gate.set_value();
  EXPECT_TRUE(pool.wait_idle(60s));
}

TEST(Pool, AsManyTasksRunAtOnceAsThereAreThreads) {
  // Each of three tasks ends only when all three have begun.
  Pool pool(3);
  std::atomic<int> begun = 0;
  for (int i = 0; i < 3; ++i)
    pool.post([&] {
      ++begun;
      for (int n = begun; n < 3; n = begun) begun.wait(n);
      begun.notify_all();
    });
  EXPECT_TRUE(pool.wait_idle(60s));
}

}  // namespace
}  // namespace bahnwerk::server
