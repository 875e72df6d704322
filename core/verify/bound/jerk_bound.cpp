#include "core/verify/bound/jerk_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace bahnwerk::verify {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// A cell of the relaxation takes this part of the time in which jerk brings an axis to its full acceleration, and
// turns by no more than this, rad; a piece half of it. Next to rest a piece is this part of its distance from there.
constexpr double part_of_ramp = 0.3, widest_turn = 0.05, part_of_distance = 0.1, part_of_onset = 0.002,
                 part_of_section = 1e-4, part_of_cycle = 0.25;
constexpr double widest_swing = 0.1;      // of q″ b within a cell, of the axis' acceleration
constexpr std::size_t stretch = 100'000;  // cells, beyond which the path is cut
constexpr double pieces_per_node = 0.5, more_pieces = 400;
constexpr double min_cells = 60;  // of a section
constexpr double at_feed = 0.999, cruising = 4;
constexpr double no_ramp = 4;  // cells that take longer than so many ramps show nothing of jerk

double sq(double x) { return x * x; }

}  // namespace

template <int N>
JerkBound<N>::JerkBound(const BoundGrid<N>& grid, const Machine& machine, ProgressScope& pulse)
    : grid_(grid), pulse_(pulse), cycle_time_(machine.cycle_time), dual_(grid, pulse) {
  problem_.acceleration.fill(1), problem_.jerk.fill(infinite);
  for (std::size_t k = 0; k < grid.axes(); ++k) {
    problem_.acceleration[k] = grid.acceleration(k);
    problem_.jerk[k] = grid.jerk(k);
    if (!std::isfinite(grid.jerk(k))) continue;
    limited_ = true;
    if (const double ramp = grid.acceleration(k) / grid.jerk(k); ramp < ramp_)
      ramp_ = ramp, acceleration_of_ramp_ = grid.acceleration(k);
  }
}

// The largest b between two places within a cell, `part0` and `part1` of its length from its begin.
template <int N>
double JerkBound<N>::cap(std::size_t cell, const Node& a, const Node& b, const std::vector<double>& at_nodes,
                         double part0, double part1) const {
  const Cell& c = grid_.cells()[cell];
  const Node &from = grid_.nodes()[cell], &to = grid_.nodes()[cell + 1];
  double most = std::min(sq(grid_.feed(a.segment)), grid_.jerk_cap(a, b));
  const bool straight = c.kind == Cell::Kind::straight;
  const DirectionRange<N> range = grid_.range(a, b);
  for (std::size_t k = 0; k < grid_.axes(); ++k) {
    const double q2 = sq(std::max(0.0, range.least(k) - a.blur - b.blur));
    if (!(q2 > 1e-24)) continue;
    const double forward = straight ? part1 : 1, backward = straight ? 1 - part0 : 1;
    most = std::min({most, sq(grid_.velocity(k)) / q2, (from.most(k) * at_nodes[cell] + forward * c.energy[k]) / q2,
                     (to.most(k) * at_nodes[cell + 1] + backward * c.energy[k]) / q2});
  }
  return most * (1 + 1e-12);
}

template <int N>
void JerkBound<N>::join(const Node& a, const Node& b, double cap) {
  const double along = grid_.along(a, b, cap);
  joint_.cap = joint_.here ? std::max(joint_.cap, cap) : cap;
  joint_.here = true;
  for (std::size_t k = 0; k < grid_.axes(); ++k) {
    const double kink = b.tangent[k] - a.tangent[k], bend = std::abs(b.curvature[k] - a.curvature[k]);
    const double step = bend * cap + (kink != 0 ? std::abs(kink) * along : 0);
    joint_.kink[k] += kink;
    joint_.step[k] += std::min(problem_.jerk[k] * cycle_time_, step) * (1 + 1e-9);
  }
}

template <int N>
void JerkBound<N>::append(const Node& a, const Node& b, double cap, Extent extent) {
  if (!(b.s > a.s)) return;  // the joint before it stands before the next one
  DualPiece<N> p = dual_piece(grid_, a, b, cap);
  p.joint = std::exchange(joint_, {});
  for (std::size_t k = 0; k < grid_.axes(); ++k)
    extent.swing = std::max(extent.swing, std::abs(b.curvature[k] - a.curvature[k]) * cap / grid_.acceleration(k));
  pieces_.push_back(p);
  extents_.push_back(extent);
}

