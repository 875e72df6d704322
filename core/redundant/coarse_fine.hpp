#pragma once
/// A machine with redundant axes [Bock 2.1.5]: each coordinate has a coarse axis with a long range and a fine axis
/// carried by it, which is quicker but moves by at most `stroke` to either side. The tool's coordinate is the sum of
/// both positions.
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/machine/machine.hpp"

namespace bahnwerk {

struct CoarseFineAxis {
  std::string name;
  Limits coarse, fine;   ///< mm/s, mm/s², mm/s³; accelerations are finite; the jerks of both are finite or none is
  double stroke = 0;     ///< mm, one-sided: |x − x_c| ≤ stroke; 0: there is no fine axis, and its limits are 0
  bool centred = false;  ///< whether the fine axis stands in the middle of its stroke at the begin and at the end
};

/// Returns the axis without its fine one: the coarse axis does all that the tool does.
inline CoarseFineAxis coarse_alone(CoarseFineAxis axis) {
  axis.stroke = 0;
  axis.fine = {0, 0, axis.coarse.jerk < unlimited ? 0 : unlimited};
  return axis;
}

struct CoarseFineMachine {
  std::vector<CoarseFineAxis> axes;  ///< axis k is coordinate k
  double cycle_time = 0.001;         ///< s
  /// Returns the highest derivative that is limited: 2 (acceleration) or 3 (jerk).
  int limited_order() const {
    for (const CoarseFineAxis& axis : axes)
      if (axis.coarse.jerk < unlimited) return 3;
    return 2;
  }
};

/// Returns a machine whose limits are the sums of the coarse and fine ones: no motion of the tool can exceed them.
/// Position ranges are those of the coarse axes widened by the stroke.
inline Machine summed(const CoarseFineMachine& machine) {
  Machine sum;
  sum.cycle_time = machine.cycle_time;
  for (const CoarseFineAxis& axis : machine.axes) {
    AxisLimits limits(axis.name, axis.coarse);
    for (int order = 1; order <= Limits::highest_order; ++order) limits.of(order) += axis.fine.of(order);
    limits.lowest = axis.coarse.lowest - axis.stroke;
    limits.highest = axis.coarse.highest + axis.stroke;
    sum.axes.push_back(std::move(limits));
  }
  return sum;
}

/// Returns the limits with which the head is planned: the sums, but with a jerk at which each axis can follow its share
/// of the acceleration from one limit to the other. With a higher jerk the slower axis would still be changing its
/// acceleration when the head has already changed from full acceleration to full braking. The jerk equals the sum if
/// both axes take equally long from one acceleration limit to the other.
inline Machine head_limits(const CoarseFineMachine& machine) {
  Machine head = summed(machine);
  for (std::size_t k = 0; k < head.axes.size(); ++k) {
    const Limits &coarse = machine.axes[k].coarse, &fine = machine.axes[k].fine;
    if (!(fine.acceleration > 0))
      head.axes[k].jerk = coarse.jerk;
    else
      head.axes[k].jerk =
          head.axes[k].acceleration * std::min(coarse.jerk / coarse.acceleration, fine.jerk / fine.acceleration);
  }
  return head;
}

/// Returns a machine of 2 N axes, all coarse axes before all fine ones, with `share` of their speeds and accelerations.
inline Machine both_stages(const CoarseFineMachine& machine, double share) {
  Machine axes;
  axes.cycle_time = machine.cycle_time;
  for (const bool fine : {false, true})
    for (const CoarseFineAxis& axis : machine.axes) {
      const Limits& limits = fine ? axis.fine : axis.coarse;
      axes.axes.emplace_back(axis.name + (fine ? "f" : "c"), share * limits.velocity, share * limits.acceleration);
    }
  return axes;
}

}  // namespace bahnwerk
