#pragma once
/// The square matrix of a spline's conditions, whose nonzeros lie near the diagonal: its LU factors, its condition
/// number, and its null vectors where it is singular.
#include <cstddef>
#include <vector>

#include "core/numeric/linear/band_lu.hpp"

namespace bahnwerk::cam {

class SplineMatrix {
 public:
  /// Entries (row, column, value) of an n × n matrix; entries of one place are added.
  struct Entry {
    std::size_t row, column;
    double value;
  };
  /// Factorises the matrix. O(n · bandwidth²).
  SplineMatrix(std::size_t n, std::vector<Entry> entries);

  /// Returns the factors. A singular matrix has its vanishing pivots replaced.
  const BandLu& factors() const { return factors_; }

  struct NullVectors {
    double smallest = 0;              ///< smallest singular value
    std::vector<double> left, right;  ///< singular vectors of `smallest`, unit length
  };
  /// Returns the smallest singular value and its vectors, by inverse iteration.
  NullVectors null_vectors(int iterations = 40) const;
  /// Returns the ratio of the largest to the smallest singular value, by power iteration, to a few percent.
  double condition() const;

 private:
  double largest_singular_value() const;
  std::size_t n_;
  std::vector<Entry> entries_;
  BandLu factors_;
};

}  // namespace bahnwerk::cam
