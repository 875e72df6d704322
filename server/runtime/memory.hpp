#pragma once
/// The memory of the process: its limit, the part of it that planners and checks cannot use, and its return to the
/// system.
#include <cstddef>
#include <filesystem>
#include <optional>

namespace bahnwerk::server {

/// Returns the memory that this process may use, bytes: the machine's, or the smallest limit of its cgroup and of those
/// above it (versions 1 and 2). `root` is the folder that contains proc and sys.
std::size_t memory_of_host(const std::filesystem::path& root = "/");

/// The default of --max-memory, bytes: three quarters of `host`, but at least min_memory.
inline constexpr std::size_t min_memory = std::size_t{192} << 20;
std::size_t default_memory_limit(std::size_t host);

/// Limits the data of this process (RLIMIT_DATA: heap, anonymous mappings, threads' stacks) to `bytes` for ever, and
/// installs the handler that yields to answering threads: an allocation that fails in a thread with a MemoryUse
/// throws std::bad_alloc at once; in another thread it opens the reserve, the last memory_reserve(bytes) below the
/// limit. Returns false if the system refuses.
bool limit_memory(std::size_t bytes);
std::size_t memory_limit();                     ///< returns that limit, bytes; 0: none
std::size_t memory_reserve(std::size_t bytes);  ///< a sixteenth, at most 32 MiB

/// Marks the current thread as one whose work may be given up for lack of memory: a planner, the check of a large
/// document. Ends with the object.
class MemoryUse {
 public:
  MemoryUse();
  ~MemoryUse();
  MemoryUse(const MemoryUse&) = delete;
  MemoryUse& operator=(const MemoryUse&) = delete;

 private:
  const bool before_;
};

bool uses_memory() noexcept;  ///< whether the current thread is marked
/// Returns whether answering threads use the reserve: planners end then.
bool memory_is_short() noexcept;
/// Opens the reserve, for allocators that do not throw (SQLite, zstd).
void open_memory_reserve() noexcept;
/// Closes the reserve if there is memory below it again.
void close_memory_reserve() noexcept;

/// Size of a document from which on returning memory is worthwhile, bytes.
inline constexpr std::size_t worth_giving_back = 256 << 10;

/// Returns freed memory to the system (glibc; elsewhere without effect). A parsed document consists of millions of
/// small blocks, which the allocator would otherwise reserve for later use. Costs about 1 ms per 100 MB.
void give_back_memory();
/// Returns the memory that planners keep for the next plan, too (core/numeric/large_pages.hpp).
void give_back_planning_memory();

/// Returns the resident memory of this process, bytes (Linux; elsewhere 0).
std::size_t resident_memory();

}  // namespace bahnwerk::server
