#pragma once
/// What blending did, in words for the contour's notes.
#include <cstddef>

#include "core/contour/blend.hpp"

namespace bahnwerk::blending {

struct BlendCount {
  std::size_t corners = 0, runs = 0, run_segments = 0;  ///< blended; smoothed, of so many segments
  std::size_t failed = 0, unsmoothed = 0;               ///< joints and runs left as they were
  Vec first_failed, first_unsmoothed;                   ///< where the first ones are
};

/// Adds to the notes of the blended contour: what was blended, which jumps and corners are left, what failed.
void note(Contour& blended, const BlendCount& count, const BlendOptions& options, ProgressScope& scope);

}  // namespace bahnwerk::blending