// The longest piece next to a node: at rest acceleration builds up on a short way, and where an axis has to step by
// more acceleration than one cycle allows the motion slows down within a few cycles.
template <int N>
double JerkBound<N>::finest_at(std::size_t node, const std::vector<double>& b) const {
  const Node &from = grid_.nodes()[node], &to = grid_.nodes()[node + 1];
  double finest = infinite;
  const double most = std::min(b[node], b[node + 1]);
  for (std::size_t k = 0; k < grid_.axes(); ++k) {
    const double bend = std::abs(to.curvature[k] - from.curvature[k]), step = grid_.jerk(k) * cycle_time_;
    if (bend * most > step) finest = std::min(finest, part_of_cycle * cycle_time_ * std::sqrt(step / bend));
  }
  return finest;
}

template <int N>
void JerkBound<N>::grade(const std::vector<double>& b, bool rest_first, bool rest_last) {
  const auto& cells = grid_.cells();
  const std::size_t n = b.size() - 1;
  before_.assign(n + 1, infinite), behind_.assign(n + 1, infinite);
  if (rest_first) before_[0] = first_piece_;
  if (rest_last) behind_[n] = first_piece_;
  for (std::size_t i = 0; i < n; ++i) {
    before_[i + 1] = before_[i] + part_of_distance * cells[i].length;
    if (cells[i].kind == Cell::Kind::joint) before_[i + 1] = std::min(before_[i + 1], behind_[i] = finest_at(i, b));
    pulse_.work(1);
  }
  for (std::size_t i = n; i-- > 0;)
    behind_[i] = std::min(behind_[i], behind_[i + 1] + part_of_distance * cells[i].length);
}

// Pieces of a cell: evenly in time, finer and finer towards rests and steps.
template <int N>
void JerkBound<N>::divide(std::size_t cell, const std::vector<double>& b) {
  const Cell& c = grid_.cells()[cell];
  const Node &from = grid_.nodes()[cell], &to = grid_.nodes()[cell + 1];
  const bool straight = c.kind == Cell::Kind::straight;
  double energy = infinite;  // what b may gain over the cell
  for (std::size_t k = 0; k < grid_.axes(); ++k)
    if (const double least = std::min(from.least(k), to.least(k)); least > 1e-12)
      energy = std::min(energy, c.energy[k] / least);
  const double whole = cap(cell, from, to, b, 0, 1);
  // At the feed all along nothing happens but what the path does.
  const double feed2 = sq(grid_.feed(from.segment));
  const double spacing = std::min(b[cell], b[cell + 1]) > at_feed * feed2 ? cruising * spacing_ : spacing_;
  double x = 0;
  Node last = from;
  while (x < c.length) {
    const double left = c.length - x;
    const double speed2 =
        std::min({whole, b[cell] + energy * (x / c.length), b[cell + 1] + energy * (left / c.length)});
    double d = 0.5 * spacing * std::sqrt(std::max(speed2, 0.0));
    d = std::min({d, before_[cell] + part_of_distance * x,
                  (behind_[cell + 1] + part_of_distance * left) / (1 + part_of_distance)});
    d = std::max(d, c.length * 1e-4);
    pulse_.work(2);
    const double u = from.u + (to.u - from.u) * ((x + d) / c.length);
    if (x + 1.5 * d >= c.length || !(u > last.u && u < to.u)) break;
    const Node next = grid_.node(from.segment, u);
    append(last, next,
           cap(cell, last, next, b, straight ? x / c.length : 0, straight ? (next.s - from.s) / c.length : 1),
           {0, 2 * d, spacing});
    last = next;
    x = next.s - from.s;
  }
  append(last, to, cap(cell, last, to, b, straight ? x / c.length : 0, 1),
         {0, 2 * std::min(before_[cell + 1], behind_[cell + 1]), spacing});
}

