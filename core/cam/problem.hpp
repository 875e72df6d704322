#pragma once
/// What a motion law has to keep [Nolte 2, 3]: points on a master's angle with values or ranges, how smooth the law is
/// at each of them, limits inside the sections between them, and what makes one law better than another.
///
/// Units: angles in the master's unit; positions in the slave's; derivatives with respect to time, unit/s^r, wherever
/// the cycle's duration is known. Section i begins at point i; an open law of N points has N − 1 sections, a periodic
/// one has N: the last leads to point 0, one master length later.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/cam/classical_law.hpp"

namespace bahnwerk::cam {

inline constexpr int max_degree = 21;     ///< the highest one of a section
inline constexpr int limited_orders = 4;  ///< position, velocity, acceleration, jerk: orders that sections and J know

/// A value (min = max) or a range; an end that is absent is infinite.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool fixed() const { return min == max; }
  bool free() const { return min == -std::numeric_limits<double>::infinity() && max == -min; }
  bool empty() const { return !(min <= max); }
};

struct MotionPoint {
  Range at;                   ///< the angle, master's unit; fixed or a bounded range
  std::vector<Range> values;  ///< one per order, 0 position; what is absent or free() is not asked for
  int continuity = 2;         ///< the document's order; see MotionLawProblem::continuity()
  std::array<Range, limited_orders> section{};  ///< limits by order, all over the section that begins here
  std::optional<double> weight;                 ///< see LawObjective; of the section that begins here
  std::optional<ClassicalLaw> law;              ///< the law of the section that begins here; none: a polynomial
  std::optional<double> inflection;             ///< λ of that law, 0 < λ < 1; none: 0.5
  SineStraight fractions;                       ///< those of law `sine_straight_combination`
  bool still = false;                           ///< no residual vibration of `vibration` from here on

  Range value(int order) const {
    return order < static_cast<int>(values.size()) ? values[static_cast<std::size_t>(order)] : Range{};
  }
};

/// J = Σ weight[r] · (largest |s^(r)| inside the sections), r = 1 velocity, 2 acceleration, 3 jerk; weight[0] is 0.
/// A section with a weight of its own is not among these: its own such sum is added to J, times that weight.
struct LawObjective {
  std::array<double, limited_orders> weight{0, 1, 1, 0.1};
  /// Each peak counts as its coefficient peak · T^r / h, T the cycle's duration, h = points_stroke().
  bool normalised = false;
  /// Order whose RMS value is least among the laws of least J, 2 or 3; 0: none is asked for. `optimal` alone.
  int then_order = 0;
  /// Cost added for each sign change of velocity and of acceleration inside a section; `active_set` alone.
  double zero_crossing_penalty = 0;
};

struct VibrationMode {
  double frequency = 0;  ///< Hz, of the undamped mode
  double damping = 0;    ///< ratio, 0 ≤ damping < 1
};
/// Limits of a drive; infinite where it is not limited.
struct DriveLimits {
  double velocity = std::numeric_limits<double>::infinity();
  double acceleration = std::numeric_limits<double>::infinity();
  double jerk = std::numeric_limits<double>::infinity();
};

/// The sections of a law in groups that share their peaks in J.
struct PeakGroups {
  std::vector<std::size_t> of_section;  ///< number of the group of each section
  std::vector<double> weight;           ///< factor of each group's peaks in J
  std::size_t count() const { return weight.size(); }
  double least_weight() const { return *std::min_element(weight.begin(), weight.end()); }
};

/// A limit of the force or torque that a load takes, Σ factor[r] s^(r), r = 0 … 2.
struct EffortLimit {
  std::array<double, 3> factor{};
  Range range;
};

enum class LawMethod { active_set, optimal };

struct MotionLawProblem {
  std::string master_unit = "deg", slave_unit = "mm";
  double length = 360;                   ///< length of one cycle, master's unit, > 0
  std::optional<double> cycle_duration;  ///< s, > 0; none: as short as `drive` allows
  bool periodic = false;
  double travel = 0;                ///< position at a periodic law's end less that at its begin
  std::vector<MotionPoint> points;  ///< ascending; an open law's first and last are fixed and `length` apart
  LawObjective objective;
  LawMethod method = LawMethod::active_set;
  std::optional<int> degree;  ///< `optimal` alone; none: degree and pieces as the bound asks
  int pieces = 1;             ///< `optimal` cuts each section into so many
  std::optional<DriveLimits> drive;
  std::optional<EffortLimit>
      effort;  ///< limit in a given cycle, all over the sections without a classical law; `optimal`
  std::vector<VibrationMode> vibration;
  std::uint64_t seed = 1;

  std::size_t sections() const { return periodic ? points.size() : points.size() - 1; }
  /// Returns the point at which section i ends.
  std::size_t end_point(std::size_t section) const { return section + 1 < points.size() ? section + 1 : 0; }
  /// Returns what the position at the end of a section is more than that at the point where it ends: the travel in the
  /// last section of a periodic law.
  double travel_at_end(std::size_t section) const { return periodic && end_point(section) <= section ? travel : 0; }
  /// Returns the position that the point at a section's end asks for there.
  Range end_position(std::size_t section) const;
  /// Returns the order up to which derivatives are the same on both sides of point i: the document's, or the highest
  /// order of a value or range there if that is larger. It has no meaning at the ends of an open law.
  int continuity(std::size_t point) const;
  bool has_free_angles() const;
  /// Returns the duration of a master's unit, s. It needs the cycle's duration.
  double seconds_per_unit() const { return *cycle_duration / length; }
  /// Returns the stroke that the points force over one cycle: the highest lower end of their position ranges less the
  /// lowest upper end, at least the travel; 0 if that is negative.
  double points_stroke() const;
  /// Returns the sections by what share their peaks in J: a group per section with a weight, and one of all the others.
  PeakGroups peak_groups() const;
};

/// Returns the breakpoints of all sections for chosen angles (one per point, master's unit), in s: sections() + 1 of
/// them, the first one that of point 0.
std::vector<double> section_times(const MotionLawProblem& problem, const std::vector<double>& at);

}  // namespace bahnwerk::cam
