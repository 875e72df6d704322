#pragma once
/// The setpoints of a head and its coarse and fine axes.
#include <memory>

#include "core/motion/axes/motion.hpp"
#include "core/motion/setpoints/contour_setpoints.hpp"

namespace bahnwerk {

/// The columns are those of ContourSetpoints, then for all axes x the coarse xc, the fine xf, then vxc …, vxf …, axc …,
/// axf …. Fine values are the head's less the coarse ones, in every row. A row costs one row of the head and one
/// Motion::evaluate().
class CoarseFineSetpoints final : public ContourSetpoints {
 public:
  /// `coarse` has the machine's axes and the same duration as `head`.
  CoarseFineSetpoints(const std::shared_ptr<const PathMotion>& head, std::shared_ptr<const Motion> coarse,
                      const Contour& contour, const Machine& machine, std::size_t cycles);

 private:
  void write(Row& row, double* out) const override;

  std::shared_ptr<const Motion> coarse_;
};

}  // namespace bahnwerk
