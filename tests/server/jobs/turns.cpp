#include "server/jobs/turns.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <new>
#include <stdexcept>
#include <thread>

namespace bahnwerk::server {
namespace {

using namespace std::chrono_literals;
const auto nothing = [] {};

template <class Condition>
bool soon(Condition condition) {
  for (int i = 0; i < 15'000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(2ms);
  }
  return false;
}

TEST(Turns, AWorkWithoutCompanyThatFindsNoMemoryIsNotRepeated) {
  Turns turns;
  int runs = 0;
  const auto work = [&] {
    ++runs;
    throw std::bad_alloc();
  };
  EXPECT_THROW(turns.run(work, nothing, nothing), std::bad_alloc);
  EXPECT_EQ(runs, 1);
  EXPECT_THROW(turns.run([] { throw std::runtime_error("no plan"); }, nothing, nothing), std::runtime_error);
}

TEST(Turns, AWorkWhoseMemoryRanOutBesideAnotherIsRunAgainAlone) {
  Turns turns;
  std::atomic<bool> release{false}, other_runs{false}, asked{false};
  std::atomic<int> runs{0}, prepared{0};
  const auto other = std::async(std::launch::async, [&] {
    turns.run(
        [&] {
          other_runs = true;
          EXPECT_TRUE(soon([&] { return release.load(); }));
          other_runs = false;
        },
        nothing, nothing);
  });
  ASSERT_TRUE(soon([&] { return other_runs.load(); }));
  const auto work = std::async(std::launch::async, [&] {
    turns.run(
        [&] {
          if (++runs == 1) throw std::bad_alloc();
          EXPECT_FALSE(other_runs);
        },
        [&] { asked = true; }, [&] { ++prepared; });
  });
  EXPECT_TRUE(soon([&] { return asked.load(); })) << "it waits, and asks meanwhile";
  EXPECT_EQ(runs, 1);
  bool late_ran = false;
  const auto late = std::async(std::launch::async, [&] {
    turns.run([&] { late_ran = runs == 2; }, nothing, nothing);  // begun after the one that waits
  });
  release = true;
  work.wait();
  late.wait();
  EXPECT_EQ(runs, 2);
  EXPECT_EQ(prepared, 1);
  EXPECT_TRUE(late_ran);
}

TEST(Turns, TwoThatFindNoMemoryTogetherAreRunOneAfterTheOther) {
  Turns turns;
  std::atomic<int> together{0}, most_alone{0}, alone{0};
  const auto greedy = [&] {
    bool first = true;
    turns.run(
        [&] {
          if (std::exchange(first, false)) {
            ++together;
            EXPECT_TRUE(soon([&] { return together == 2; }));
            throw std::bad_alloc();
          }
          most_alone = std::max(most_alone.load(), ++alone);
          std::this_thread::yield();
          --alone;
        },
        nothing, nothing);
  };
  const auto a = std::async(std::launch::async, greedy), b = std::async(std::launch::async, greedy);
  a.wait();
  b.wait();
  EXPECT_EQ(most_alone, 1);
}

TEST(Turns, WhatTheQuestionThrowsEndsTheWait) {
  Turns turns;
  std::promise<void> release;
  std::atomic<bool> runs{false};
  const auto other = std::async(std::launch::async, [&] {
    turns.run(
        [&] {
          runs = true;
          release.get_future().wait();
        },
        nothing, nothing);
  });
  ASSERT_TRUE(soon([&] { return runs.load(); }));
  EXPECT_THROW(turns.run([] { throw std::bad_alloc(); }, [] { throw std::runtime_error("cancelled"); }, nothing),
               std::runtime_error);
  turns.run(nothing, nothing, nothing);  // nobody waits any more
  release.set_value();
}

}  // namespace
}  // namespace bahnwerk::server
