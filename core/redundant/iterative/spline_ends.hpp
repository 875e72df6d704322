#pragma once
/// End conditions of a spline, imposed by elimination of control points [Bock 4.2.3, (4.7)–(4.9)]: position and
/// velocity are given at the begin, and the acceleration where it has to be continuous; at the end the spline is at
/// rest at a free or given position.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/redundant/iterative/spline_space.hpp"

namespace bahnwerk {

struct SplineBegin {
  double position = 0, velocity = 0, acceleration = 0;  ///< mm, mm/s, mm/s²
  int order = 2;  ///< number of derivatives, the position included, that are given at the begin and, but for the
                  ///< position, 0 at the end: 2 or 3
  std::optional<double> end = {};  ///< mm, given end position; none: it is free
};

/// An affine function of the variables y: Σ weights[r] · y[first + r] + offset, r < count.
struct VariableRow {
  std::size_t first = 0, count = 0;
  std::array<double, max_spline_degree + 1> weights{};
  double offset = 0;
};

/// The free control points of a spline. As many control points as the begin's order are fixed at the begin, and as many
/// are equal at the end; the latter are fixed as well if the end position is given.
class SplineEnds {
 public:
  /// Returns the least number of control points.
  static std::size_t least(const SplineBegin& begin) {
    return 2 * static_cast<std::size_t>(begin.order) + (begin.end ? 1 : 0);
  }
  SplineEnds(const SplineSpace& space, const SplineBegin& begin);

  std::size_t variables() const { return variables_; }
  /// Returns a row of control points as a row of the variables.
  VariableRow reduced(const SplineRow& row) const;
  /// Tells whether each of the control points [first, first + count) is a variable of its own.
  bool fixes_none_of(std::size_t first, std::size_t count) const {
    return first >= fixed_.size() && first + count <= fixed_.size() + variables_;
  }
  /// Returns all control points for given variables.
  std::vector<double> controls(const std::vector<double>& variables) const;
  /// Returns the index of the (first) control point that is variable i.
  std::size_t control(std::size_t i) const { return i + fixed_.size(); }

 private:
  std::size_t size_, variables_;
  std::vector<double> fixed_;  ///< fixed control points at the begin
  std::optional<double> end_;
};

}  // namespace bahnwerk
