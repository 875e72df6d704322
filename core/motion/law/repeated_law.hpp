#pragma once
/// Transfers the law of one section to another one that differs in its position only.
#include <cstddef>

#include "core/base/progress_scope.hpp"
#include "core/geometry/path/path.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// A section that repeats an earlier one. Both have equally many segments, with lengths that differ by rounding.
struct LawRepetition {
  std::size_t from, to;      ///< pieces [from, to) of the law, those of the earlier section
  std::size_t source, copy;  ///< first segments of the earlier section and of the one that repeats it
  std::size_t segments;      ///< number of segments of either
};

/// Appends to the law of a path a copy of an earlier section's pieces. The copy is scaled by the ratio of both
/// sections' lengths; at the ends of segments it takes the places of the path. O(pieces); reports to `progress`.
void repeat_law(TimeLaw& law, const Path& path, const LawRepetition& repetition, ProgressScope& progress);

}  // namespace bahnwerk
