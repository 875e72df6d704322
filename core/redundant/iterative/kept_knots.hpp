#pragma once
/// Transfers the knots of one iteration to the next, whose head takes longer in some blocks: each knot keeps its block
/// and its relative time in that block. Where nothing else changes, the coarse axes then keep their motion.
#include <cstddef>
#include <vector>

#include "core/redundant/iterative/split_peaks.hpp"
#include "core/redundant/iterative/time_spline.hpp"

namespace bahnwerk {

class KeptKnots {
 public:
  /// Stores the knots of `coarse`, one spline per axis. O(samples + pieces).
  void keep(const HeadSamples& head, const std::vector<TimeSpline>& coarse);
  /// Returns the knots' times, s, ascending, for another head on the same blocks. O(samples + knots).
  std::vector<double> times(const HeadSamples& head, std::size_t axis) const;

 private:
  struct Knot {
    std::size_t block;
    double share;
  };
  std::vector<std::vector<Knot>> knots_;  ///< per axis
};

}  // namespace bahnwerk
