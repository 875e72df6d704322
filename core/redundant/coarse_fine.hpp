#pragma once
/// A machine each of whose axes is two: a coarse one with a long way, and a fine one on it that is quicker but reaches
/// only `stroke` to either side. The tool stands at the sum of both [Bock 2.1.5].
#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/machine/machine.hpp"

namespace bahnwerk {

struct CoarseFineAxis {
  std::string name;
  Limits coarse, fine;   ///< their accelerations are finite; jerks of both are, or of neither
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
  bool limits_jerk() const {
    for (const CoarseFineAxis& axis : axes)
      if (axis.coarse.jerk < unlimited) return true;
    return false;
  }
};

/// Returns what the tool can do at most: both axes' limits, summed. Its ranges are those of the coarse axes with the
/// stroke.
inline Machine summed(const CoarseFineMachine& machine) {
  Machine sum;
  sum.cycle_time = machine.cycle_time;
  for (const CoarseFineAxis& axis : machine.axes) {
    AxisLimits limits(axis.name, axis.coarse.velocity + axis.fine.velocity,
                      axis.coarse.acceleration + axis.fine.acceleration, axis.coarse.jerk + axis.fine.jerk);
    limits.lowest = axis.coarse.lowest - axis.stroke;
    limits.highest = axis.coarse.highest + axis.stroke;
    sum.axes.push_back(std::move(limits));
  }
  return sum;
}

/// Returns what the head is planned with: the sums, but a jerk at which each axis can take its share of the
/// acceleration all the way from one end of its limits to the other. With more, the slower of both would still be on
/// its way when the head changes from full acceleration to full braking. It is the sum if both axes take equally long
/// for that.
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

/// Returns the axes of a split motion, all coarse ones before all fine ones, with this share of their speeds and
/// accelerations.
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
