#pragma once
/// The setpoints of a motion along a contour: its axes, place and speed along the path, and the current block.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/motion/setpoints/path_setpoints.hpp"

namespace bahnwerk {

/// The columns are those of PathSetpoints, then mode and block. `mode` is 1 in a block that cuts, 0 in one that
/// positions; `block` is the index of that block in the contour, from 0. Both follow from the times of the blocks, not
/// from the place on the path. A row at the time at which two blocks meet belongs to the later one, the last row to the
/// last block that is not empty. Derived classes add columns.
class ContourSetpoints : public PathSetpoints {
 public:
  /// `motion` follows the contour's path and already lasts a whole number of cycles. O(pieces + blocks).
  ContourSetpoints(const std::shared_ptr<const PathMotion>& motion, const Contour& contour, const Machine& machine,
                   std::size_t cycles);

 protected:
  /// Returns the number of columns before those that derived classes add.
  std::size_t contour_columns() const { return path_columns() + 2; }
  void write(Row& row, double* out) const override;

 private:
  struct Label {
    double begin;  // s; valid until the next label's begin
    std::size_t block;
    bool cut;
  };
  std::vector<Label> labels_;  // labels of the blocks that are not empty, in order; at least one
};

}  // namespace bahnwerk
