#include "core/motion/acceleration/cell_budget.hpp"

#include <algorithm>
#include <string>

#include "core/base/errors.hpp"
#include "core/base/progress_scope.hpp"
#include "core/motion/grid/grid.hpp"

namespace bahnwerk {

namespace {

constexpr double widest = 10, max_turn = 160000;  // largest factor of the width; rad
// Cells wider than these are divided so many times at most, which brings less than their width costs; but limits inside
// them are tightened until what is exceeded is little, for the largest excess slows all.
constexpr double wide = 2, very_wide = 4;
constexpr int divisions_of_wide = 3, divisions_of_very_wide = 1, rounds_of_wide = 12;
constexpr double excess_of_wide = 1e-6;
constexpr double graded_cells = 8;             // additional cells at the ends of a grid
constexpr std::size_t sampled_segments = 256;  // size of the sample whose cells estimate the number of all cells
// A segment of so many cells is too long to sample; with so few cells in all the density does not matter.
constexpr double long_segment = 1000, few_curved = 4096;
// Largest margin below the limits, and least and largest ratio of the margin to the error of the cells' model.
constexpr double usual_margin = 1e-5, least_share = 100, most_share = 1000;

/// Returns the approximate turn of a curved segment, rad. Through kinematics it is the change of the scaled q′ of the
/// axes.
template <int N>
double turn_of(const LanePath<N>& path, std::size_t index) {
  const Segment& segment = path[index];
  if (path.cartesian() && segment.curve().kind() == CurveKind::arc)
    return norm(segment.at_parameter(segment.curve().begin()).d2) * segment.length();
  const auto sum_of_changes = [&](auto&& direction, auto&& change) {
    const std::vector<double> panel = segment.panel_parameters();
    double turn = 0;
    auto before = direction(panel[0]);
    for (std::size_t k = 1; k < panel.size(); ++k) {
      const auto after = direction(panel[k]);
      turn += change(before, after);
      before = after;
    }
    return turn;
  };
  if (path.cartesian()) return sum_of_changes([&](double u) { return segment.at_parameter(u).d1; }, angle_between);
  return sum_of_changes([&](double u) { return path.at(index, u).d1; },
                        [](const Lanes<N>& a, const Lanes<N>& b) { return std::sqrt(sum((a - b) * (a - b))); });
}

template <int N>
CurvedParts curved_parts(const LanePath<N>& path, std::size_t segment) {
  return path.linear(segment) ? CurvedParts{} : CurvedParts{1, turn_of(path, segment)};
}

/// Returns the cells per counted cell of some of the segments: 1, more where curvature changes fast.
template <int N>
double cell_density(const LanePath<N>& path, const Machine& lanes, const std::vector<double>& feeds,
                    const AccelerationLimitedOptions& options, const std::vector<CurvedParts>& segments,
                    ProgressScope& progress) {
  Grid<N> grid;
  double cells = 0, all = 0;
  const std::size_t n = path.size(), looks = std::min(n / 8, sampled_segments);
  for (std::size_t k = 0; k < looks; ++k) {
    const std::size_t i = k * n / looks;
    const double count = segments[i].count(options.grid.angle);
    if (!(count > 0 && count < long_segment)) continue;
    grid.build(path, i, i + 1, {lanes, feeds}, options.grid, progress);
    cells += std::max(1.0, static_cast<double>(grid.cells.size()) - graded_cells);
    all += count;
  }
  return all > 0 ? std::max(1.0, cells / all) : 1.0;
}

/// Returns the options with cells that are `wider` by this factor.
AccelerationLimitedOptions widened(AccelerationLimitedOptions options, double wider) {
  options.grid.angle *= wider;
  options.grid.hermite *= wider * wider * wider * wider;  // the error falls with the fourth power of a cell's width
  options.tolerance *= wider * wider;
  if (wider > wide) {
    options.max_divisions = wider > very_wide ? divisions_of_very_wide : divisions_of_wide;
    options.max_rounds = std::max(options.max_rounds, rounds_of_wide);
    options.excess = std::max(options.excess, excess_of_wide);
  }
  return options;
}

}  // namespace

double CellBudget::cells(std::size_t i) const { return std::max(1.0, density * segments[i].count(options.grid.angle)); }

double CellBudget::cells() const {
  return static_cast<double>(segments.size()) + density * all.count(options.grid.angle);
}

template <int N>
CellBudget cell_budget(const LanePath<N>& path, const Machine& lanes, const std::vector<double>& feeds,
                       const AccelerationLimitedOptions& options, ProgressScope& progress) {
  CellBudget budget;
  CurvedParts& all = budget.all;
  budget.segments.resize(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i % 4096 == 4095) progress.report();
    const CurvedParts& parts = budget.segments[i] = curved_parts(path, i);
    all.curved += parts.curved, all.turn += parts.turn;
  }
  if (all.turn > max_turn)
    throw InvalidInput(
        {{{"contour"},
          "the contour turns by " + std::to_string(static_cast<long>(all.turn)) + " rad in all, more than the " +
              std::to_string(static_cast<long>(max_turn)) + " that fit into memory"}});
  const double count = all.count(options.grid.angle);
  if (count > few_curved) budget.density = cell_density(path, lanes, feeds, options, budget.segments, progress);
  const double wider = std::clamp(std::max(options.width, budget.density * count / options.usual_cells), 1.0, widest);
  budget.options = widened(options, wider);
  const double error = budget.options.grid.hermite;
  if (wider > 1) budget.model_error = std::clamp(usual_margin, least_share * error, most_share * error);
  return budget;
}

template CellBudget cell_budget<2>(const LanePath<2>&, const Machine&, const std::vector<double>&,
                                   const AccelerationLimitedOptions&, ProgressScope&);
template CellBudget cell_budget<3>(const LanePath<3>&, const Machine&, const std::vector<double>&,
                                   const AccelerationLimitedOptions&, ProgressScope&);
template CellBudget cell_budget<5>(const LanePath<5>&, const Machine&, const std::vector<double>&,
                                   const AccelerationLimitedOptions&, ProgressScope&);
template CellBudget cell_budget<8>(const LanePath<8>&, const Machine&, const std::vector<double>&,
                                   const AccelerationLimitedOptions&, ProgressScope&);

}  // namespace bahnwerk
