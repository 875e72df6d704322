#pragma once
/// Checks of the rows of a series: several of them share one pass, so that each row is evaluated once.
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/base/setpoint_source.hpp"
#include "core/base/verification.hpp"

namespace bahnwerk {

/// A check that receives all rows of a series in order and then returns its results.
class RowCheck {
 public:
  virtual ~RowCheck() = default;
  /// Receives row k, from 0 on; `row` has as many numbers as the series has columns.
  virtual void row(std::size_t k, const double* row) = 0;
  /// Returns whether the check can read the rows: false if columns are missing.
  virtual bool reads() const { return true; }
  /// Returns the results. Called once, after the last row.
  virtual std::vector<Check> checks() = 0;
};

using RowChecks = std::vector<std::unique_ptr<RowCheck>>;

/// Reads the series once, 1024 rows at a time, for all checks that can read rows. Memory: 1024 rows.
void read_rows(const SetpointSource& setpoints, std::span<const std::unique_ptr<RowCheck>> all,
               ProgressScope& progress);

/// Reads the series for a single check and returns its results.
std::vector<Check> check_rows(const SetpointSource& setpoints, std::unique_ptr<RowCheck> check,
                              ProgressScope& progress);

}  // namespace bahnwerk
