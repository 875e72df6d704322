#pragma once
/// The setpoints of a plan: rows of doubles, one per cycle of the controller.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace bahnwerk {

/// A column of a series.
struct Column {
  std::string name;
  std::string unit;
};

/// Place, in the machine's frame, of the frame in which the columns x, y, z, phi are given: rotation about z, then
/// translation.
struct PoseFrame {
  double x = 0, y = 0, z = 0;  ///< mm
  double angle = 0;            ///< deg
};

/// The independent variable of a series: row k is the state at k · step.
struct Independent {
  std::string name = "time";
  std::string unit = "s";
  double step = 0;  ///< distance of two rows, in `unit`
  bool time() const { return name == "time"; }
};

/// A series of setpoints, computed on demand: row k is the state at k · step of the independent variable, which is time
/// with the step cycle_time unless a source overrides it. Rows are row-major doubles.
class SetpointSource {
 public:
  virtual ~SetpointSource() = default;
  virtual const std::vector<Column>& columns() const = 0;
  virtual std::size_t count() const = 0;
  virtual double cycle_time() const = 0;  ///< s per row; over a master's position: at the master's nominal speed
  virtual Independent independent() const { return {"time", "s", cycle_time()}; }
  virtual double duration() const = 0;  ///< s, (count − 1) · cycle_time
  /// Returns the frame of the columns of the pose; none if the rows have no pose, or if poses exist in one frame only.
  virtual std::optional<PoseFrame> pose_frame() const { return std::nullopt; }
  /// Writes rows [first, first + rows) into `out`, columns().size() doubles each. Thread-safe, deterministic per row.
  virtual void read(std::size_t first, std::size_t rows, double* out) const = 0;
};

}  // namespace bahnwerk
