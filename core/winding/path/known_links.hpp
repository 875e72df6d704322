#pragma once
/// Links that were found, to be found again where the same way comes back turned about the part's axis, or mirrored by
/// a plane through it: coils that are repeated around the part, in one direction or in turns, have all their links so.
/// How smooth a link is depends neither on where it stands nor on which hand.
#include <cstddef>
#include <map>
#include <optional>

#include "core/geometry/spline/link.hpp"
#include "core/winding/path/link_search.hpp"

namespace bahnwerk::winding {

/// Whether `b` is `a` turned about the z axis, or mirrored by a plane through it, to 1e-11: places of the distance of
/// both ends, each derivative up to `continuity` of the first one's size. Angles of the needle do not count.
bool congruent(const LinkEnds& a, const LinkEnds& b, std::size_t continuity);

class KnownLinks {
 public:
  explicit KnownLinks(std::size_t continuity) : continuity_(continuity) {}
  /// The first one remembered that joins such ends. O(log n).
  const FoundLink* find(const LinkEnds& ends) const;
  void remember(const LinkEnds& ends, const FoundLink& link);

 private:
  struct Known {
    LinkEnds ends;
    FoundLink link;
  };
  std::size_t continuity_;
  std::multimap<double, Known> by_chord_;
};

}  // namespace bahnwerk::winding
