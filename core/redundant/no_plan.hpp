#pragma once
/// Why a planner of coarse and fine axes has no plan for a task.
#include "core/base/expected.hpp"

namespace bahnwerk {

enum class NoPlan {
  head_exceeds_limits,  ///< the head exceeds the sum of both axes' limits in a cell
  effort,               ///< slower sections were not found with the effort that is worth it
  cannot_follow,        ///< the coarse axes cannot follow, however slowly the tool moves
  no_fine_axis,         ///< no fine axis has a stroke that can be planned with
  samples_apart,        ///< between samples of every cycle a fine axis may leave its stroke
  no_split,             ///< limits fell until the coarse axes alone were quicker, and no split was valid
  no_reference,         ///< no limits of the reference motion with which the filtered motion holds those of the axes
  between_samples,      ///< the axes exceed their limits between the places that the planner looks at
  no_curve,             ///< no coarse curve within the strokes along which all axes hold their limits
};

}  // namespace bahnwerk
