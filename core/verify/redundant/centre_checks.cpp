#include "core/verify/redundant/centre_checks.hpp"

#include <cmath>

#include "core/verify/worst.hpp"

namespace bahnwerk {

std::vector<Check> centre_checks(const Motion& head, const Motion& coarse, const std::vector<AxisLimits>& fine_axes,
                                 const std::vector<bool>& centred) {
  constexpr double middle = 1e-6;  // mm
  std::vector<Check> list;
  for (const bool end : {false, true}) {
    const MotionState x = end ? head.final_state() : head.in_piece(0, 0),
                      c = end ? coarse.in_piece(coarse.pieces() - 1, coarse.duration()) : coarse.in_piece(0, 0);
    for (std::size_t k = 0; k < fine_axes.size(); ++k) {
      if (!centred[k]) continue;
      const AxisLimits& axis = fine_axes[k];
      list.push_back(verify::make_check(
          {end ? CheckedQuantity::centred_end : CheckedQuantity::centred_start, 0, axis.unit, axis.name}, middle,
          verify::Worst{std::abs(x[0][k] - c[0][k]), end ? head.duration() : 0}));
    }
  }
  return list;
}

}  // namespace bahnwerk
