#include "core/verify/bound/lower_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/verify/bound/bound_grid.hpp"
#include "core/verify/bound/jerk_bound.hpp"
#include "core/verify/bound/rest_to_rest.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace {

using verify::BoundGrid;
using verify::rest_to_rest;

constexpr double negligible_direction = 1e-24;  // q'_k² below this says nothing about b
// Enough when a refinement changes the bound by less than this (the next one brings about a sixteenth of it) and when
// little time is left in cells that no single condition explains: a long cell may have to be cut several times before
// anything shows.
constexpr double converged = 3e-7, clear = 1e-3;
constexpr int min_rounds = 2, max_rounds = 8;
// Longer sections are cut here for the sake of memory; what speed a motion has at a cut is left open.
constexpr std::size_t longest_stretch = 200'000;  // segments

double sq(double x) { return x * x; }

// Shortest time over a way, mm, from speed² ≤ e0 to speed² ≤ e1: accelerate, cruise, brake.
double travel_time(double e0, double e1, double way, double acceleration, double velocity) {
  if (!(way > 0)) return 0;
  const double energy = acceleration * way, up = std::max(0.0, (e1 - e0) / 2 + energy),
               down = std::max(0.0, (e0 - e1) / 2 + energy);
  const double v0 = std::sqrt(e0), v1 = std::sqrt(e1), top = std::sqrt(std::max(e0 + up, e1 + down));
  if (top <= velocity) return (up / (top + v0) + down / (top + v1)) / acceleration;
  const double start = std::min(v0, velocity), end = std::min(v1, velocity);
  const double ramps = (sq(velocity) - sq(start) + sq(velocity) - sq(end)) / (2 * acceleration);
  return (velocity - start + velocity - end) / acceleration + std::max(0.0, way - ramps) / velocity;
}

template <int N>
class Solver {
  using BoundNode = verify::BoundNode<N>;
  using BoundCell = verify::BoundCell<N>;

 public:
  Solver(const BoundGrid<N>& grid, ProgressScope& pulse) : grid_(grid), pulse_(pulse) {}

  // Largest b at every node under all conditions, then the time it leaves. O(n).
  double solve() {
    const auto& nodes = grid_.nodes();
    const auto& cells = grid_.cells();
    const std::size_t n = nodes.size();
    b_.resize(n), active_.assign(cells.size(), 0), time_.resize(cells.size());
    b_[0] = nodes[0].cap;
    for (std::size_t i = 0; i + 1 < n; ++i) {
      b_[i + 1] = std::min(nodes[i + 1].cap, across(cells[i], nodes[i], nodes[i + 1], b_[i]));
      if (i % 64 == 0) pulse_.work(8);
    }
    for (std::size_t i = n - 1; i > 0; --i) {
      b_[i - 1] = std::min(b_[i - 1], across(cells[i - 1], nodes[i], nodes[i - 1], b_[i]));
      if (i % 64 == 0) pulse_.work(8);
    }
    double sum = 0, lost = 0;  // Kahan, Commun. ACM 8 (1965): the sum must not lose what a cell gives
    for (std::size_t i = 0; i + 1 < n; ++i) {
      time_[i] = cell_time(i);
      const double term = time_[i] - lost, next = sum + term;
      lost = (next - sum) - term;
      sum = next;
      if (i % 64 == 0) pulse_.work(64);
    }
    return sum;
  }

  struct Doubt {
    std::size_t cells = 0;  // in which the binding condition may change
    double time = 0;        // spent in those that no single condition explains
  };
  /// Of the last solution, per node.
  const std::vector<double>& b() const { return b_; }

