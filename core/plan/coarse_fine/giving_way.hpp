#pragma once
/// The table of plans that gave way to others while a contour was planned for coarse and fine axes.
#include <optional>
#include <string>
#include <vector>

#include "core/base/verification.hpp"
#include "core/redundant/redundancy.hpp"

namespace bahnwerk {

/// Returns the failed check whose value is the largest multiple of its limit; none if all passed. A value that is not a
/// number, or whose limit is 0, counts as more than any other.
std::optional<Check> failed_by_most(const Verification& verification);

class GivenUpPlans {
 public:
  bool empty() const { return rows_.empty(); }
  /// Adds the plan of `planner`, which found no motion.
  void add_without_motion(const std::string& planner) { rows_.push_back({planner, GivingWay::no_motion}); }
  /// Adds a plan of `planner` of `duration` s that failed verification with `verdict`.
  void add_failed(const std::string& planner, double duration, const Verification& verdict);
  /// Adds rows of plans that gave way before.
  void add(std::vector<GaveWay> rows);
  /// Returns the rows, then `more`. A row that lacks what was used gets the planner of the next row, the last one
  /// `planner` with its motion of `duration` s.
  std::vector<GaveWay> table(std::vector<GaveWay> more, const std::string& planner, double duration) const;

 private:
  std::vector<GaveWay> rows_;
};

}  // namespace bahnwerk
