#pragma once
/// Storage for large arrays that are written once and read a few times, such as planners' grids. Taking fresh memory
/// from the system 4 KiB at a time costs as much as computing its content, so memory comes in large pages, and freed
/// memory is reused by the next plan, up to 512 MiB per process, until give_back().
#include <cstddef>
#include <limits>
#include <new>
#include <vector>

namespace bahnwerk {

namespace large_pages {
inline constexpr std::size_t least = std::size_t{1} << 17;  ///< bytes; smaller arrays use ordinary memory
inline constexpr std::size_t max_kept = std::size_t{1} << 29;
/// Returns at least `bytes` ≥ least of memory with undefined content. Throws std::bad_alloc. Thread-safe.
void* take(std::size_t bytes);
/// Frees the memory that take(bytes) returned.
void give(void* memory, std::size_t bytes) noexcept;
/// Returns the memory that is kept for reuse to the system. Thread-safe.
void give_back() noexcept;
std::size_t kept() noexcept;  ///< bytes kept for reuse
}  // namespace large_pages

/// A standard allocator.
template <class T>
struct LargePages {
  using value_type = T;
  LargePages() = default;
  template <class U>
  LargePages(const LargePages<U>&) {}

  T* allocate(std::size_t n) {
    if (n > std::numeric_limits<std::size_t>::max() / 4 / sizeof(T)) throw std::bad_array_new_length();
    const std::size_t bytes = n * sizeof(T);
    return static_cast<T*>(bytes < large_pages::least ? ::operator new(bytes) : large_pages::take(bytes));
  }
  void deallocate(T* memory, std::size_t n) noexcept {
    const std::size_t bytes = n * sizeof(T);
    bytes < large_pages::least ? ::operator delete(memory) : large_pages::give(memory, bytes);
  }
  friend bool operator==(const LargePages&, const LargePages&) { return true; }
};

template <class T>
using LargeVector = std::vector<T, LargePages<T>>;

/// A vector for arrays that are written before they are read: resize() leaves new numbers undefined, which saves a pass
/// over them.
template <class T>
struct UnsetPages : LargePages<T> {
  template <class U>
  struct rebind {
    using other = UnsetPages<U>;
  };
  UnsetPages() = default;
  template <class U>
  UnsetPages(const UnsetPages<U>&) {}
  void construct(T* at) { ::new (static_cast<void*>(at)) T; }
};
template <class T>
using UnsetVector = std::vector<T, UnsetPages<T>>;

}  // namespace bahnwerk
