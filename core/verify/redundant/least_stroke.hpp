#pragma once
/// The travel of a fine axis up to which it counts as standing still or as not existing.

namespace bahnwerk::verify {

inline constexpr double least_stroke = 1e-8;  ///< mm; rounding of positions stays below it

}  // namespace bahnwerk::verify
