#include "server/runtime/priority.hpp"

#include <gtest/gtest.h>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

namespace bahnwerk::server {
namespace {

int priority() { return ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid())); }

TEST(Priority, OnlyTheThreadThatAsksIsLowered) {
  const int before = priority();
  int lowered = -100;
  std::thread([&] {
    lower_priority(4);
    lowered = priority();
  }).join();
  EXPECT_EQ(lowered, std::min(19, before + 4));
  EXPECT_EQ(priority(), before);
}

TEST(Priority, StepsAddUpAndNeverRaise) {
  int before = -100, twice = -100, after = -100;
  std::thread([&] {
    before = priority();
    lower_priority(2), lower_priority(3);
    twice = priority();
    lower_priority(0), lower_priority(-5);
    after = priority();
  }).join();
  EXPECT_EQ(twice, std::min(19, before + 5));
  EXPECT_EQ(after, twice);
}

}  // namespace
}  // namespace bahnwerk::server
#endif
