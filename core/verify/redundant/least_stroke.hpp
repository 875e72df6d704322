#pragma once
/// The threshold of the stroke below which an axis counts as having no fine axis.

namespace bahnwerk::verify {

inline constexpr double least_stroke =
    1e-8;  ///< mm; a fine axis with a smaller or equal stroke does not exist for the verifier

}  // namespace bahnwerk::verify
