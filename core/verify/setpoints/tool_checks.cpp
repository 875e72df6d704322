#include "core/verify/setpoints/tool_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/base/read_rows.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace {

using verify::Strained;

constexpr double tolerance = 1e-6;              // mm
constexpr double step = 0.005, longest = 1e-4;  // mm of the path, s
constexpr double relative = 1e-5, least_speed = 1e-5, least_acceleration = 1e-2;

class ToolRows final : public RowCheck {
 public:
  explicit ToolRows(const ToolInput& in) : in_(in), axes_(in.machine.axes().size()) {
    const auto& columns = in_.setpoints.columns();
    bool complete = in_.shown.size() == axes_;
    const auto find = [&](const std::string& name) {
      const std::size_t at = column_index(columns, name);
      complete = complete && at < columns.size();
      return at;
    };
    constexpr std::array prefix{"", "v", "a"};
    for (std::size_t order = 0; order < 3; ++order)
      for (std::size_t k = 0; k < axes_; ++k) axis_column_[order][k] = find(prefix[order] + in_.machine.axes()[k].name);
    constexpr std::array names{"x", "y", "z"};
    for (std::size_t i = 0; i < in_.coordinates; ++i) tool_column_[i] = find(names[i]);
    s_column_ = find("s"), v_column_ = find("v");
    complete_ = complete;
    if (!complete_) position_.raise(unlimited, tolerance, 0);
  }

  bool reads() const override { return complete_; }

  void row(std::size_t i, const double* row) override {
    const double t = static_cast<double>(i) * in_.setpoints.cycle_time(), v = row[v_column_];
    const double h = v > 0 ? std::min(longest, step / v) : longest;
    const Vec here = place(row, 0), before = place(row, -h), after = place(row, h);
    const double s = row[s_column_];
    segment_ = in_.path.find(s, segment_);
    const Vec speed = (after - before) / (2 * h), bent = (after - 2 * here + before) / (h * h);
    const double most_velocity = relative * v + least_speed,
                 most_acceleration = relative * (norm(bent) + v * v) + least_acceleration;
    Difference off = against(segment_, s, v, here, speed, bent);
    const auto strain = [&](const Difference& d) {
      return std::max(d.velocity / most_velocity, d.acceleration / most_acceleration);
    };
    const auto offer = [&](std::size_t segment, double place) {
      const Difference other = against(segment, place, v, here, speed, bent);
      if (strain(other) < strain(off)) off = other;
    };
    // Where segments meet the row may be on the end of either, by rounding of s.
    constexpr double rounding = 1e-9;  // mm
    const Segment& segment = in_.path[segment_];
    if (segment_ > 0 && s - segment.s0() < rounding) offer(segment_ - 1, segment.s0());
    if (segment_ + 1 < in_.path.size() && segment.s1() - s < rounding) offer(segment_ + 1, segment.s1());
    position_.raise(off.position, tolerance, t);
    velocity_.raise(off.velocity, most_velocity, t);
    acceleration_.raise(off.acceleration, most_acceleration, t);
    Vec told = here;
    for (std::size_t k = 0; k < in_.coordinates; ++k) told[k] = row[tool_column_[k]];
    pose_.raise(norm(here - told), tolerance, t);
  }

  std::vector<Check> checks() override {
    using quantity::tip_position;
    return {verify::make_check({tip_position, 0}, position_), verify::make_check({tip_position, 1}, velocity_),
            verify::make_check({tip_position, 2}, acceleration_), verify::make_check({quantity::rows_pose, 0}, pose_)};
  }

 private:
  /// Differences of the tool from the contour.
  struct Difference {
    double position, velocity;
    double acceleration;  ///< across the path
  };
  Difference against(std::size_t segment, double s, double v, Vec here, Vec speed, Vec bent) const {
    const PathPoint wanted = in_.path[segment].at(s);
    const Vec across = bent - dot(bent, wanted.d1) * wanted.d1;
    return {norm(here - wanted.value - Vec{0, 0, in_.height}), norm(speed - v * wanted.d1),
            norm(across - v * v * wanted.d2)};
  }
  Vec place(const double* row, double h) const {
    AxisArray q{};
    for (std::size_t k = 0; k < axes_; ++k)
      q[k] =
          (row[axis_column_[0][k]] + h * (row[axis_column_[1][k]] + 0.5 * h * row[axis_column_[2][k]])) / in_.shown[k];
    Vec at = in_.machine.forward(q).position;
    if (in_.coordinates < 3) at.z = in_.height;  // no axis moves it
    return at;
  }

  ToolInput in_;
  std::size_t axes_, segment_ = 0;
  bool complete_ = false;
  std::array<std::array<std::size_t, max_axes>, 3> axis_column_{};
  std::array<std::size_t, 3> tool_column_{};
  std::size_t s_column_ = 0, v_column_ = 0;
  Strained position_, velocity_, acceleration_, pose_;
};

}  // namespace

std::unique_ptr<RowCheck> tool_row_check(const ToolInput& input) { return std::make_unique<ToolRows>(input); }

}  // namespace bahnwerk
