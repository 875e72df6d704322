#pragma once
/// From which stroke on an axis counts as a fine one.

namespace bahnwerk::verify {

inline constexpr double least_stroke = 1e-8;  ///< mm; a fine axis with no more is none

}  // namespace bahnwerk::verify
