#pragma once
/// Links that were found, to be found again where the same way comes back turned about the part's axis: coils that are
/// repeated around the part have all their links so. How smooth a link is does not depend on where it stands.
#include <cstddef>
#include <map>
#include <optional>

#include "core/geometry/spline/link.hpp"
#include "core/winding/path/link_search.hpp"

namespace bahnwerk::winding {

/// Whether `b` is `a` turned about the z axis, to 1e-11: places of the distance of both ends, each derivative up to
/// `continuity` of the first one's size. Angles of the needle do not count.
bool turned_alike(const LinkEnds& a, const LinkEnds& b, std::size_t continuity);

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
