#include "core/verify/setpoints/motion_setpoint_checks.hpp"

#include <array>
#include <cmath>
#include <string>

#include "core/base/progress_scope.hpp"
#include "core/base/read_rows.hpp"
#include "core/verify/rounding.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace {

using verify::epsilon;
using verify::rounding;
using verify::Strained;

constexpr std::size_t units_per_row = 4;  // of work, for progress

/// Per axis its columns of position, velocity and acceleration.
using Columns = std::array<std::array<std::size_t, 3>, max_axes>;

/// False where one is missing.
bool find(const std::vector<Column>& columns, const Machine& machine, std::size_t axes, Columns& found) {
  for (std::size_t k = 0; k < axes; ++k)
    for (std::size_t order = 0; order < 3; ++order) {
      const std::string name = std::array{"", "v", "a"}[order] + machine.axes[k].name;
      found[k][order] = column_index(columns, name);
      if (found[k][order] == columns.size()) return false;
    }
  return true;
}

struct Worst {
  Strained count, time, position, velocity, acceleration, end;
};

void check_row(const double* row, const Columns& columns, const MotionState& state, std::size_t axes, double piece,
               double t, Worst& worst) {
  const double blur = epsilon * t;
  for (std::size_t k = 0; k < axes; ++k) {
    const double v = std::abs(state.velocity[k]), a = std::abs(state.acceleration[k]), j = std::abs(state.jerk[k]);
    worst.position.raise(
        std::abs(row[columns[k][0]] - state.position[k]),
        rounding * (std::abs(state.position[k]) + piece * (v + piece * (a / 2 + piece * j / 6))) + v * blur, t);
    worst.velocity.raise(std::abs(row[columns[k][1]] - state.velocity[k]),
                         rounding * (v + piece * (a + piece * j / 2)) + a * blur, t);
    worst.acceleration.raise(std::abs(row[columns[k][2]] - state.acceleration[k]),
                             rounding * (a + piece * j) + j * blur, t);
  }
}

void check_end(const double* row, const Columns& columns, const MotionState& state, std::size_t axes, double t,
               Worst& worst) {
  for (std::size_t k = 0; k < axes; ++k) {
    worst.end.raise(std::abs(row[columns[k][0]] - state.position[k]), 0, t);
    worst.end.raise(std::abs(row[columns[k][1]] - state.velocity[k]), 0, t);
    worst.end.raise(std::abs(row[columns[k][2]] - state.acceleration[k]), 0, t);
  }
}

}  // namespace

std::vector<Check> motion_setpoint_checks(const Motion& motion, const Machine& machine, const SetpointSource& setpoints,
                                          Progress& progress, double progress_from, double progress_to) {
  ProgressScope pulse(progress, "verify setpoints", progress_from, progress_to);
  pulse.report();
  const std::size_t rows = setpoints.count(), axes = motion.axes();
  const double last = static_cast<double>(rows) - 1, duration = motion.duration(), cycle = machine.cycle_time;
  Worst worst;
  Columns columns{};
  const bool complete = machine.axes.size() == axes && find(setpoints.columns(), machine, axes, columns);
  worst.count.raise(complete ? std::abs(last - std::round(duration / cycle)) : 1, 0, 0);
  worst.time.raise(std::abs(last * cycle - duration), rounding * duration, duration);
  worst.time.raise(std::abs(setpoints.duration() - duration), rounding * duration, duration);
  worst.time.raise(std::abs(setpoints.cycle_time() - cycle) * last, rounding * duration, duration);
  std::size_t piece = 0;
  const auto check = [&](std::size_t k, const double* row) {
    const double t = static_cast<double>(k) * cycle;
    if (k + 1 == rows) return check_end(row, columns, motion.final_state(), axes, t, worst);
    while (piece + 1 < motion.pieces() && motion.begin(piece + 1) <= t) ++piece;
    check_row(row, columns, motion.in_piece(piece, t), axes, motion.end(piece) - motion.begin(piece), t, worst);
  };
  if (complete)
    for_each_row(setpoints, check, [&](std::size_t done, std::size_t count) {
      pulse.done(static_cast<double>(done) / static_cast<double>(rows));
      pulse.work(count * units_per_row);
    });
  using verify::make_check;
  pulse.done(1);
  pulse.report();
  return {make_check("setpoints count", "1", worst.count),
          make_check("setpoints time", "s", worst.time),
          make_check("setpoints position", "mm", worst.position),
          make_check("setpoints velocity", "mm/s", worst.velocity),
          make_check("setpoints acceleration", "mm/s²", worst.acceleration),
          make_check("setpoints end", "mm", worst.end)};
}

}  // namespace bahnwerk
