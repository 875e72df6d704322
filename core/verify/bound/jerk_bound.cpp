#include "core/verify/bound/jerk_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bahnwerk::verify {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double infinite = std::numeric_limits<double>::infinity();
// A cell of the relaxation takes this part of the time in which jerk brings an axis to its full acceleration, and
// turns by no more than this, rad; a piece half of it. Next to rest a piece is this part of its distance from there.
constexpr double part_of_ramp = 0.3, widest_turn = 0.02, part_of_distance = 0.1, part_of_onset = 0.002,
                 part_of_section = 1e-4, part_of_cycle = 0.25;
constexpr double widest_swing = 0.05;   // of q″ b within a cell, of the axis' acceleration
constexpr std::size_t window = 16'000;  // cells of the relaxation at once
constexpr double pieces_per_node = 0.5, more_pieces = 400;
constexpr double min_cells = 60;  // of a section
constexpr double no_ramp = 4;     // cells that take longer than so many ramps show nothing of jerk

double sq(double x) { return x * x; }

/// min over 0 < b ≤ cap of w/√b + G b; w ≥ 0.
double least(double w, double G, double cap) {
  if (G > 0 && w <= 2 * G * cap * std::sqrt(cap)) return 1.5 * std::cbrt(2 * G * w * w);
  return w / std::sqrt(cap) + G * cap;
}

struct Range {
  double low, high, mean;
  double share() const { return high > low ? std::clamp((mean - low) / (high - low), 0.0, 1.0) : 0; }
};

/// A lower bound of the mean of least(w(s), G(s), cap).
double least_mean(const Range& w, const Range& G, double cap) {
  const double p = w.share(), q = G.share();
  const double f00 = least(w.low, G.low, cap), f01 = least(w.low, G.high, cap), f10 = least(w.high, G.low, cap),
               f11 = least(w.high, G.high, cap);
  const auto with = [&](double both) {
    return both * f11 + (p - both) * f10 + (q - both) * f01 + (1 - p - q + both) * f00;
  };
  return std::min(with(std::max(0.0, p + q - 1)), with(std::min(p, q)));
}

}  // namespace

template <int N>
void JerkBound<N>::Sums::add(double x) {  // Kahan, Commun. ACM 8 (1965)
  const double term = x - lost, next = now + term;
  lost = (next - now) - term;
  now = next;
}

template <int N>
JerkBound<N>::JerkBound(const BoundGrid<N>& grid, const Machine& machine, ProgressScope& pulse)
    : grid_(grid), pulse_(pulse), cycle_time_(machine.cycle_time) {
  acceleration_.fill(1), jerk_.fill(infinite);
  for (std::size_t k = 0; k < grid.axes(); ++k) {
    acceleration_[k] = grid.acceleration(k);
    jerk_[k] = grid.jerk(k);
    if (!std::isfinite(jerk_[k])) continue;
    limited_ = true;
    if (const double ramp = acceleration_[k] / jerk_[k]; ramp < ramp_)
      ramp_ = ramp, acceleration_of_ramp_ = acceleration_[k];
  }
}

// The largest b between two places within a cell, `part0` and `part1` of its length from its begin.
template <int N>
double JerkBound<N>::cap(std::size_t cell, const Node& a, const Node& b, const std::vector<double>& at_nodes,
                         double part0, double part1) const {
  const Cell& c = grid_.cells()[cell];
  const Node &from = grid_.nodes()[cell], &to = grid_.nodes()[cell + 1];
  double most = sq(grid_.feed(a.segment));
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
  Piece joint;
  joint.joint = true;
  joint.joint_cap = cap;
  double along = infinite;
  for (const Node* n : {&a, &b})
    for (std::size_t k = 0; k < grid_.axes(); ++k)
      if (n->least(k) > 0)
        along = std::min(along, (acceleration_[k] + std::abs(n->curvature[k]) * cap) / std::sqrt(n->least(k)));
  for (std::size_t k = 0; k < grid_.axes(); ++k) {
    joint.kink[k] = b.tangent[k] - a.tangent[k];
    const double bend = std::abs(b.curvature[k] - a.curvature[k]);
    const double step = bend * cap + (joint.kink[k] != 0 ? std::abs(joint.kink[k]) * along : 0);
    joint.step[k] = std::min(jerk_[k] * cycle_time_, step) * (1 + 1e-9);
  }
  joint_ = joint;
}

