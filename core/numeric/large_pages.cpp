#include "core/numeric/large_pages.hpp"

#include <sys/mman.h>

#include <cstdlib>
#include <mutex>

namespace bahnwerk::large_pages {
namespace {

constexpr std::size_t page = std::size_t{1} << 21;

/// Sizes come in two steps per doubling, so that what a plan gives back fits what it takes next. Room that is never
/// written takes no memory.
std::size_t rounded(std::size_t bytes) {
  std::size_t step = least;
  while (step * 4 < bytes) step *= 2;
  return (bytes + step - 1) / step * step;
}

struct FreeMapping {
  void* memory;
  std::size_t size;
};

class Store {
 public:
  void* take(std::size_t size) {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = kept_.size(); i-- > 0;) {  // the last one given back is the likeliest to be in a cache
      if (kept_[i].size != size) continue;
      void* memory = kept_[i].memory;
      kept_.erase(kept_.begin() + static_cast<std::ptrdiff_t>(i));
      total_ -= size;
      return memory;
    }
    return nullptr;
  }
  bool keep(void* memory, std::size_t size) noexcept {
    const std::lock_guard lock(mutex_);
    if (size > max_kept) return false;
    while (total_ + size > max_kept) {
      std::free(kept_.front().memory);
      total_ -= kept_.front().size;
      kept_.erase(kept_.begin());
    }
    try {
      kept_.push_back({memory, size});
    } catch (const std::bad_alloc&) {
      return false;
    }
    total_ += size;
    return true;
  }
  void clear() noexcept {
    const std::lock_guard lock(mutex_);
    for (const FreeMapping& mapping : kept_) std::free(mapping.memory);
    kept_.clear();
    total_ = 0;
  }
  std::size_t total() noexcept {
    const std::lock_guard lock(mutex_);
    return total_;
  }

 private:
  std::mutex mutex_;
  std::vector<FreeMapping> kept_;  // a few dozen at most, oldest first
  std::size_t total_ = 0;
};

/// Never destroyed: vectors with static lifetime may give back later.
Store& store() {
  static Store* const made = new Store;
  return *made;
}

}  // namespace

void* take(std::size_t bytes) {
  const std::size_t size = rounded(bytes);
  if (void* memory = store().take(size)) return memory;
  const bool large = size >= page;
  const auto allocate = [&] {
    return std::aligned_alloc(large ? page : 64, large ? (size + page - 1) / page * page : size);
  };
  void* memory = allocate();
  if (memory == nullptr) {  // what is kept has other sizes
    give_back();
    memory = allocate();
  }
  if (memory == nullptr) throw std::bad_alloc();
  if (large) madvise(memory, size, MADV_HUGEPAGE);  // memory stays on ordinary pages if the system refuses
  return memory;
}

void give(void* memory, std::size_t bytes) noexcept {
  if (!store().keep(memory, rounded(bytes))) std::free(memory);
}

void give_back() noexcept { store().clear(); }

std::size_t kept() noexcept { return store().total(); }

}  // namespace bahnwerk::large_pages
