#pragma once
/// How many cases the random tests take.
#include <algorithm>
#include <concepts>
#include <cstdlib>

namespace bahnwerk::testing {

/// What BAHNWERK_TEST_CASES says, a factor on all random tests: 1 where it is not set, 5 for `./test all`, less where
/// each case takes longer (a sanitizer).
inline double case_factor() {
  const char* factor = std::getenv("BAHNWERK_TEST_CASES");
  return factor ? std::strtod(factor, nullptr) : 1;
}

/// `quick` cases times the factor, at least one.
template <std::integral Count>
Count cases(Count quick) {
  return std::max(Count{1}, static_cast<Count>(static_cast<double>(quick) * case_factor()));
}

}  // namespace bahnwerk::testing
