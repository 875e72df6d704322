#include "core/verify/bound/lower_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/numeric/windows.hpp"
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

constexpr int max_rounds = 8;
// Longer sections are solved in windows to limit memory, with this many nodes of a first grid and a part more behind
// them: b at the beginning of a window is that at the end of the one before, and its end is open. This many segments
// estimate the number of nodes, if one window has at least as many.
struct Windows {
  std::size_t segments, sampled;
  double nodes;
};
// Through kinematics a window fits the processor's cache, or nearly so, for what limits of jerk lose at its ends.
constexpr Windows cartesian_windows{4096, 128, 100'000}, kinematic_windows{256, 32, 60'000};
// Straight segments have few nodes and may be driven fast: braking shows further there.
constexpr double few_nodes = 4;  // expected nodes per segment that count as few
constexpr std::size_t part_behind = 16, part_behind_few = 4;
// A first grid of more nodes has wider cells, and is refined less.
constexpr double usual_nodes = 250'000, widest = 8, coarse = 2, most_left = 1e-3;
// Where jerk dominates, the bound without it only limits the speed and may be less accurate: cells are wider, and
// through kinematics they are refined less. Jerk does not dominate if it increases the bound by no more than this.
constexpr double wider_with_jerk = 2, kinematic_with_jerk = 8, cartesian_rules = 1e-4, kinematic_rules = 0.01;

/// Effort of refinement. It ends when a refinement changes the bound by less than `converged` (the next one brings
/// about a sixteenth of it) and when little time, `clear`, remains in cells that no single condition explains: a long
/// cell may have to be divided several times before an effect is visible.
struct Effort {
  double converged = 3e-7, clear = 1e-3;
  int min_rounds = 2, valley_rounds = 4;
};

Effort effort(double wider) {
  Effort effort;
  const double square = wider * wider;
  effort.converged = std::min(effort.converged * square * square * square, most_left);
  effort.clear = std::min(effort.clear * square * square, 1.0);
  if (wider > coarse) effort.min_rounds = effort.valley_rounds = 1;
  return effort;
}

// Between two rests everything is independent of the rest of the path.
template <int N>
void solve(BoundGrid<N>& grid, BoundSolver<N>& solver, std::vector<unsigned char>& marked, const Effort& effort) {
  solver.solve();
  for (int round = 0; round < effort.valley_rounds && solver.mark_valleys(marked) > 0; ++round) {
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
    if (round >= effort.min_rounds && duration - before <= effort.converged * duration &&
        doubt.time <= effort.clear * duration)
      break;
    grid.refine(marked);
  }
}

// Estimates the nodes of a first grid per segment. Samples at equal distances might all be lines of a path that repeats
// a pattern; multiples of the golden ratio are not.
template <int N>
double expected_nodes(BoundGrid<N>& grid, std::size_t segments, const Windows& windows) {
  if (segments < windows.segments) return 1;
  double nodes = 0;
  for (std::size_t k = 0; k < windows.sampled; ++k) {
    const double place = std::fmod(static_cast<double>(k) * std::numbers::phi, 1.0);
    const auto i = static_cast<std::size_t>(place * static_cast<double>(segments));
    grid.build(i, i + 1);
    nodes += static_cast<double>(grid.nodes().size());
  }
  return nodes / static_cast<double>(windows.sampled);
}

