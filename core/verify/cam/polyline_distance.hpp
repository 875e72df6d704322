#pragma once
/// The smallest distance between the chords of two series of places.
#include <cstddef>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/region/point.hpp"

namespace bahnwerk {

namespace verify {

struct NearestApproach {
  double distance = 0;    ///< mm
  std::size_t index = 0;  ///< number of the place of `path` where the chord begins
};
/// Returns the smallest distance between any chord of `path` and any chord of `line`. Chords of `line` that are farther
/// than `near` from the one of `path` are skipped by their length, so distances above `near` are bounds from below.
NearestApproach nearest_approach(const std::vector<Point>& path, const std::vector<Point>& line, double near,
                                 Progress progress);

}  // namespace verify
}  // namespace bahnwerk
