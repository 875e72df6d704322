#include "core/verify/bound/lower_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/verify/bound/bound_grid.hpp"
#include "core/verify/bound/bound_solver.hpp"
#include "core/verify/bound/jerk_bound.hpp"
#include "core/verify/bound/repeated_section.hpp"
#include "core/verify/bound/rest_to_rest.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace {

using verify::BoundGrid;
using verify::BoundSolver;
using verify::rest_to_rest;

// Enough when a refinement changes the bound by less than this (the next one brings about a sixteenth of it) and when
// little time is left in cells that no single condition explains: a long cell may have to be cut several times before
// anything shows.
constexpr double converged = 3e-7, clear = 1e-3;
constexpr int min_rounds = 2, max_rounds = 8, valley_rounds = 4;
// Longer sections are cut here for the sake of memory; what speed a motion has at a cut is left open.
constexpr std::size_t longest_stretch = 200'000;  // segments

// Between two rests everything is independent of the rest of the path.
template <int N>
double section_duration(BoundGrid<N>& grid, BoundSolver<N>& solver, std::vector<unsigned char>& marked) {
  solver.solve();
  for (int round = 0; round < valley_rounds && solver.mark_valleys(marked) > 0; ++round) {
    grid.refine(marked);
    solver.solve_changes();
  }
  const std::size_t max_nodes = 4 * grid.nodes().size() + 1000;
  double duration = 0;
  for (int round = 0;; ++round) {
    const double before = duration;
    if (round > 0) solver.solve_changes();
    duration = solver.duration();
    if (round >= max_rounds || grid.nodes().size() > max_nodes) break;
    const auto doubt = solver.mark_switching(duration, marked);
    if (doubt.cells == 0) break;
    if (round >= min_rounds && duration - before <= converged * duration && doubt.time <= clear * duration) break;
    grid.refine(marked);
  }
  return duration * (1 - 1e-12 - 4e-16 * static_cast<double>(grid.nodes().size()));
}

template <int N>
Bound bound_of(const PathTask& task, double corner_angle, Progress& progress, double progress_from, double progress_to,
               std::vector<SectionBound>* sections) {
  const AxisPath& path = task.path;
  ProgressScope pulse(progress, "bound", progress_from, progress_to);
  pulse.report();
  const std::vector<Joint> list = joints(path.tool(), &pulse);
  BoundGrid<N> grid(path, task.machine, task.feeds, corner_angle, pulse);
  BoundSolver<N> solver(grid, pulse);
  verify::JerkBound<N> jerk(grid, task.machine, pulse);
  verify::RepeatedSections repeated(path, task.machine, task.feeds, pulse);
  std::vector<unsigned char> marked;
  double duration = 0;
  std::size_t nodes = 0, cells = 0;
  for (std::size_t first = 0, last = 1; first < path.size(); first = last++) {
    while (last < path.size() && !task.rests[last] && list[last - 1].angle <= corner_angle &&
           !path[last - 1].cusp_end() && !path[last].cusp_begin())
      ++last;
    const double before = duration;
    if (last == first + 1 && path.linear(first)) {
      duration += rest_to_rest(path, first, grid.feed(first), task.machine) * (1 - 1e-12);
      nodes += 2;
      pulse.work(2);
    } else if (const auto known = repeated.find(first, last)) {
      duration += known->duration;
      nodes += known->nodes, cells += known->cells;
      pulse.work(last - first);
    } else {
      double section = 0;
      const std::size_t nodes_before = nodes, cells_before = jerk.cells();
      for (std::size_t begin = first, end = 0; begin < last; begin = end) {
        end = std::min(begin + longest_stretch, last);
        grid.build(begin, end, begin == first, end == last);
        pulse.done(static_cast<double>(begin + end) / 2 / static_cast<double>(path.size()));
        double stretch = section_duration(grid, solver, marked);
        if (jerk.limited())
          stretch = std::max(stretch, jerk.duration(solver.speed_squares(), stretch, begin == first, end == last));
        section += stretch;
        nodes += grid.nodes().size();
      }
      duration += section;
      cells += jerk.cells() - cells_before;
      repeated.add({first, last, section, nodes - nodes_before, jerk.cells() - cells_before});
    }
    if (sections) sections->push_back({first, last, duration - before});
    pulse.done(static_cast<double>(last) / static_cast<double>(path.size()));
  }
  std::string basis = "axis energies between " + std::to_string(nodes) + " nodes of the path";
  if (jerk.limited()) basis += ", jerk by duality over " + std::to_string(cells) + " cells";
  return {duration, 0, basis};
}

}  // namespace

Bound lower_bound(const PathTask& task, double corner_angle, Progress& progress, double progress_from,
                  double progress_to, std::vector<SectionBound>* sections) {
  const std::size_t axes = task.path.axes();
  if (task.path.size() == 0) return {0, 0, "empty contour"};
  Bound bound = axes <= 2   ? bound_of<2>(task, corner_angle, progress, progress_from, progress_to, sections)
                : axes == 3 ? bound_of<3>(task, corner_angle, progress, progress_from, progress_to, sections)
                            : bound_of<max_axes>(task, corner_angle, progress, progress_from, progress_to, sections);
  // The planned motion sums up its dwells one by one, with rounding.
  bound.duration += task.dwell() * (1 - 1e-12 - 4e-16 * static_cast<double>(task.dwells.size()));
  return bound;
}

Bound lower_bound(const Contour& contour, const Machine& machine, double corner_angle, Progress& progress,
                  double progress_from, double progress_to) {
  const CartesianAxisPath path(contour.path, machine.dimension());
  return lower_bound(contour_task(path, contour, machine), corner_angle, progress, progress_from, progress_to);
}

Bound with_gap(Bound bound, double planned) {
  bound.gap = bound.duration > 0 ? (planned - bound.duration) / bound.duration : 0;
  if (bound.gap < 0 && bound.gap > -1e-14) bound.gap = 0;
  return bound;
}

Check bound_check(const Bound& bound, double planned) {
  return verify::make_check("bound", "s", planned, {bound.duration, 0});
}

}  // namespace bahnwerk