template <int N>
void JerkBound<N>::lay(const std::vector<double>& b, bool rest_first, bool rest_last) {
  const auto& nodes = grid_.nodes();
  const auto& cells = grid_.cells();
  pieces_.clear(), extents_.clear();
  joint_ = {};
  grade(b, rest_first, rest_last);
  for (std::size_t i = 0; i + 1 < b.size(); ++i) {
    pulse_.work(8);
    if (cells[i].kind == Cell::Kind::joint)
      join(nodes[i], nodes[i + 1], std::min(b[i], b[i + 1]));
    else
      divide(i, b);
  }
}

template <int N>
std::size_t JerkBound<N>::pose(std::size_t first, bool rest_first, bool rest_last, bool& ends_at_rest) {
  problem_.cells.clear(), problem_.steps.clear(), cell_of_.clear();
  problem_.rest_first = rest_first && first == 0;
  double time = 0, turn = 0, capped = 0, swing = 0;
  std::size_t i = first;
  const auto known = [](const DualPiece<N>& p) {
    return std::isfinite(p.cap) &&
           std::all_of(p.third.begin(), p.third.end(), [](double t) { return std::isfinite(t); });
  };
  for (; i < pieces_.size() && problem_.cells.size() < stretch && known(pieces_[i]); ++i) {
    const DualPiece<N>& p = pieces_[i];
    double bend = 0;
    for (std::size_t k = 0; k < N; ++k) bend += sq(p.end[k] - p.begin[k]);
    bend = std::sqrt(bend);
    const bool open = !problem_.cells.empty() && time + p.time < extents_[i].spacing && turn + bend < widest_turn &&
                      swing + extents_[i].swing < widest_swing &&
                      problem_.cells.back().length + p.length < extents_[i].finest;
    if (!open) problem_.cells.emplace_back(), time = turn = capped = swing = 0, problem_.cells.back().begin = p.begin;
    RelaxationCell<N>& cell = problem_.cells.back();
    if (p.joint.here) {
      RelaxationStep<N> step{problem_.cells.size() - 1, cell.length, {}};
      for (std::size_t k = 0; k < N; ++k)
        step.time[k] = p.joint.step[k] / problem_.jerk[k], step.kink[k] = p.joint.kink[k];
      problem_.steps.push_back(step);
    }
    for (std::size_t k = 0; k < N; ++k) cell.way[k] += p.way[k];
    cell.end = p.end;
    cell.length += p.length;
    capped += p.cap * p.length, cell.cap = capped / cell.length;
    time += p.time, turn += bend, swing += extents_[i].swing;
    cell_of_.push_back(problem_.cells.size() - 1);
  }
  ends_at_rest = i == pieces_.size() && rest_last;
  problem_.rest_last = ends_at_rest;
  return i;
}

template <int N>
double JerkBound<N>::duration(const std::vector<double>& b, double time, bool rest_first, bool rest_last) {
  const double length = grid_.nodes()[b.size() - 1].s - grid_.nodes().front().s;
  spacing_ = std::max(std::min(part_of_ramp * ramp_, time / min_cells),
                      time / (pieces_per_node * static_cast<double>(b.size()) + more_pieces));
  first_piece_ = std::min(part_of_onset * acceleration_of_ramp_ * sq(ramp_) / 6, part_of_section * length);
  double total = 0;
  if (spacing_ < no_ramp * ramp_) {
    lay(b, rest_first, rest_last);
    for (std::size_t first = 0; first < pieces_.size();) {
      bool ends_at_rest = false;
      const std::size_t last = pose(first, rest_first, rest_last, ends_at_rest);
      if (last == first) {  // next to a cusp nothing is known of jerk
        total += pieces_[first].length / std::sqrt(pieces_[first].cap);
        ++first;
        continue;
      }
      cells_ += problem_.cells.size();
      total += dual_.value(pieces_, first, last, cell_of_, problem_, solver_.solve(problem_, {}, pulse_));
      first = last;
    }
  }
  return total * (1 - 1e-12);
}

template class JerkBound<2>;
template class JerkBound<3>;
template class JerkBound<8>;

}  // namespace bahnwerk::verify