template <int N>
void JerkBound<N>::append(const Node& a, const Node& b, double cap, double finest) {
  Piece p = joint_;
  joint_ = {};
  p.length = b.s - a.s;
  if (!(p.length > 0)) return;
  p.cap = cap;
  p.time = p.length / std::sqrt(cap);
  p.rounding = 128 * epsilon * (1 + b.s) / p.length + 64 * epsilon + a.blur + b.blur;
  const Row third = grid_.third(a, b);
  for (std::size_t k = 0; k < grid_.axes(); ++k) {
    p.way[k] = b.position[k] - a.position[k];
    p.begin[k] = a.tangent[k], p.end[k] = b.tangent[k];
    p.bend[k] = std::max(std::abs(a.curvature[k]), std::abs(b.curvature[k]));
    p.third[k] = third[k];
    p.swing = std::max(p.swing, std::abs(b.curvature[k] - a.curvature[k]) * cap / acceleration_[k]);
  }
  p.finest = finest;
  p.along = infinite;
  for (std::size_t k = 0; k < grid_.axes(); ++k) {
    const double bend = p.bend[k] + third[k] * p.length;  // |q″_k| anywhere in it
    const double least = std::min(std::abs(p.begin[k]), std::abs(p.end[k])) - bend * p.length;
    if (least > 1e-3) p.along = std::min(p.along, (acceleration_[k] + bend * cap) / least);
  }
  pieces_.push_back(p);
}

// The longest piece next to a node: at rest acceleration builds up on a short way, and where an axis has to step by
// more acceleration than one cycle allows the motion slows down within a few cycles.
template <int N>
double JerkBound<N>::finest_at(std::size_t node, const std::vector<double>& b) const {
  const Node &from = grid_.nodes()[node], &to = grid_.nodes()[node + 1];
  double finest = infinite;
  const double most = std::min(b[node], b[node + 1]);
  for (std::size_t k = 0; k < grid_.axes(); ++k) {
    const double bend = std::abs(to.curvature[k] - from.curvature[k]), step = jerk_[k] * cycle_time_;
    if (bend * most > step) finest = std::min(finest, part_of_cycle * cycle_time_ * std::sqrt(step / bend));
  }
  return finest;
}

template <int N>
void JerkBound<N>::grade(const std::vector<double>& b, bool rest_first, bool rest_last) {
  const auto& cells = grid_.cells();
  const std::size_t n = cells.size();
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
  double x = 0;
  Node last = from;
  while (x < c.length) {
    const double left = c.length - x;
    const double speed2 =
        std::min({whole, b[cell] + energy * (x / c.length), b[cell + 1] + energy * (left / c.length)});
    double d = 0.5 * spacing_ * std::sqrt(std::max(speed2, 0.0));
    d = std::min({d, before_[cell] + part_of_distance * x,
                  (behind_[cell + 1] + part_of_distance * left) / (1 + part_of_distance)});
    d = std::max(d, c.length * 1e-4);
    pulse_.work(2);
    const double u = from.u + (to.u - from.u) * ((x + d) / c.length);
    if (x + 1.5 * d >= c.length || !(u > last.u && u < to.u)) break;
    const Node next = grid_.at(from.segment, u);
    append(last, next,
           cap(cell, last, next, b, straight ? x / c.length : 0, straight ? (next.s - from.s) / c.length : 1), 2 * d);
    last = next;
    x = next.s - from.s;
  }
  append(last, to, cap(cell, last, to, b, straight ? x / c.length : 0, 1),
         2 * std::min(before_[cell + 1], behind_[cell + 1]));
}

