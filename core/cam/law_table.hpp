#pragma once
/// The table of a law: phi, s, v, a, j at equal steps over one cycle of the master, both ends included.
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/base/setpoint_source.hpp"
#include "core/cam/cam_law.hpp"

namespace bahnwerk::cam {

/// Returns the angle at which the table of a problem begins, master's unit: an open law at its first point; a periodic
/// one at 0 where its points lie in 0 … length, else at its first point.
double table_begin(const MotionLawProblem& problem);

/// Row k: the angle table_begin + k · length/steps; position, velocity, acceleration and jerk just behind it; an open
/// law's last row is its end. A row that lies on a break but for rounding is behind it. O(degree) per row.
class LawTable final : public SetpointSource {
 public:
  LawTable(CamLaw law, const MotionLawProblem& problem, double cycle_duration, std::size_t steps);
  const std::vector<Column>& columns() const override { return columns_; }
  std::size_t count() const override { return steps_ + 1; }
  double cycle_time() const override { return cycle_duration_ / static_cast<double>(steps_); }
  double duration() const override { return cycle_duration_; }
  /// Returns phi in the master's unit, or time if the master's unit is s.
  Independent independent() const override;
  void read(std::size_t first, std::size_t rows, double* out) const override;

 private:
  CamLaw law_;
  std::vector<Column> columns_;
  double begin_, length_, cycle_duration_;
  std::size_t steps_;
};

}  // namespace bahnwerk::cam
