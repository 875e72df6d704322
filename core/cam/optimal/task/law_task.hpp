#pragma once
/// A motion law problem in units of its own: what all parts of `optimal` work on. Times are in parts of the mean
/// section, positions in parts of the points' span, so that derivatives of every order are of the order of 1 to 100.
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/cam/problem.hpp"
#include "core/cam/spline/spline_system.hpp"

namespace bahnwerk::cam {

struct LawTask {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  /// Peaks by order of a law from rest to rest over the mean section, in these units: what derivatives usually have.
  static constexpr double usual_peaks[limited_orders] = {1, 2, 6, 60};
  struct Condition {
    std::size_t point;
    int order;
    Range range;
    std::size_t given = none;  ///< the given section that ends there with this value; none: the document asks for it
  };
  /// ∫ a(t) e^{(σ + iω) t} dt = 0 from one point to another (the same one: around the cycle).
  struct Vibration {
    std::size_t from, to;
    double decay, frequency;  ///< σ, ω
  };

  bool periodic = false;
  double cycle = 0;                                       ///< duration of a cycle
  double travel = 0;                                      ///< what a periodic law's position grows by in a cycle
  std::vector<Range> at;                                  ///< time of each point, a number or a range
  std::vector<int> continuity;                            ///< order of continuity of each point
  std::vector<Condition> conditions;                      ///< values and ranges at points
  std::vector<std::array<Range, limited_orders>> limits;  ///< limits of each section by order
  /// A section whose law is known, over the parameter 0 … 1: with other times of its points it is stretched.
  struct Given {
    GivenSection law;                           ///< breaks from 0 to 1, positions in these units
    std::array<double, limited_orders> peak{};  ///< largest |derivative| by order, for a length of 1
    /// Returns the largest |s^(order)| if the section lasts `length`.
    double peak_at(int order, double length) const;
  };
  /// What derivatives have, by order: rounding of the published positions has to be small beside it.
  std::array<double, limited_orders> size{usual_peaks[0], usual_peaks[1], usual_peaks[2], usual_peaks[3]};
  std::vector<std::optional<Given>> given;  ///< empty, or one entry per section
  PeakGroups groups;  ///< sections that share their peaks; a drive's limits are those of all sections
  std::array<double, limited_orders>
      weight{};  ///< weight of each order's peak, in these units; J is in the user's units
  /// J is the largest weight · peak instead of their sum: how far a law exceeds limits that are 1 / weight.
  bool largest_peak = false;
  std::optional<EffortLimit> effort;  ///< limit of the effort, in parts of half its range
  std::vector<Vibration> vibration;
  double unit_time = 1, unit_position = 1,
         origin = 0;  ///< s, slave's units: t = unit_time t', s = origin + unit_position s'

  std::size_t points() const { return at.size(); }
  std::size_t sections() const { return limits.size(); }
  std::size_t end_point(std::size_t section) const { return section + 1 < points() ? section + 1 : 0; }
  /// Returns what the position at the end of a section is more than that at the point where it ends.
  double travel_at_end(std::size_t section) const { return periodic && end_point(section) <= section ? travel : 0; }
  /// Return the sections that end and begin at a point; none: there is no such section.
  std::size_t section_before(std::size_t point) const {
    return point > 0 ? point - 1 : periodic ? sections() - 1 : none;
  }
  std::size_t section_behind(std::size_t point) const { return point < sections() ? point : none; }
  bool is_given(std::size_t section) const { return section < given.size() && given[section].has_value(); }
  /// Returns the velocity of a section whose limits admit a single one: a straight section.
  std::optional<double> constant_velocity(std::size_t section) const;
  bool free_angles() const;
  /// Returns whether a section begins at the point and one ends there, whose derivatives meet.
  bool joint(std::size_t point) const { return periodic || (point > 0 && point + 1 < points()); }
  /// Returns the factor from the user's unit/s^order to the task's unit of that order.
  double to_task(int order) const;
  /// Returns the breaks of the sections, sections() + 1, for chosen times of the points.
  std::vector<double> breaks(const std::vector<double>& times) const;
  /// Returns the middle of each point's range of times, ascending.
  std::vector<double> middle() const;
};

/// Removes from ranges of times what the order of the points excludes. Returns false if nothing is left of one.
bool tighten(const LawTask& task, std::vector<Range>& at);

/// Returns the task of a problem, which needs the cycle's duration. Throws InvalidInput where classical sections do not
/// fit (given_sections.hpp).
LawTask make_law_task(const MotionLawProblem& problem);

}  // namespace bahnwerk::cam
