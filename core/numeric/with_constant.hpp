#pragma once
/// Loops whose length is known at run time, compiled once for every length that is usual: the compiler unrolls them.
#include <cassert>
#include <cstddef>
#include <type_traits>

namespace bahnwerk {

/// Returns work(c) with `count`, 0 to 6, as the constant c.
template <class Work>
decltype(auto) with_constant(std::size_t count, Work&& work) {
  switch (count) {
    case 1:
      return work(std::integral_constant<std::size_t, 1>());
    case 2:
      return work(std::integral_constant<std::size_t, 2>());
    case 3:
      return work(std::integral_constant<std::size_t, 3>());
    case 4:
      return work(std::integral_constant<std::size_t, 4>());
    case 5:
      return work(std::integral_constant<std::size_t, 5>());
    case 6:
      return work(std::integral_constant<std::size_t, 6>());
    default:
      assert(count == 0);
      return work(std::integral_constant<std::size_t, 0>());
  }
}

}  // namespace bahnwerk
