#pragma once
/// Storage for arrays of many megabytes that are written once and read a few times, as planners' grids are: asked from
/// the system in large pages, because taking fresh memory 4 KiB at a time costs as much as computing what goes in.
#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>
#include <vector>

namespace bahnwerk {

/// A standard allocator; below a megabyte it is the usual one. What the system refuses stays on ordinary pages.
template <class T>
struct LargePages {
  using value_type = T;
  static constexpr std::size_t page = std::size_t{1} << 21, large = page / 2;

  LargePages() = default;
  template <class U>
  LargePages(const LargePages<U>&) {}

  T* allocate(std::size_t n) {
    if (n > std::numeric_limits<std::size_t>::max() / 2 / sizeof(T)) throw std::bad_array_new_length();
    const std::size_t bytes = n * sizeof(T);
    const bool use = bytes >= large;
    const std::size_t size = use ? (bytes + page - 1) / page * page : bytes;
    void* memory = use ? std::aligned_alloc(page, size) : std::malloc(size > 0 ? size : 1);
    if (memory == nullptr) throw std::bad_alloc();
    if (use) madvise(memory, size, MADV_HUGEPAGE);
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }
  friend bool operator==(const LargePages&, const LargePages&) { return true; }
};

template <class T>
using LargeVector = std::vector<T, LargePages<T>>;

}  // namespace bahnwerk
