#include "core/verify/setpoints/motion_setpoint_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/read_rows.hpp"
#include "core/verify/rounding.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace {

using verify::epsilon;
using verify::rounding;
using verify::Strained;

constexpr std::size_t needed_orders = 3;  // position, velocity and acceleration

class MotionRows final : public RowCheck {
 public:
  explicit MotionRows(const MotionSetpointInput& in) : in_(in), axes_(in.motion.axes()) {
    find_columns();
    const double last = static_cast<double>(in_.setpoints.count()) - 1, duration = in_.motion.duration(),
                 cycle = in_.machine.cycle_time;
    count_.raise(reads() ? std::abs(last - std::round(duration / cycle)) : 1, 0, 0);
    time_.raise(std::abs(last * cycle - duration), rounding * duration, duration);
    time_.raise(std::abs(in_.setpoints.duration() - duration), rounding * duration, duration);
    time_.raise(std::abs(in_.setpoints.cycle_time() - cycle) * last, rounding * duration, duration);
  }

  bool reads() const override { return orders_ >= needed_orders; }

  void row(std::size_t k, const double* row) override {
    const Motion& motion = in_.motion;
    const double t = static_cast<double>(k) * in_.machine.cycle_time;
    if (k + 1 == in_.setpoints.count()) return check_end(row, motion.final_state(), t);
    while (piece_ + 1 < motion.pieces() && motion.begin(piece_ + 1) <= t) ++piece_;
    check(row, motion.in_piece(piece_, t), motion.end(piece_) - motion.begin(piece_), t);
  }

  std::vector<Check> checks() override {
    using verify::make_check;
    using enum CheckedQuantity;
    const auto of = [&](CheckedQuantity quantity, std::size_t order, const char* unit) {
      return Checked{quantity, static_cast<int>(order), unit, in_.group};
    };
    std::vector<Check> list{make_check(of(rows_count, 0, "1"), count_), make_check(of(rows_time, 0, "s"), time_)};
    for (std::size_t order = 0; order < std::max(orders_, needed_orders); ++order)
      list.push_back(make_check(of(rows, order, "mm"), off_[order]));
    list.push_back(make_check(of(rows_end, 0, "mm"), end_));
    return list;
  }

 private:
  /// Derivatives are checked as far as every axis has a column of them.
  void find_columns() {
    const auto& columns = in_.setpoints.columns();
    if (in_.machine.axes.size() != axes_) return;
    for (; orders_ < MotionState::orders; ++orders_)
      for (std::size_t k = 0; k < axes_; ++k) {
        const std::string name = std::array{"", "v", "a", "j", "s"}[orders_] + in_.machine.axes[k].name;
        columns_[orders_][k] = column_index(columns, name);
        if (columns_[orders_][k] == columns.size()) return;
      }
  }

  /// Returns the sum of the magnitudes of a derivative's terms within a piece of that duration, up to the jerk.
  static double terms(const MotionState& state, std::size_t order, std::size_t axis, double piece) {
    const double x = std::abs(state[0][axis]), v = std::abs(state[1][axis]), a = std::abs(state[2][axis]),
                 j = std::abs(state[3][axis]);
    switch (order) {
      case 0:
        return x + piece * (v + piece * (a / 2 + piece * j / 6));
      case 1:
        return v + piece * (a + piece * j / 2);
      case 2:
        return a + piece * j;
      default:
        return std::abs(state[order][axis]);
    }
  }

  void check(const double* row, const MotionState& state, double piece, double t) {
    const double rounding_error = epsilon * t;
    for (std::size_t order = 0; order < orders_; ++order)
      for (std::size_t k = 0; k < axes_; ++k) {
        const double next = order + 1 < MotionState::orders ? std::abs(state[order + 1][k]) : 0;
        off_[order].raise(std::abs(row[columns_[order][k]] - state[order][k]),
                          rounding * terms(state, order, k, piece) + next * rounding_error, t);
      }
  }

  void check_end(const double* row, const MotionState& state, double t) {
    for (std::size_t order = 0; order < orders_; ++order)
      for (std::size_t k = 0; k < axes_; ++k) end_.raise(std::abs(row[columns_[order][k]] - state[order][k]), 0, t);
  }

  MotionSetpointInput in_;
  std::size_t axes_, orders_ = 0, piece_ = 0;
  std::array<std::array<std::size_t, max_axes>, MotionState::orders> columns_{};
  Strained count_, time_, end_;
  std::array<Strained, MotionState::orders> off_;
};

}  // namespace

std::unique_ptr<RowCheck> motion_row_check(const MotionSetpointInput& input) {
  return std::make_unique<MotionRows>(input);
}

std::vector<Check> motion_setpoint_checks(const Motion& motion, const Machine& machine, const SetpointSource& setpoints,
                                          Progress progress, const std::string& group) {
  ProgressScope stage_progress(progress, "verify setpoints");
  return check_rows(setpoints, motion_row_check({motion, machine, setpoints, group}), stage_progress);
}

}  // namespace bahnwerk