  // Marks the cells without a condition that binds all through and the neighbours of a change.
  Doubt mark_switching(double total, std::vector<unsigned char>& marked) const {
    const auto& cells = grid_.cells();
    marked.assign(cells.size(), 0);
    auto changes = [&](std::size_t i, std::size_t j) {
      return cells[j].kind == BoundCell::Kind::curved && active_[i] != active_[j];
    };
    Doubt doubt;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i % 64 == 0) pulse_.work(64);
      if (!cells[i].divisible || time_[i] < 1e-10 * total) continue;
      const bool mixed = active_[i] == 0 || disputed(i);
      if (mixed) doubt.time += time_[i];
      marked[i] = mixed || (i > 0 && changes(i, i - 1)) || (i + 1 < cells.size() && changes(i, i + 1));
      doubt.cells += marked[i];
    }
    return doubt;
  }

 private:
  // The condition that binds between both ends asks of another axis more than it can give at one of them.
  bool disputed(std::size_t i) const {
    const std::size_t kind = active_[i] < 2 ? 2 : (active_[i] - 2u) % 3,
                      axis = active_[i] < 2 ? 0 : (active_[i] - 2u) / 3;
    for (const std::size_t j : {i, i + 1}) {
      const BoundNode& n = grid_.nodes()[j];
      double a = 0;
      if (active_[i] >= 2) {
        if (std::abs(n.tangent[axis]) < 1e-6) continue;
        const double own = kind == 2                              ? 0
                           : (kind == 0) == (n.tangent[axis] > 0) ? grid_.acceleration(axis)
                                                                  : -grid_.acceleration(axis);
        a = (own - n.curvature[axis] * b_[j]) / n.tangent[axis];
      }
      for (std::size_t k = 0; k < grid_.axes(); ++k)
        if (std::abs(n.curvature[k] * b_[j] + n.tangent[k] * a) > grid_.acceleration(k) * 1.0001) return true;
    }
    return false;
  }

  // What a cell lets through from a node with speed² b to the other one: q b' ≤ p b + energy for every axis.
  double across(const BoundCell& cell, const BoundNode& from, const BoundNode& to, double b) const {
    if (cell.kind == BoundCell::Kind::joint) return b + cell.slip;
    double most = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < grid_.axes(); ++k) {
      const double q = to.least(k);
      if (q > negligible_direction) most = std::min(most, (from.most(k) * b + cell.energy[k]) / q);
    }
    return most;
  }

  double cell_time(std::size_t i) {
    const BoundCell& cell = grid_.cells()[i];
    if (cell.kind == BoundCell::Kind::joint) return 0;
    const BoundNode &from = grid_.nodes()[i], &to = grid_.nodes()[i + 1];
    const double feed = grid_.feed(from.segment);
    if (cell.kind == BoundCell::Kind::straight) {  // all axes share one law: limits add up to limits of the path
      double acceleration = std::numeric_limits<double>::infinity(), velocity = feed;
      for (std::size_t k = 0; k < grid_.axes(); ++k) {
        const double t = std::abs(from.tangent[k]);
        if (!(t > 1e-12)) continue;
        acceleration = std::min(acceleration, grid_.acceleration(k) / t);
        velocity = std::min(velocity, grid_.velocity(k) / t);
      }
      return travel_time(b_[i], b_[i + 1], cell.length, acceleration, velocity);
    }
    double longest = cell.length / feed;
    // 0 none, else which condition binds from end to end: feed, axis accelerates, brakes, runs at its velocity.
    const double full = 1 - 1e-7;
    if (b_[i] >= sq(feed) * full && b_[i + 1] >= sq(feed) * full) active_[i] = 1;
    for (std::size_t k = 0; k < grid_.axes(); ++k) {
      const double e0 = from.most(k) * b_[i], e1 = to.most(k) * b_[i + 1], change = e1 - e0;
      const double v2 = sq(grid_.velocity(k)) * full;
      longest = std::max(longest, travel_time(e0, e1, cell.way[k], grid_.acceleration(k), cell.velocity[k]));
      if (std::max(sq(from.tangent[k]), sq(to.tangent[k])) < negligible_direction) continue;
      if (change >= cell.energy[k] * full) active_[i] = static_cast<unsigned char>(2 + 3 * k);
      if (-change >= cell.energy[k] * full) active_[i] = static_cast<unsigned char>(3 + 3 * k);
      if (e0 >= v2 && e1 >= v2) active_[i] = static_cast<unsigned char>(4 + 3 * k);
    }
    return longest;
  }

  const BoundGrid<N>& grid_;
  ProgressScope& pulse_;
  std::vector<double> b_, time_;
  std::vector<unsigned char> active_;
};

