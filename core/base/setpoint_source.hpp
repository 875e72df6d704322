#pragma once
/// The setpoints of a plan: rows of doubles, one per cycle of the controller.
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

}  // namespace bahnwerk
