#pragma once
/// A memory of links for congruent ends: rotated about the part's axis, or mirrored by a plane through it. All links of
/// coils that are repeated around the part have such ends. The smoothness of a link depends neither on its place nor on
/// its orientation.
#include <cstddef>
#include <map>
#include <optional>

#include "core/geometry/spline/link.hpp"
#include "core/winding/path/link_search.hpp"

namespace bahnwerk::winding {

/// Returns whether `b` is `a` rotated about the z axis, or mirrored by a plane through it, to 1e-11: places relative to
/// the distance of both ends, each derivative up to `continuity` relative to the first one. Angles of the needle do not
/// count.
bool congruent(const LinkEnds& a, const LinkEnds& b, std::size_t continuity);

class KnownLinks {
 public:
  explicit KnownLinks(std::size_t continuity) : continuity_(continuity) {}
  /// Returns the first remembered link that joins such ends. O(log n).
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
