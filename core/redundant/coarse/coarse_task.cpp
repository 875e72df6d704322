#include "core/redundant/coarse/coarse_task.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {
namespace {

constexpr int places = 32;  // samples per curve

}  // namespace

Machine coarse_machine(const CoarseFineMachine& machine, double share) {
  Machine coarse;
  coarse.cycle_time = machine.cycle_time;
  for (const CoarseFineAxis& axis : machine.axes)
    coarse.axes.emplace_back(axis.name, share * axis.coarse.velocity, share * axis.coarse.acceleration,
                             share * axis.coarse.jerk);
  return coarse;
}

std::vector<std::size_t> beyond_coarse_range(const AxisPath& path, const CoarseFineMachine& machine, double part) {
  std::vector<std::size_t> list;
  for (std::size_t k = 0; k < machine.axes.size(); ++k) {
    const Limits& coarse = machine.axes[k].coarse;
    if (!std::isfinite(coarse.lowest) && !std::isfinite(coarse.highest)) continue;
    const double beyond = part * machine.axes[k].stroke;
    const auto leaves = [&](std::size_t i) {
      const Segment& segment = path[i];
      const int looks = path.linear(i) ? 1 : places;
      for (int j = 0; j <= looks; ++j) {
        const double x = path.at(i, segment.s0() + segment.length() * j / looks).value[k];
        if (x < coarse.lowest - beyond || x > coarse.highest + beyond) return true;
      }
      return false;
    };
    for (std::size_t i = 0; i < path.size(); ++i)
      if (leaves(i)) {
        list.push_back(k);
        break;
      }
  }
  return list;
}

bool within_coarse_range(const AxisPath& path, const CoarseFineMachine& machine, double part) {
  return beyond_coarse_range(path, machine, part).empty();
}

}  // namespace bahnwerk
