#pragma once
/// A finished motion of coarse and fine axes as a path over its own time, which planners of time laws can plan again
/// [Bock 5.1].
#include <cstddef>
#include <memory>
#include <vector>

#include "core/motion/axes/axis_path.hpp"
#include "core/motion/axes/motion.hpp"

namespace bahnwerk {

/// Path length is the old time, 1 mm for 1 ms. The tool's path is straight, with one segment per interval in which both
/// motions are smooth. Axes 0 … N−1 are the coarse axes; axes N … 2N−1 are the fine ones, head less coarse.
class TimedPath final : public AxisPath {
 public:
  static constexpr double per_second = 1000;  ///< mm of path length per second
  struct SmoothInterval {
    double begin = 0, end = 0;         ///< s
    std::size_t head = 0, coarse = 0;  ///< pieces
  };
  /// Returns the intervals in which both motions are smooth; intervals shorter than 1e-11 s are left out.
  static std::vector<SmoothInterval> smooth_intervals(const Motion& head, const Motion& coarse);

  /// `tool` is tool_path(intervals); it and both motions must outlive this object. N ≤ max_axes/2.
  TimedPath(const Path& tool, const Motion& head, const Motion& coarse, std::vector<SmoothInterval> intervals);
  /// Returns the straight path with one segment per interval.
  static Path tool_path(const std::vector<SmoothInterval>& intervals);

  bool linear(std::size_t) const override { return false; }
  AxisJet at_parameter(std::size_t segment, double u) const override;
  void at_parameters(std::size_t segment, PathBatch& batch) const override;
  MapBounds map_bounds(std::size_t, double, double) const override { return every_axis_moves(); }
  const SmoothInterval& interval(std::size_t segment) const { return intervals_[segment]; }

 private:
  AxisJet at_time(std::size_t segment, double t) const;

  const Motion &head_, &coarse_;
  std::vector<SmoothInterval> intervals_;
};

}  // namespace bahnwerk
