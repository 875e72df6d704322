#pragma once
/// The curves of a path as quotients Z(u)/N(u), with the first two derivatives of both by the curve's parameter, which
/// interpolators expand [Herrmann (3.81), (4.65)].
#include <cstddef>
#include <vector>

#include "core/geometry/curve/vec.hpp"
#include "core/geometry/path/path.hpp"

namespace bahnwerk {

/// The numerator is taken relative to the curve's point at u: (Z − s(u) N)(u) = 0, so that differences of large
/// coordinates do not cost digits. z1, z2 are its first and second derivative, mm; n0, n1, n2 are N, N′, N″.
struct QuotientJet {
  Vec z1, z2;
  double n0 = 1, n1 = 0, n2 = 0;
  /// Returns s′ of the quotient; d2() returns s″.
  Vec d1() const { return (1 / n0) * z1; }
  Vec d2() const { return (1 / n0) * (z2 - (2 * n1 / n0) * z1); }
};

/// The quotients of all segments of a path. Lines, arcs and polynomials have N = 1; an arc's numerator is the arc
/// itself.
class PieceSeries {
 public:
  /// `path` is stored by reference. O(segments · degree) memory.
  explicit PieceSeries(const Path& path);
  /// O(degree), no allocation.
  QuotientJet at(std::size_t segment, double u) const;

 private:
  struct Piece {
    std::size_t first = 0, terms = 0;  // range in c_, four numbers per power of t: x, y, z, weight; with 0 terms the
                                       // curve is evaluated itself
    double pivot = 0, inverse = 1;     // t = (u − pivot) · inverse
  };
  const Path& path_;
  std::vector<Piece> pieces_;
  std::vector<double> c_;
};

}  // namespace bahnwerk
