#pragma once
/// Describes the result of blending in the contour's notes.
#include <cstddef>

#include "core/contour/blend.hpp"

namespace bahnwerk::blending {

/// Figures of the blending.
struct BlendCount {
  std::size_t corners = 0, runs = 0,
              run_segments = 0;            ///< number of blended corners and of smoothed runs, with their segments
  std::size_t failed = 0, unsmoothed = 0;  ///< joints and runs that are unchanged because no curve fits
  Vec first_failed, first_unsmoothed;      ///< places of the first ones
};

/// Adds to the notes of the blended contour what was blended, which jumps and corners remain, and what failed.
void note(Contour& blended, const BlendCount& count, const BlendOptions& options, ProgressScope& progress);

}  // namespace bahnwerk::blending
