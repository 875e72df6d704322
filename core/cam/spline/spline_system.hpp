#pragma once
/// The linear system of a polynomial spline [Nolte 2]: values at points as interpolation conditions, continuity between
/// sections, open or periodic; unknowns are the Bernstein coefficients of every section over its local parameter, rows
/// are scaled to a largest entry of 1, so that neither time nor stroke changes the system's condition.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/cam/cam_law.hpp"
#include "core/cam/spline/degrees.hpp"

namespace bahnwerk::cam {

struct ValueCondition {
  std::size_t point = 0;
  int order = 0;
  double value = 0;  ///< unit/s^order
};

/// A section whose law is known, cut into pieces that cover it.
struct GivenSection {
  std::vector<double> breaks;                  ///< ends of the section and of its pieces, s
  std::vector<std::vector<double>> bernstein;  ///< Bernstein coefficients of each piece
  /// Returns s^(order) at the section's begin or end.
  double end_value(bool at_end, int order) const;
};

struct SplineTask {
  std::vector<double> breaks;  ///< s, sections + 1
  bool periodic = false;
  double travel = 0;                   ///< what the position of a periodic law grows by in a cycle
  std::vector<int> continuity;         ///< order of continuity of each point; not used at the ends of an open law
  std::vector<ValueCondition> values;  ///< each point and order once, order ≤ continuity but for ends of an open law
  std::vector<std::optional<GivenSection>> given;  ///< empty, or one per section
  std::size_t sections() const { return breaks.size() - 1; }
  std::size_t points() const { return periodic ? sections() : sections() + 1; }
  bool is_given(std::size_t section) const { return !given.empty() && given[section].has_value(); }
};

/// Return the conditions of every point that are shared between its sections, and which sections have unknowns.
std::vector<PointShare> point_shares(const SplineTask& task);
std::vector<bool> sections_with_unknowns(const SplineTask& task);

/// Why a system has no single solution.
struct SingularSystem {
  struct Row {
    std::size_t point = 0;
    int order = 0;
    bool continuity = false;  ///< whether the row asks for a derivative's continuity, not for a value
  };
  std::vector<Row> dependent;     ///< rows that follow from each other or contradict, from the left null vector
  std::vector<Row> undetermined;  ///< derivatives at points that remain free, from the right null vector
};

struct SolvedSpline {
  std::vector<std::vector<double>> bernstein;  ///< Bernstein coefficients of each section; empty for given ones
  std::optional<SingularSystem> singular;      ///< if set, there are no coefficients
};
/// Solves the system with `degrees`, one of balance_degrees(); −1 for given sections. A system counts as singular if
/// its smallest singular value is below 1e-11 of the largest entry. O(sections · (degree · conditions)²).
SolvedSpline solve_spline(const SplineTask& task, const std::vector<int>& degrees);
/// Returns the condition number of the scaled system (2-norm), to a few percent.
double spline_condition(const SplineTask& task, const std::vector<int>& degrees);

/// Returns the law of solved and given sections.
CamLaw assemble_law(const SplineTask& task, const SolvedSpline& solved);

}  // namespace bahnwerk::cam
