#pragma once
/// Transfers the law of one section to another one that differs in its position only.
#include <cstddef>

#include "core/base/progress_scope.hpp"
#include "core/geometry/path/path.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// Appends to the law a copy of its pieces [from, to), which belong to the path's segments from `source` on, for the
/// segments from `copy` on. Both have equally many segments, with lengths that differ by rounding. The copy is scaled
/// by the ratio of both sections' lengths; at the ends of segments it takes the places of the path. O(pieces); reports
/// to `progress`.
void repeat_law(TimeLaw& law, std::size_t from, std::size_t to, const Path& path, std::size_t source, std::size_t copy,
                std::size_t segments, ProgressScope& progress);

}  // namespace bahnwerk
