#pragma once
/// The setpoints of a head whose motion is the sum of coarse and fine axes.
#include <memory>

#include "core/motion/axes/motion.hpp"
#include "core/motion/setpoints/contour_setpoints.hpp"

namespace bahnwerk {

/// Columns of ContourSetpoints, then of every axis x the coarse xc, then the fine xf, then vxc …, vxf …, axc …, axf ….
/// The fine axes' are those of the head less those of the coarse axes, in every row. A row costs what one of the head
/// does and one Motion::evaluate().
class CoarseFineSetpoints final : public ContourSetpoints {
 public:
  /// `coarse` has the machine's axes and lasts as long as `head`.
  CoarseFineSetpoints(const std::shared_ptr<const PathMotion>& head, std::shared_ptr<const Motion> coarse,
                      const Contour& contour, const Machine& machine, std::size_t cycles);

 private:
  void write(Row& row, double* out) const override;

  std::shared_ptr<const Motion> coarse_;
};

}  // namespace bahnwerk
