#pragma once
/// The setpoints of a plan: rows of doubles, one per cycle of the controller.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace bahnwerk {

struct Column {
  std::string name;
  std::string unit;
};

/// Where the frame of columns x, y, z, phi stands in the machine's own: turned about z, then shifted.
struct PoseFrame {
  double x = 0, y = 0, z = 0;  ///< mm
  double angle = 0;            ///< deg
};

/// A series of setpoints, computed on demand: row k is the state at k · cycle_time. Rows are row-major doubles.
class SetpointSource {
 public:
  virtual ~SetpointSource() = default;
  virtual const std::vector<Column>& columns() const = 0;
  virtual std::size_t count() const = 0;
  virtual double cycle_time() const = 0;  ///< s
  virtual double duration() const = 0;    ///< s, (count − 1) · cycle_time
  virtual std::optional<PoseFrame> pose_frame() const {
    return std::nullopt;
  }  ///< of a machine that moves a part's tool
  /// Writes rows [first, first + rows) into `out`, columns().size() doubles each. Thread-safe, deterministic per row.
  virtual void read(std::size_t first, std::size_t rows, double* out) const = 0;
};

}  // namespace bahnwerk
