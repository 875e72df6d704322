#pragma once
/// Conditions at both ends of a spline by elimination of control points [Bock 4.2.3, (4.7)–(4.9)]: at the begin
/// position and velocity are given, and the acceleration where it has to be continuous; at the end it rests wherever it
/// is.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/redundant/iterative/spline_space.hpp"

namespace bahnwerk {

struct SplineBegin {
  double position = 0, velocity = 0, acceleration = 0;  ///< mm, mm/s, mm/s²
  bool with_acceleration = false;                       ///< given, and 0 at the end
  std::optional<double> end = {};                       ///< mm, where it comes to rest, if not wherever it is
};

/// Σ weights[r] · y[first + r] + offset, of the variables y.
struct VariableRow {
  std::size_t first = 0, count = 0;
  std::array<double, max_spline_degree + 1> weights{};
  double offset = 0;
};

/// With K = 2 control points fixed at the begin and 2 equal ones at the end (3 each with accelerations), fixed, too,
/// where the end is given.
class SplineEnds {
 public:
  /// Control points that are needed at least.
  static std::size_t least(const SplineBegin& begin) { return (begin.with_acceleration ? 6 : 4) + (begin.end ? 1 : 0); }
  SplineEnds(const SplineSpace& space, const SplineBegin& begin);

  std::size_t variables() const { return variables_; }
  VariableRow reduced(const SplineRow& row) const;
  /// Whether control points [first, first + count) are variables, each its own.
  bool fixes_none_of(std::size_t first, std::size_t count) const {
    return first >= fixed_.size() && first + count <= fixed_.size() + variables_;
  }
  std::vector<double> controls(const std::vector<double>& variables) const;
  /// The control point that variable i is, the first of those that it is.
  std::size_t control(std::size_t i) const { return i + fixed_.size(); }

 private:
  std::size_t size_, variables_;
  std::vector<double> fixed_;  ///< at the begin
  std::optional<double> end_;
};

}  // namespace bahnwerk
