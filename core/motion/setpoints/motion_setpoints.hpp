#pragma once
/// The setpoints of any motion: position and derivatives of every axis of a machine, cycle by cycle.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/base/setpoint_source.hpp"
#include "core/machine/machine.hpp"
#include "core/motion/axes/motion.hpp"
#include "core/motion/interpolation/interpolation.hpp"

namespace bahnwerk {

/// The columns are `<axis>` for every axis of the machine, then `v<axis>`, `a<axis>`, and if requested `j<axis>` and
/// `s<axis>` (jerk and snap), in the axis' unit, unit/s … unit/s⁴. Row k is the state just after k · cycle_time; the
/// last row is Motion::final_state(). Derived classes add columns. A row costs one Motion::evaluate() and its numbers.
class MotionSetpoints : public SetpointSource {
 public:
  /// The motion lasts `cycles` whole cycles; columns go up to derivative `highest`, 0 to 4. Throws
  /// std::invalid_argument if the motion has other axes than the machine, or lacks these derivatives.
  MotionSetpoints(std::shared_ptr<const Motion> motion, const Machine& machine, std::size_t cycles, int highest = 2);
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return cycles_ + 1; }
  double cycle_time() const override { return cycle_time_; }
  double duration() const override { return static_cast<double>(cycles_) * cycle_time_; }
  void read(std::size_t first, std::size_t rows, double* out) const final;

 protected:
  struct Row {
    std::size_t index = 0;
    double t = 0;           ///< time of the row, s
    std::size_t piece = 0;  ///< piece of the motion that holds t
    bool last = false;
    std::size_t place = unknown;  ///< position of write() after the row before, if it is stored there
    Interpolation::Row stepped;   ///< the row before, where places are stepped from row to row
    static constexpr std::size_t unknown = static_cast<std::size_t>(-1);
  };
  void add_column(Column column) { columns_.push_back(std::move(column)); }
  /// Writes a row: position and derivatives of all axes at t, and the added columns. Sets the row's piece. Called for
  /// rows in ascending order.
  virtual void write(Row& row, double* out) const;
  /// Writes the axes of the last row.
  void write_end(double* out) const;

 private:
  std::shared_ptr<const Motion> motion_;
  std::vector<Column> columns_;
  std::size_t cycles_, orders_;
  double cycle_time_;
};

}  // namespace bahnwerk