template <int N>
void JerkBound<N>::lay(const std::vector<double>& b, bool rest_first, bool rest_last) {
  const auto& nodes = grid_.nodes();
  const auto& cells = grid_.cells();
  pieces_.clear();
  joint_ = {};
  grade(b, rest_first, rest_last);
  for (std::size_t i = 0; i < cells.size(); ++i) {
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
  problem_.acceleration = acceleration_, problem_.jerk = jerk_;
  problem_.rest_first = rest_first && first == 0;
  double time = 0, turn = 0, capped = 0, swing = 0;
  std::size_t i = first;
  const auto known = [](const Piece& p) {
    return std::isfinite(p.cap) &&
           std::all_of(p.third.begin(), p.third.end(), [](double t) { return std::isfinite(t); });
  };
  for (; i < pieces_.size() && problem_.cells.size() < window && known(pieces_[i]); ++i) {
    const Piece& p = pieces_[i];
    double bend = 0;
    for (std::size_t k = 0; k < N; ++k) bend += sq(p.end[k] - p.begin[k]);
    bend = std::sqrt(bend);
    const bool open = !problem_.cells.empty() && time + p.time < spacing_ && turn + bend < widest_turn &&
                      swing + p.swing < widest_swing && problem_.cells.back().length + p.length < p.finest;
    if (!open) problem_.cells.emplace_back(), time = turn = capped = swing = 0, problem_.cells.back().begin = p.begin;
    RelaxationCell<N>& cell = problem_.cells.back();
    if (p.joint) {
      RelaxationStep<N> step{problem_.cells.size() - 1, cell.length, {}};
      for (std::size_t k = 0; k < N; ++k) step.time[k] = p.step[k] / jerk_[k], step.kink[k] = p.kink[k];
      problem_.steps.push_back(step);
    }
    for (std::size_t k = 0; k < N; ++k) cell.way[k] += p.way[k];
    cell.end = p.end;
    cell.length += p.length;
    capped += p.cap * p.length, cell.cap = capped / cell.length;
    time += p.time, turn += bend, swing += p.swing;
    cell_of_.push_back(problem_.cells.size() - 1);
  }
  ends_at_rest = i == pieces_.size() && rest_last;
  problem_.rest_last = ends_at_rest;
  return i;
}

template <int N>
double JerkBound<N>::evaluate(std::size_t first, std::size_t last, const RelaxationMultipliers<N>& multipliers) const {
  const auto& cells = problem_.cells;
  Sums sum;
  std::array<SplinePart, 3> parts{};
  std::size_t at = cells.size();
  double x = 0, margin = 0;
  std::array<double, 3> weight{};
  for (std::size_t i = first; i < last; ++i) {
    const Piece& p = pieces_[i];
    const std::size_t c = cell_of_[i - first];
    if (c != at) {
      const double h = cells[c].length;
      parts = spline_parts(c > 0 ? cells[c - 1].length : h, h, c + 1 < cells.size() ? cells[c + 1].length : h);
      for (std::size_t r = 0; r < 3; ++r) {
        double load = 0;
        for (std::size_t k = 0; k < N; ++k)
          if (multipliers.jerk[c + r][k] != 0) load += jerk_[k] * std::abs(multipliers.jerk[c + r][k]);
        weight[r] = 1 - load;
      }
      at = c, x = 0;
    }
    const double h = cells[c].length, y = x + p.length;
    // w is at least a quadratic: its Bernstein coefficients.
    double w0 = 0, w1 = 0, slope = 0;
    for (std::size_t r = 0; r < 3; ++r)
      w0 += weight[r] * parts[r].at(x), w1 += weight[r] * parts[r].at(y), slope += weight[r] * parts[r].slope(x);
    const double middle = w0 + slope * p.length / 2;
    const auto positive = [](double w) { return std::max(0.0, w - 1e-14); };
    const Range w{positive(std::min({w0, w1, middle})), positive(std::max({w0, w1, middle})),
                  positive((w0 + w1 + middle) / 3)};
    double integral = 0, size = 0, radius = 0, cost = 0, kink = 0, next_kink = 0;
    const bool before_joint = i + 1 < last && pieces_[i + 1].joint;
    for (std::size_t k = 0; k < grid_.axes(); ++k) {
      const double m0 = multipliers.acceleration[c][k], m1 = multipliers.acceleration[c + 1][k], rise = (m1 - m0) / h;
      double slope0 = 0, slope1 = 0, second = 0, jerk = 0;
      for (std::size_t r = 0; r < 3; ++r) {
        const double l = multipliers.jerk[c + r][k];
        slope0 += l * parts[r].slope(x), slope1 += l * parts[r].slope(y), second += l * parts[r].second;
        jerk += std::abs(l) * parts[r].at(x);
      }
      const double u0 = m0 + rise * x, u1 = m0 + rise * y;
      const double e0 = u0 - slope0, e1 = u1 - slope1, change = rise - second;
      integral += 0.5 * (e1 * p.end[k] - e0 * p.begin[k]) - change * p.way[k];
      size += (std::abs(e0) + std::abs(e1)) * (1 + p.bend[k] * p.length) + std::abs(change) * p.length;
      radius += 0.5 * std::max(std::abs(e0), std::abs(e1)) * p.third[k];
      cost += acceleration_[k] * p.length * (std::abs(u0) + std::abs(u1)) / 2;
      if (p.joint) cost += jerk * p.step[k], kink -= 0.5 * e0 * p.kink[k];
      if (before_joint) next_kink -= 0.5 * e1 * pieces_[i + 1].kink[k];
    }
    // What a jump of q′ adds to G stands at the joint. Half of it may be spread over the pieces on either side, for b
    // cannot change much there: on average by |v̇| times the length.
    const auto spread = [&](double jump, double joint_cap) {
      const double change = p.along * p.length;
      if (change < joint_cap)
        integral += jump / 2, size += std::abs(jump), cost += std::abs(jump) / 2 * change;
      else
        cost += std::max(0.0, -jump) / 2 * joint_cap;
    };
    if (p.joint) spread(kink, p.joint_cap);
    if (before_joint) spread(next_kink, pieces_[i + 1].joint_cap);
    // G stays within half of what it may change by about its mean.
    const double mean = (integral - p.rounding * size) / p.length, half = radius * p.length / 2;
    sum.add(least_mean(w, {mean - half, mean + half, mean}, p.cap) * p.length - cost);
    margin += 4 * epsilon * (cost + p.time);
    x = y;
    pulse_.work(1);
  }
  return sum.now - margin;
}

template <int N>
double JerkBound<N>::duration(const std::vector<double>& b, double time, bool rest_first, bool rest_last) {
  const double length = grid_.nodes().back().s - grid_.nodes().front().s;
  spacing_ = std::max(std::min(part_of_ramp * ramp_, time / min_cells),
                      time / (pieces_per_node * static_cast<double>(grid_.nodes().size()) + more_pieces));
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
      solver_.solve(problem_, {}, pulse_);
      cells_ += problem_.cells.size();
      total += evaluate(first, last, solver_.multipliers());
      first = last;
    }
  }
  return total * (1 - 1e-12);
}

template class JerkBound<2>;
template class JerkBound<3>;
template class JerkBound<8>;

}  // namespace bahnwerk::verify
