#pragma once
/// The setpoints of a motion along a contour: its axes, the place and speed along the path, and what block is worked
/// on.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/contour/contour.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/law/path_motion.hpp"
#include "core/motion/setpoints/path_setpoints.hpp"

namespace bahnwerk {

/// Columns of PathSetpoints, then mode and block. `mode` is 1 in a block that cuts, 0 in one that
/// positions; `block` is the index of that block in the contour, from 0. Both come from the times of the blocks, not
/// from the place on the path; a row at the moment where two blocks meet belongs to the later one, the last row to the
/// last block that is not empty. Kinds of contours derive from it to add columns of their own.
class ContourSetpoints : public PathSetpoints {
 public:
  /// `motion` goes along the contour's path and must already last a whole number of cycles. O(pieces + blocks).
  ContourSetpoints(const std::shared_ptr<const PathMotion>& motion, const Contour& contour, const Machine& machine,
                   std::size_t cycles);

 protected:
  /// How many columns stand before those that are added to these.
  std::size_t contour_columns() const { return path_columns() + 2; }
  void write(Row& row, double* out) const override;

 private:
  struct Label {
    double begin;  // s: from here to the next label's begin
    std::size_t block;
    bool cut;
  };
  std::vector<Label> labels_;  // of the blocks that are not empty, in order; one at least
};

}  // namespace bahnwerk
