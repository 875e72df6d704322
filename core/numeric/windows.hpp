#pragma once
/// Long problems in windows: memory does not grow with the problem, and time grows in proportion to it.
///
/// A window is solved from the state at which the one before it was cut, further ahead than is kept of it, because its
/// far end influences the part beside it. The next window begins where the kept part ends. If a window has no solution,
/// the cut may be the cause: the window before it is solved again, to be cut elsewhere. What a solution, a cut and
/// success are is the problem's matter.
#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/expected.hpp"

namespace bahnwerk {

/// The steps [begin, end) are solved, [begin, keep) are kept. All of the last window is kept.
struct Window {
  std::size_t begin = 0, keep = 0, end = 0;
};

/// Lengths of windows whose ends are known before they are solved, in steps.
struct WindowLengths {
  std::size_t kept = 1;   ///< steps that are kept of each window but the last
  std::size_t ahead = 0;  ///< steps that are solved beyond those
  std::size_t whole = 1;  ///< largest number of steps that are not divided; at least `kept`

  /// Returns the window that begins with step `begin` of n.
  Window at(std::size_t begin, std::size_t n) const {
    if (n - begin <= whole) return {begin, n, n};
    return {begin, begin + kept, std::min(begin + kept + ahead, n)};
  }
};

/// Which window is solved next, where one gave nothing to keep: the same again or the one before, whose places the
/// solver may have changed, or none.
enum class WindowRetry { same, before, none };

/// The place where the next window begins, or what is done instead.
template <class Place>
using WindowResult = Expected<Place, WindowRetry>;

/// Solves windows from `first` on until one begins at `end`, and returns that place; if a window failed, the place
/// where it begins. A `Place` is a number, or has a member `begin` and all that the window that begins there has to
/// know: the state, the sizes of the results so far, its length. `solve(place, before)` solves a window and returns its
/// WindowResult; `before` points to the place of the window before it, null for the first one. `end` may become known
/// on the way.
template <class Place, class End, class Solve>
Place solve_windows(Place first, const End& end, Solve&& solve) {
  const auto begin = [](const Place& place) {
    if constexpr (std::is_arithmetic_v<Place>)
      return place;
    else
      return place.begin;
  };
  std::vector<Place> places{std::move(first)};
  while (begin(places.back()) < end) {
    WindowResult<Place> next = solve(places.back(), places.size() > 1 ? &places.end()[-2] : nullptr);
    if (next)
      places.push_back(*std::move(next));
    else if (next.reason() == WindowRetry::none)
      break;
    else if (next.reason() == WindowRetry::before && places.size() > 1)
      places.pop_back();
  }
  return std::move(places.back());
}

}  // namespace bahnwerk
