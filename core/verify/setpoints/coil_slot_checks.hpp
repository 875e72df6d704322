#pragma once
/// Checks by the part's geometry and the document's slots that needle and wire pass through the slots of the coil.
/// Lengths mm, angles rad.
#include <memory>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/row_check.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"
#include "core/geometry/curve/vec.hpp"
#include "core/motion/axes/axis_path.hpp"

namespace bahnwerk {

/// A sector about the part's axis: azimuths within `half` of `middle`. `half` is at most π/2.
struct SlotSector {
  double middle = 0, half = 0;
};

/// A passage through one slot, by the document.
struct SlotPass {
  SlotSector slot;        ///< from the middle of the tooth or pole before the slot to that of the one behind it
  SlotSector wire;        ///< where the coil's wires may lie: the slot, beside a rotor's pole the half at that pole
  Vec wire_in, wire_out;  ///< the wire's axis where it enters and leaves the slot, as the plan has it
};

/// Inputs of the check. The objects referred to have to outlive it.
struct CoilSlotInput {
  const KinematicAxisPath& path;    ///< the needle's pose at each s
  const SetpointSource& setpoints;  ///< columns x, y, z (mm), phi, psi (deg), s
  double low = 0, high = 0;         ///< heights of the ends of the slots along the part's axis
  double edge = 0;                  ///< radius of a stator's bore or of a rotor's outer circle
  bool outside = true;              ///< whether the slots lie outside of `edge`, as in a stator
  double needle_length = 0;         ///< from the tip to the holder
  std::vector<SlotPass> passes;     ///< in the order of the coils' turns: down, up, down …
};

/// Returns the check of every row, and of the path between rows at places no more than 1 mm apart. The path passes
/// between the ends of the slots in the order of `passes`; the first pass may have begun. During a pass the axis of the
/// needle, and the straight line from its tip to where the wire enters the slot, lie in the slot's sector wherever they
/// are beyond `edge`. A move in and out at one end stays in one of the slots of the two passes before and after.
/// Between the evaluated places the needle cannot reach another slot without passing a tooth, which the clearance
/// excludes.
///
/// `needle outside coil slots`  mm  largest distance of needle and free wire from the sector of the slot: 0
/// `wire outside coil slots`    mm  the same of the wires' places, which also lie beyond `edge`: 0
/// `passes of coil slots`       1   passes that are missing, lead through another slot or in the other direction, and
///                                  missing columns: 0
///
/// Values that are not numbers fail. 0.2 µs per row, on average over the turns of a coil (`bench_winding`).
std::unique_ptr<RowCheck> coil_slot_row_check(CoilSlotInput input);

/// Returns the results after reading all rows for this check alone.
std::vector<Check> coil_slot_checks(CoilSlotInput input, Progress progress);

}  // namespace bahnwerk
