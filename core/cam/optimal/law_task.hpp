#pragma once
/// A motion law problem in units of its own: what all parts of `optimal` work on. Times are in parts of the mean
/// section, positions in parts of the points' span, so that derivatives of every order are of the order of 1 to 100.
#include <array>
#include <cstddef>
#include <vector>

#include "core/cam/problem.hpp"

namespace bahnwerk::cam {

struct LawTask {
  struct Condition {
    std::size_t point;
    int order;
    Range range;
  };
  /// ∫ a(t) e^{(σ + iω) t} dt = 0 from one point to another (the same one: around the cycle).
  struct Vibration {
    std::size_t from, to;
    double decay, frequency;  ///< σ, ω
  };

  bool periodic = false;
  double cycle = 0;                                       ///< duration
  std::vector<Range> at;                                  ///< each point's time
  std::vector<int> continuity;                            ///< each point's order of continuity
  std::vector<Condition> conditions;                      ///< values and ranges at points
  std::vector<std::array<Range, limited_orders>> limits;  ///< each section's limits by order
  std::array<double, limited_orders> weight{};            ///< each peak's, in these units; J is in the user's
  /// J is the largest weight · peak instead of their sum: how far a law exceeds limits that are 1 / weight.
  bool largest_peak = false;
  std::vector<Vibration> vibration;
  double unit_time = 1, unit_position = 1,
         origin = 0;  ///< s, slave's units: t = unit_time t', s = origin + unit_position s'

  std::size_t points() const { return at.size(); }
  std::size_t sections() const { return limits.size(); }
  std::size_t end_point(std::size_t section) const { return section + 1 < points() ? section + 1 : 0; }
  bool free_angles() const;
  /// Whether a section begins at the point and one ends there, whose derivatives meet.
  bool joint(std::size_t point) const { return periodic || (point > 0 && point + 1 < points()); }
  /// Derivatives of that order of the law, in these units: what one of the user's unit/s^order is.
  double to_task(int order) const;
  /// Breaks of the sections, sections() + 1, for chosen times of the points.
  std::vector<double> breaks(const std::vector<double>& times) const;
  /// Times in the middle of their ranges, ascending.
  std::vector<double> middle() const;
};

/// Needs the cycle's duration.
LawTask make_law_task(const MotionLawProblem& problem);

}  // namespace bahnwerk::cam