template <int N>
Bound bound_of(const PathTask& task, double corner_angle, Progress progress, std::vector<SectionBound>* sections) {
  const AxisPath& path = task.path;
  ProgressScope stage_progress(progress, "bound");
  stage_progress.report();
  const std::vector<Joint> list = joints(path.tool(), &stage_progress);
  BoundGrid<N> grid(path, task.machine, task.feeds, corner_angle, stage_progress);
  BoundSolver<N> solver(grid, stage_progress);
  verify::JerkBound<N> jerk(grid, task.machine, stage_progress);
  verify::RepeatedSections repeated(path, task.machine, task.feeds, stage_progress);
  std::vector<unsigned char> marked;
  const Windows& windows = path.cartesian() ? cartesian_windows : kinematic_windows;
  const double expected = expected_nodes(grid, path.size(), windows);
  const double wider = std::clamp(expected * static_cast<double>(path.size()) / usual_nodes, 1.0, widest);
  struct Grade {
    double wider;
    Effort effort;
  };
  const Grade least{wider, effort(wider)};
  Grade rough = least;  // cells of sections where jerk may rule
  if (jerk.limited()) {
    rough.wider = std::max(wider, wider_with_jerk);
    rough.effort = effort(path.cartesian() ? rough.wider : std::max(wider, kinematic_with_jerk));
  }
  const double rules = path.cartesian() ? cartesian_rules : kinematic_rules;
  const std::size_t window = std::max(windows.segments, static_cast<std::size_t>(windows.nodes / expected)),
                    behind = window / (expected < few_nodes ? part_behind_few : part_behind);
  const WindowLengths lengths{window, behind, window + (path.cartesian() ? behind : window / 2)};
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
      stage_progress.work(2);
    } else if (const auto known = repeated.find(first, last)) {
      duration += known->duration;
      nodes += known->nodes, cells += known->cells;
      stage_progress.work(last - first);
    } else {
      struct Place {
        std::size_t begin;  // segment
        double entry = 0;   // v² there
      };
      double section = 0;
      const std::size_t nodes_before = nodes, cells_before = jerk.cells();
      solve_windows(Place{first}, last, [&](const Place& here, auto*) {
        const Window segments = lengths.at(here.begin, last);
        const bool begins = here.begin == first, ends = segments.keep == last;
        stage_progress.done(static_cast<double>(here.begin + segments.keep) / 2 / static_cast<double>(path.size()));
        std::size_t kept = 0;
        const auto part_without_jerk = [&](const Grade& grade, bool rebuild) {
          if (rebuild) {
            grid.widen(grade.wider);
            grid.build(here.begin, segments.end, begins, ends);
            if (!begins) grid.enter(here.entry);
          }
          solve(grid, solver, marked, grade.effort);
          kept = ends ? grid.order().size() - 1 : grid.cells_before(segments.keep);
          return solver.duration(kept) * (1 - 1e-12 - 4e-16 * static_cast<double>(kept));
        };
        double part = part_without_jerk(rough, true);
        if (jerk.limited()) {
          const double with = jerk.duration(solver.speed_squares(kept + 1), part, begins, ends);
          const bool rebuild = rough.wider > least.wider;
          if (with < (1 + rules) * part && (rebuild || !path.cartesian())) part = part_without_jerk(least, rebuild);
          part = std::max(part, with);
        }
        section += part;
        nodes += kept + 1;
        return Place{segments.keep, solver.speed_square(grid.order()[kept]) * (1 + 1e-12)};
      });
      duration += section;
      cells += jerk.cells() - cells_before;
      repeated.add({first, last, section, nodes - nodes_before, jerk.cells() - cells_before});
    }
    if (sections) sections->push_back({first, last, duration - before});
    stage_progress.done(static_cast<double>(last) / static_cast<double>(path.size()));
  }
  std::string basis = "axis energies between " + std::to_string(nodes) + " nodes of the path";
  if (jerk.limited()) basis += ", jerk by duality over " + std::to_string(cells) + " cells";
  return {duration, 0, basis};
}

}  // namespace

Bound lower_bound(const PathTask& task, double corner_angle, Progress progress, std::vector<SectionBound>* sections) {
  const std::size_t axes = task.path.axes();
  if (task.path.size() == 0) return {0, 0, "empty contour"};
  Bound bound = axes <= 2   ? bound_of<2>(task, corner_angle, progress, sections)
                : axes == 3 ? bound_of<3>(task, corner_angle, progress, sections)
                : axes <= 5 ? bound_of<5>(task, corner_angle, progress, sections)
                            : bound_of<max_axes>(task, corner_angle, progress, sections);
  // The planned motion sums up its dwells one by one, with rounding.
  bound.value += task.dwell() * (1 - 1e-12 - 4e-16 * static_cast<double>(task.dwells.size()));
  return bound;
}

Bound lower_bound(const Contour& contour, const Machine& machine, double corner_angle, Progress progress) {
  const CartesianAxisPath path(contour.path, machine.dimension());
  return lower_bound(contour_task(path, contour, machine), corner_angle, progress);
}

Check bound_check(const Bound& bound, double planned) {
  return verify::make_check({{"bound", CheckGroup::bound}, 0, "s"}, planned, {bound.value, 0});
}

}  // namespace bahnwerk
