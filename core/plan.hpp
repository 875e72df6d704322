#pragma once
/// What every planner returns beside its own report: setpoints, the independent judgement, the proven bound.
#include <cstddef>
#include <string>
#include <vector>

namespace bahnwerk {

struct Column {
  std::string name;
  std::string unit;
};

/// A series of setpoints, computed on demand: row k is the state at k · cycle_time. Rows are row-major doubles.
class SetpointSource {
 public:
  virtual ~SetpointSource() = default;
  virtual const std::vector<Column>& columns() const = 0;
  virtual std::size_t count() const = 0;
  virtual double cycle_time() const = 0;  ///< s
  virtual double duration() const = 0;    ///< s, (count − 1) · cycle_time
  /// Writes rows [first, first + rows) into `out`, columns().size() doubles each. Thread-safe, deterministic per row.
  virtual void read(std::size_t first, std::size_t rows, double* out) const = 0;
};

/// One line of the judge's verdict: the true continuous peak `value` at `at` seconds against `limit`.
struct Check {
  std::string name;
  std::string unit;
  double limit = 0;
  double value = 0;
  double at = 0;
  bool passed = false;
};

struct Verification {
  bool passed = false;
  std::vector<Check> checks;
};

/// No motion under the same limits is shorter than `duration` (s). gap = planned / duration − 1.
struct Bound {
  double duration = 0;
  double gap = 0;
  std::string basis;
};

}  // namespace bahnwerk
