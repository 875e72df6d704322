#pragma once
/// An array that grows at its end without moving its elements.
#include <cstddef>
#include <utility>
#include <vector>

namespace bahnwerk::verify {

/// Copying a large array would take longer than the interval between two progress calls. It uses ordinary memory; the
/// large pages that are reused from plan to plan are left to the planners, whose arrays fit them.
template <class T>
class Blocks {
 public:
  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return blocks_[i / each][i % each]; }
  const T& operator[](std::size_t i) const { return blocks_[i / each][i % each]; }
  void push_back(const T& value) {
    if (size_ == each * blocks_.size()) blocks_.emplace_back().reserve(each);
    std::vector<T>& block = blocks_[size_ / each];
    if (const std::size_t i = size_ % each; i < block.size())
      block[i] = value;
    else
      block.push_back(value);
    ++size_;
  }
  /// Both keep the memory for later elements.
  void clear() { size_ = 0; }
  /// Removes all but the first `count`. O(elements behind them).
  void drop(std::size_t count) {
    for (std::size_t i = count; i < size_; ++i) (*this)[i - count] = std::move((*this)[i]);
    size_ -= count;
  }

 private:
  static constexpr std::size_t each = 512;
  std::size_t size_ = 0;
  std::vector<std::vector<T>> blocks_;
};

/// A view of the elements of an array in another order. Valid as long as both exist and do not grow.
template <class T, class Index>
class Ordered {
 public:
  Ordered(const Blocks<T>& all, const Index* order, std::size_t size) : all_(all), order_(order), size_(size) {}
  std::size_t size() const { return size_; }
  const T& operator[](std::size_t i) const { return all_[order_[i]]; }
  const T& front() const { return all_[order_[0]]; }
  const T& back() const { return all_[order_[size_ - 1]]; }
  struct Iterator {
    const Blocks<T>& all;
    const Index* at;
    const T& operator*() const { return all[*at]; }
    Iterator& operator++() {
      ++at;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return at != other.at; }
  };
  Iterator begin() const { return {all_, order_}; }
  Iterator end() const { return {all_, order_ + size_}; }

 private:
  const Blocks<T>& all_;
  const Index* order_;
  std::size_t size_;
};

}  // namespace bahnwerk::verify
