#include "core/verify/setpoints/needle_checks.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "core/base/read_rows.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace {

using verify::Strained;

constexpr double degrees = 180 / std::numbers::pi, reach = 100;  // mm
constexpr double tolerance = 1e-6;                               // mm, deg

double off(const ToolPose& a, const ToolPose& b) { return norm(a.position - b.position); }
/// deg; NaN if one of them is.
double turned(const ToolPose& a, const ToolPose& b) {
  const double phi = std::abs(std::remainder(a.phi - b.phi, 2 * std::numbers::pi)), psi = std::abs(a.psi - b.psi);
  return degrees * (phi + psi);
}

}  // namespace

std::vector<Check> needle_checks(const NeedleInput& in, Progress& progress) {
  const auto& columns = in.setpoints.columns();
  const std::size_t axes = in.path.axes(), width = columns.size();
  std::array<std::size_t, max_axes> axis_column{};
  std::array<std::size_t, 6> pose_column{};
  bool complete = in.shown.size() == axes && in.machine.axes().size() == axes;
  for (std::size_t k = 0; complete && k < axes; ++k) {
    axis_column[k] = column_index(columns, in.machine.axes()[k].name);
    complete = axis_column[k] < width;
  }
  const char* const names[] = {"x", "y", "z", "phi", "psi", "s"};
  for (std::size_t i = 0; i < pose_column.size(); ++i)
    complete = complete && (pose_column[i] = column_index(columns, names[i])) < width;

  Strained position, angle, pose;
  if (!complete) position.raise(unlimited, tolerance, 0);
  std::size_t segment = 0;
  const auto check = [&](std::size_t i, const double* row) {
    const double t = static_cast<double>(i) * in.setpoints.cycle_time();
    AxisArray q{};
    for (std::size_t k = 0; k < axes; ++k) q[k] = row[axis_column[k]] / in.shown[k];
    const ToolPose is = in.machine.forward(q);
    const double s = row[pose_column[5]];
    segment = in.path.tool().find(s, segment);
    const ToolPose wanted = in.path.pose(segment, in.path[segment].parameter(s));
    position.raise(off(is, wanted), tolerance, t);
    angle.raise(turned(is, wanted), tolerance, t);
    const ToolPose told{{row[pose_column[0]], row[pose_column[1]], row[pose_column[2]]},
                        row[pose_column[3]] / degrees,
                        row[pose_column[4]] / degrees};
    pose.raise(off(is, told) + reach / degrees * turned(is, told), tolerance, t);
  };
  if (complete)
    for_each_row(in.setpoints, check, [&](std::size_t, std::size_t) { progress.report("verify needle", 1); });
  return {verify::make_check("forward kinematics position", "mm", position),
          verify::make_check("forward kinematics angle", "deg", angle),
          verify::make_check("setpoints pose", "mm", pose)};
}

}  // namespace bahnwerk