// Between two rests everything is independent of the rest of the path.
template <int N>
double section_duration(BoundGrid<N>& grid, Solver<N>& solver, std::vector<unsigned char>& marked) {
  const std::size_t max_nodes = 4 * grid.nodes().size() + 1000;
  double duration = 0;
  for (int round = 0;; ++round) {
    const double before = duration;
    duration = solver.solve();
    if (round >= max_rounds || grid.nodes().size() > max_nodes) break;
    const auto doubt = solver.mark_switching(duration, marked);
    if (doubt.cells == 0) break;
    if (round >= min_rounds && duration - before <= converged * duration && doubt.time <= clear * duration) break;
    grid.refine(marked);
  }
  return duration * (1 - 1e-12 - 4e-16 * static_cast<double>(grid.nodes().size()));
}

template <int N>
Bound bound_of(const PathTask& task, double corner_angle, Progress& progress, double progress_from,
               double progress_to) {
  const AxisPath& path = task.path;
  ProgressScope pulse(progress, "bound", progress_from, progress_to);
  pulse.report();
  const std::vector<Joint> list = joints(path.tool(), [&] { pulse.report(); });
  BoundGrid<N> grid(path, task.machine, task.feeds, corner_angle, pulse);
  Solver<N> solver(grid, pulse);
  verify::JerkBound<N> jerk(grid, task.machine, pulse);
  std::vector<unsigned char> marked;
  double duration = 0;
  std::size_t nodes = 0;
  for (std::size_t first = 0, last = 1; first < path.size(); first = last++) {
    while (last < path.size() && !task.rests[last] && list[last - 1].angle <= corner_angle &&
           !path[last - 1].cusp_end() && !path[last].cusp_begin())
      ++last;
    double section = 0;
    for (std::size_t begin = first, end = 0; begin < last; begin = end) {
      end = std::min(begin + longest_stretch, last);
      grid.build(begin, end, begin == first, end == last);
      pulse.done(static_cast<double>(begin + end) / 2 / static_cast<double>(path.size()));
      double stretch = section_duration(grid, solver, marked);
      if (jerk.limited() && !(last == first + 1 && path.linear(first)))
        stretch = std::max(stretch, jerk.duration(solver.b(), stretch, begin == first, end == last));
      section += stretch;
      nodes += grid.nodes().size();
    }
    if (last == first + 1 && path.linear(first))
      section = std::max(section, rest_to_rest(path, first, grid.feed(first), task.machine) * (1 - 1e-12));
    duration += section;
    pulse.done(static_cast<double>(last) / static_cast<double>(path.size()));
  }
  std::string basis = "axis energies between " + std::to_string(nodes) + " nodes of the path";
  if (jerk.limited()) basis += ", jerk by duality over " + std::to_string(jerk.cells()) + " cells";
  return {duration, 0, basis};
}

}  // namespace

Bound lower_bound(const PathTask& task, double corner_angle, Progress& progress, double progress_from,
                  double progress_to) {
  const std::size_t axes = task.path.axes();
  if (task.path.size() == 0) return {0, 0, "empty contour"};
  Bound bound = axes <= 2   ? bound_of<2>(task, corner_angle, progress, progress_from, progress_to)
                : axes == 3 ? bound_of<3>(task, corner_angle, progress, progress_from, progress_to)
                            : bound_of<max_axes>(task, corner_angle, progress, progress_from, progress_to);
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
