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
/// Returns the larger difference of both angles, deg; NaN if one of them is.
double turned(const ToolPose& a, const ToolPose& b) {
  const double phi = std::abs(std::remainder(a.phi - b.phi, 2 * std::numbers::pi)), psi = std::abs(a.psi - b.psi);
  return degrees * (phi + psi);
}

class NeedleRows final : public RowCheck {
 public:
  explicit NeedleRows(const NeedleInput& in) : in_(in), axes_(in.path.axes()) {
    const auto& columns = in_.setpoints.columns();
    const std::size_t width = columns.size();
    complete_ = in_.shown.size() == axes_ && in_.machine.axes().size() == axes_;
    for (std::size_t k = 0; complete_ && k < axes_; ++k) {
      axis_column_[k] = column_index(columns, in_.machine.axes()[k].name);
      complete_ = axis_column_[k] < width;
    }
    const char* const names[] = {"x", "y", "z", "phi", "psi", "s"};
    for (std::size_t i = 0; i < pose_column_.size(); ++i)
      complete_ = complete_ && (pose_column_[i] = column_index(columns, names[i])) < width;
    if (!complete_) position_.raise(unlimited, tolerance, 0);
  }

  bool reads() const override { return complete_; }

  void row(std::size_t i, const double* row) override {
    const double t = static_cast<double>(i) * in_.setpoints.cycle_time();
    AxisArray q{};
    for (std::size_t k = 0; k < axes_; ++k) q[k] = row[axis_column_[k]] / in_.shown[k];
    const ToolPose is = in_.machine.forward(q);
    const double s = row[pose_column_[5]];
    segment_ = in_.path.tool().find(s, segment_);
    const ToolPose wanted = in_.path.pose(segment_, in_.path[segment_].parameter(s));
    position_.raise(off(is, wanted), tolerance, t);
    angle_.raise(turned(is, wanted), tolerance, t);
    const ToolPose told{{row[pose_column_[0]], row[pose_column_[1]], row[pose_column_[2]]},
                        row[pose_column_[3]] / degrees,
                        row[pose_column_[4]] / degrees};
    pose_.raise(off(is, told) + reach / degrees * turned(is, told), tolerance, t);
  }

  std::vector<Check> checks() override {
    return {verify::make_check({quantity::tip_position, 0}, position_),
            verify::make_check({{"forward kinematics angle", CheckGroup::geometry}, 0, "deg"}, angle_),
            verify::make_check({quantity::rows_pose, 0}, pose_)};
  }

 private:
  NeedleInput in_;
  std::size_t axes_, segment_ = 0;
  bool complete_ = false;
  std::array<std::size_t, max_axes> axis_column_{};
  std::array<std::size_t, 6> pose_column_{};
  Strained position_, angle_, pose_;
};

}  // namespace

std::unique_ptr<RowCheck> needle_row_check(const NeedleInput& input) { return std::make_unique<NeedleRows>(input); }

std::vector<Check> needle_checks(const NeedleInput& input, Progress progress) {
  ProgressScope stage_progress(progress.part(1, 1), "verify needle");
  return check_rows(input.setpoints, needle_row_check(input), stage_progress);
}

}  // namespace bahnwerk
