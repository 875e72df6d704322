#include "server/runtime/memory.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "../store/fixture.hpp"
#include "core/numeric/large_pages.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::size_t mib = std::size_t{1} << 20;

/// A root folder with the files of a host.
struct Host {
  void file(const std::string& path, const std::string& text) const {
    std::filesystem::create_directories((folder.path / path).parent_path());
    std::ofstream(folder.path / path) << text;
  }
  TempFolder folder;
};

TEST(MemoryOfHost, IsTheSmallestLimitOfTheGroupAndThoseAboveIt) {
  const Host host;
  const std::size_t machine = memory_of_host(host.folder.path);
  EXPECT_GT(machine, 64 * mib) << "without groups: the machine's";
  host.file("proc/self/cgroup", "0::/system.slice/bahnwerk.service\n");
  host.file("sys/fs/cgroup/system.slice/bahnwerk.service/memory.max", "max\n");
  EXPECT_EQ(memory_of_host(host.folder.path), machine);
  host.file("sys/fs/cgroup/system.slice/memory.max", "50331648\n");
  EXPECT_EQ(memory_of_host(host.folder.path), 48 * mib);
  host.file("sys/fs/cgroup/system.slice/bahnwerk.service/memory.max", "33554432\n");
  EXPECT_EQ(memory_of_host(host.folder.path), 32 * mib);
}

TEST(MemoryOfHost, KnowsGroupsOfVersion1AndOfContainers) {
  const Host host;
  host.file("proc/self/cgroup", "9:name=systemd:/\n4:cpu,memory:/docker/5f03\n");
  host.file("sys/fs/cgroup/memory/memory.limit_in_bytes",
            "16777216\n");  // the container sees its own group as the root
  EXPECT_EQ(memory_of_host(host.folder.path), 16 * mib);
}

TEST(DefaultMemoryLimit, IsThreeQuartersButEnoughToServe) {
  EXPECT_EQ(default_memory_limit(4096 * mib), 3072 * mib);
  EXPECT_EQ(default_memory_limit(64 * mib), min_memory);
}

TEST(MemoryReserve, IsSmallAgainstTheLimit) {
  EXPECT_EQ(memory_reserve(256 * mib), 16 * mib);
  EXPECT_EQ(memory_reserve(4096 * mib), 32 * mib);
}

TEST(MemoryUse, MarksItsThreadWhileItLives) {
  EXPECT_FALSE(uses_memory());
  {
    const MemoryUse outer;
    { const MemoryUse inner; }
    EXPECT_TRUE(uses_memory());
  }
  EXPECT_FALSE(uses_memory());
}

std::size_t data_of_process() {
  std::ifstream in("/proc/self/statm");
  std::size_t number = 0;
  for (int k = 0; k < 6; ++k) in >> number;
  return number * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// Runs in a process of its own; returns its exit code.
int limited_process() {
  if (!limit_memory(data_of_process() + 128 * mib)) return 1;
  std::vector<std::unique_ptr<char[]>> blocks;
  blocks.reserve(1000);
  try {
    const MemoryUse use;
    for (;;) blocks.emplace_back(new char[mib]);
  } catch (const std::bad_alloc&) {
  }
  if (blocks.size() < 64 || blocks.size() > 128) return 2;
  if (memory_is_short()) return 3;  // a planner does not open the reserve
  try {
    blocks.emplace_back(new char[mib]);  // an answering thread does
  } catch (const std::bad_alloc&) {
    return 4;
  }
  if (!memory_is_short()) return 5;
  close_memory_reserve();
  if (!memory_is_short()) return 6;  // it is in use
  blocks.clear();
  give_back_planning_memory();
  close_memory_reserve();
  return memory_is_short() ? 7 : 0;
}

TEST(LimitMemory, PlannersEndBeforeAnsweringThreads) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer's shadow memory counts as data";
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
  GTEST_SKIP() << "a sanitizer's shadow memory counts as data";
#endif
#endif
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(_exit(limited_process()), testing::ExitedWithCode(0), "");
}

TEST(GiveBackPlanningMemory, LeavesNothingKeptForTheNextPlan) {
  { const LargeVector<double> array(1'000'000); }
  EXPECT_GT(large_pages::kept(), 0U);
  give_back_planning_memory();
  EXPECT_EQ(large_pages::kept(), 0U);
}

}  // namespace
}  // namespace bahnwerk::server
