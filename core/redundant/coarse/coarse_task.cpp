#include "core/redundant/coarse/coarse_task.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace bahnwerk {
namespace {

constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();  // relative rounding of coordinates
constexpr int places = 32;                                                // samples per curve

/// Effect of the rounding of a segment's points on its first and second derivative at one end.
struct Rounding {
  double tangent, curvature;
};
Rounding rounding_at(const AxisPath& path, std::size_t segment, const AxisJet& q) {
  double far = 0, square = 0;
  for (std::size_t k = 0; k < path.axes(); ++k) far += std::abs(q.value[k]), square += q.d2[k] * q.d2[k];
  const double length = path[segment].length(), curvature = std::sqrt(square), turn = 1 / length + curvature;
  const bool arc = path[segment].curve().kind() == CurveKind::arc;  // its points are computed from its centre
  const double off = rounding * (far + length + (arc && curvature > 0 ? 2 / curvature : 0));
  return {off * turn, off * turn * turn};
}

bool derivatives_jump(const AxisPath& path, std::size_t segment) {
  const AxisJet before = path.at_parameter(segment - 1, path[segment - 1].curve().end()),
                after = path.at_parameter(segment, path[segment].curve().begin());
  const Rounding left = rounding_at(path, segment - 1, before), right = rounding_at(path, segment, after);
  for (std::size_t k = 0; k < path.axes(); ++k)
    if (!(std::abs(after.d1[k] - before.d1[k]) <= left.tangent + right.tangent &&
          std::abs(after.d2[k] - before.d2[k]) <= left.curvature + right.curvature))
      return true;
  return false;
}

}  // namespace

Machine coarse_machine(const CoarseFineMachine& machine, double share) {
  Machine coarse;
  coarse.cycle_time = machine.cycle_time;
  for (const CoarseFineAxis& axis : machine.axes)
    coarse.axes.emplace_back(axis.name, share * axis.coarse.velocity, share * axis.coarse.acceleration,
                             share * axis.coarse.jerk);
  return coarse;
}

std::vector<bool> rests_at_jumps(const AxisPath& path, std::vector<bool> rests) {
  for (std::size_t i = 1; i < path.size(); ++i) rests[i] = rests[i] || derivatives_jump(path, i);
  return rests;
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

JointTask without_fine_axes(JointTask task) {
  for (CoarseFineAxis& axis : task.machine.axes) axis = coarse_alone(axis);
  return task;
}

}  // namespace bahnwerk
