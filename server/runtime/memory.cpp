#include "server/runtime/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <fstream>
#include <mutex>
#include <new>
#include <string>

#include "core/numeric/large_pages.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace bahnwerk::server {
namespace {

namespace fs = std::filesystem;

thread_local bool marked = false;
std::atomic<bool> limited{false}, reserve_open{false};
std::size_t limit_bytes = 0;  // constant once `limited` is set

/// Reads a number; nullopt for a missing file and for "max".
std::optional<std::size_t> number_in(const fs::path& file) {
  std::ifstream in(file);
  std::size_t value = 0;
  return in >> value ? std::optional(value) : std::nullopt;
}

/// Returns the smallest limit of a group and of those above it. In a container the group's own path may not be
/// visible: the groups above it that are, are its own.
std::size_t smallest_limit(const fs::path& tree, fs::path group, const char* file, std::size_t least) {
  for (;;) {
    if (const auto value = number_in(tree / group.relative_path() / file)) least = std::min(least, *value);
    if (!group.has_relative_path()) return least;
    group = group.parent_path();
  }
}

bool set_limit(std::size_t bytes) noexcept {
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0) return false;
  limit.rlim_cur = std::min(static_cast<rlim_t>(bytes), limit.rlim_max);
  return setrlimit(RLIMIT_DATA, &limit) == 0;
}

/// Returns the bytes that the limit counts; no allocation here.
std::size_t counted_bytes() noexcept {
  std::size_t pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%*u %*u %*u %*u %*u %zu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// Called by operator new when there is no memory.
void when_memory_is_short() {
  if (marked || reserve_open) throw std::bad_alloc();
  open_memory_reserve();
}

}  // namespace

std::size_t memory_of_host(const fs::path& root) {
  const auto pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  std::size_t least = static_cast<std::size_t>(pages) * static_cast<std::size_t>(page);
  std::ifstream groups(root / "proc/self/cgroup");  // lines "4:memory:/path" (version 1), "0::/path" (version 2)
  for (std::string line; std::getline(groups, line);) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const fs::path group = line.substr(second + 1);
    if (controllers == ",,")
      least = smallest_limit(root / "sys/fs/cgroup", group, "memory.max", least);
    else if (controllers.find(",memory,") != std::string::npos)
      least = smallest_limit(root / "sys/fs/cgroup/memory", group, "memory.limit_in_bytes", least);
  }
  return least;
}

std::size_t default_memory_limit(std::size_t host) { return std::max(host / 4 * 3, min_memory); }

std::size_t memory_reserve(std::size_t bytes) { return std::min(bytes / 16, std::size_t{32} << 20); }

std::size_t memory_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0 || limit.rlim_max == RLIM_INFINITY) return 0;
  return static_cast<std::size_t>(limit.rlim_max);
}

bool limit_memory(std::size_t bytes) {
  // A sanitizer has mapped more than any limit: nothing could be allocated below it.
  if (counted_bytes() > bytes) return false;
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0) return false;
  limit.rlim_max = std::min(static_cast<rlim_t>(bytes), limit.rlim_max);
  limit_bytes = static_cast<std::size_t>(limit.rlim_max);
  limit.rlim_cur = limit.rlim_max - memory_reserve(limit_bytes);
  if (setrlimit(RLIMIT_DATA, &limit) != 0) return false;
#ifdef __GLIBC__
  // What one thread has freed must be there for all: a heap per thread would keep it, and count as data.
  ::mallopt(M_ARENA_MAX, 1);
#endif
  limited = true;
  std::set_new_handler(when_memory_is_short);
  return true;
}

MemoryUse::MemoryUse() : before_(marked) { marked = true; }
MemoryUse::~MemoryUse() { marked = before_; }

bool uses_memory() noexcept { return marked; }

bool memory_is_short() noexcept { return reserve_open.load(std::memory_order_relaxed); }

void open_memory_reserve() noexcept {
  if (limited && set_limit(limit_bytes)) reserve_open = true;
}

void close_memory_reserve() noexcept {
  if (!reserve_open) return;
  const std::size_t closed = limit_bytes - memory_reserve(limit_bytes);
  if (counted_bytes() > closed - closed / 64) return;
  if (set_limit(closed)) reserve_open = false;
}

void give_back_memory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

std::size_t resident_memory() {
  std::size_t total = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> total >> resident;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

void give_back_planning_memory() {
  large_pages::give_back();
  give_back_memory();
}

}  // namespace bahnwerk::server
