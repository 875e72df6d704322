#pragma once
/// Arrays that grow at their end without moving their elements: copying a large one would take longer than the interval
/// between two progress calls.
#include <boost/container/deque.hpp>
#include <cstddef>

namespace bahnwerk::verify {

using LargeBlocks = boost::container::deque_options<boost::container::block_size<512u>>::type;
template <class T>
using Blocks = boost::container::deque<T, void, LargeBlocks>;

/// A view of the elements of an array in another order. It is valid as long as array and order exist and do not grow.
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
