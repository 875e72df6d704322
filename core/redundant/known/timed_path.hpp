#pragma once
/// A finished motion of coarse and fine axes as a path over its own time, which planners of time laws can drive once
/// more [Bock 5.1].
#include <cstddef>
#include <memory>
#include <vector>

#include "core/motion/axes/axis_path.hpp"
#include "core/motion/axes/motion.hpp"

namespace bahnwerk {

/// Path length is the old time, 1 mm for 1 ms: a straight tool path with one segment per stretch of time in which both
/// motions are smooth. Axes 0 … N−1: coarse; N … 2N−1: head less coarse.
class TimedPath final : public AxisPath {
 public:
  static constexpr double per_second = 1000;  ///< mm
  struct Stretch {
    double begin = 0, end = 0;         ///< s
    std::size_t head = 0, coarse = 0;  ///< pieces
  };
  /// Stretches of both motions, of less than 1e-11 s left out.
  static std::vector<Stretch> stretches(const Motion& head, const Motion& coarse);

  /// `tool` is tool_path() of the stretches and outlives it, like the motions. N ≤ max_axes/2.
  TimedPath(const Path& tool, const Motion& head, const Motion& coarse, std::vector<Stretch> stretches);
  static Path tool_path(const std::vector<Stretch>& stretches);

  bool linear(std::size_t) const override { return false; }
  AxisJet at_parameter(std::size_t segment, double u) const override;
  void at_parameters(std::size_t segment, PathBatch& batch) const override;
  MapBounds map_bounds(std::size_t, double, double) const override { return every_axis_moves(); }
  const Stretch& stretch(std::size_t segment) const { return stretches_[segment]; }

 private:
  AxisJet at_time(std::size_t segment, double t) const;

  const Motion &head_, &coarse_;
  std::vector<Stretch> stretches_;
};

}  // namespace bahnwerk
