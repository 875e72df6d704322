#pragma once
/// The law of one section once more, along another that is the same but for its place.
#include <cstddef>

#include "core/base/progress_scope.hpp"
#include "core/geometry/path/path.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// Appends to the law what its pieces [from, to) do along the path's segments from `source` on, for those from `copy`
/// on: as many, of lengths that differ by rounding. The law is stretched by the ratio of both sections' lengths; at the
/// ends of segments places are those of the path. O(pieces); tells `scope`.
void repeat_law(TimeLaw& law, std::size_t from, std::size_t to, const Path& path, std::size_t source, std::size_t copy,
                std::size_t segments, ProgressScope& scope);

}  // namespace bahnwerk
