#pragma once
/// Knots of one iteration for the next, whose head takes longer here and there: each keeps its block, and its share of
/// the time in it. Where nothing else changes the coarse axes then do what they did before.
#include <cstddef>
#include <vector>

#include "core/redundant/iterative/split_peaks.hpp"
#include "core/redundant/iterative/time_spline.hpp"

namespace bahnwerk {

class KeptKnots {
 public:
  /// Where those splines, one per axis, are made of pieces. O(samples + pieces).
  void keep(const HeadSamples& head, const std::vector<TimeSpline>& coarse);
  /// When that is with another head on the same blocks, s, ascending. O(samples + knots).
  std::vector<double> times(const HeadSamples& head, std::size_t axis) const;

 private:
  struct Knot {
    std::size_t block;
    double share;
  };
  std::vector<std::vector<Knot>> knots_;  ///< per axis
};

}  // namespace bahnwerk
