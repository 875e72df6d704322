#pragma once
/// A batch of up to 16 neighbouring points of one path segment. Evaluating them at once costs a fraction of evaluating
/// single points; planners build their grids in this way.
#include <array>
#include <cstddef>

#include "core/numeric/lanes.hpp"

namespace bahnwerk {

/// Numbers of two points, computed at once.
using PointPair = Lanes<2>;

/// Parameters of neighbouring points, and the results of their evaluation.
struct PathBatch {
  static constexpr std::size_t most = 16, pairs = most / 2;
  /// A number per point; the last one of an odd count is stored twice.
  struct Row {
    std::array<PointPair, pairs> pair;
    double operator[](std::size_t i) const { return pair[i / 2][i % 2]; }
    void set(std::size_t i, double value) { pair[i / 2][i % 2] = value; }
  };
  std::size_t count = 0;          ///< number of points, 1 … 16
  Row u;                          ///< input: parameters, ascending
  Row s;                          ///< output: path length from the beginning of the segment, mm
  std::array<Row, 8> d1, d2, d3;  ///< output: derivatives of x, y, z, or of as many axes
  bool planar = true;             ///< output: whether z is constant; its rows are then not written
  std::size_t used_pairs() const { return (count + 1) / 2; }
  /// Fills the last pair of an odd count.
  void close() {
    if (count % 2 == 1) u.set(count, u[count - 1]);
  }
};

}  // namespace bahnwerk
