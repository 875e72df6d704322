#include "core/verify/bound/jerk_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace bahnwerk::verify {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity(), never = 1e300, root_4_5 = 2.1213203435596424;
// Next to rest a cell is this part of its distance from there.
constexpr double cell_of_distance = 0.2, part_of_first = 0.25;
// Next to a joint at which an axis steps a cell is passed in this part of a cycle; in less where the joint holds v²
// down to less than this part of what feed and bends allow.
constexpr double part_of_cycle = 0.25, held_part_of_cycle = 0.02, held = 0.7;
constexpr double at_feed = 0.999, cruising = 4;
// A motion with limited jerk takes some √(v/J) to change its speed by a part of v: there a cell takes this part of that
// time; less through kinematics, where speeds fall and rise again in a few milliseconds. Curvature and its changes slow
// a motion down if they take `slowing` times the jerk limit at the current speed. If they take `slowed` of it they may,
// together with other terms: cells on Cartesian axes are then as short as if they did. Fine cells are half as long.
constexpr double part_of_change = 0.1, fine_part = 0.05, kinematic_part = 0.08, slowing = 3, slowed = 0.3;
// Where jerk leaves less of v² than all other conditions, by `capped` of it at least, a law changes faster than that,
// and multipliers need cells of this part of the length.
constexpr double capped = 0.05, capped_part = 0.35;
// Through kinematics an enclosure costs as much as a cell of the relaxation.
constexpr double pieces_per_cell = 2.1, kinematic_pieces = 1.05;
constexpr double part_joined = 0.125;  // part of the longest piece below which cells of the grid are joined to one
// Relative change of b in a piece whose jerk limits b, and through kinematics: such a piece is halved, at most this
// often.
constexpr double much_change = 0.1, kinematic_change = 0.015;
constexpr int halvings = 3;

}  // namespace

template <int N>
JerkPieces<N>::JerkPieces(const BoundGrid<N>& grid, double cycle_time, const Row& shown, ProgressScope& progress)
    : grid_(grid),
      progress_(progress),
      cycle_time_(cycle_time),
      per_cell_(grid.cartesian() ? pieces_per_cell : kinematic_pieces),
      part_of_distance_(grid.cartesian() ? cell_of_distance / 2 : cell_of_distance),
      slower_(grid.cartesian() ? slowed / slowing : 1),
      much_change_(grid.cartesian() ? much_change : kinematic_change),
      shown_jerk_(shown) {
  piece_.axes = grid.axes();
  for (std::size_t k = 0; k < grid.axes(); ++k)
    piece_.acceleration[k] = grid.acceleration(k), piece_.jerk[k] = grid.jerk(k);
}

// Returns the largest b between two places within a cell. From the cell's beginning to the far end of the piece q'_k² b
// changes by at most 2 A_k ∫ |q'_k| ds: a part of the change over the whole cell where q is linear, and at most the
// largest |q'_k| times the length elsewhere. `steepest` has these largest values; null: the piece is the cell.
template <int N>
double JerkPieces<N>::cap(std::size_t cell, const Node& a, const Node& b, const std::vector<double>& at_nodes,
                          const Row* steepest) const {
  const Cell& c = grid_.cells()[cell];
  const Node &from = grid_.nodes()[cell], &to = grid_.nodes()[cell + 1];
  double most = std::min(sq(grid_.feed(a.segment)), grid_.jerk_cap(a, b));
  const bool straight = c.kind == Cell::Kind::straight;
  const DirectionRange<N> range = grid_.range(a, b);
  const double ahead = b.s - from.s, behind = to.s - a.s;
  for (std::size_t k = 0; k < grid_.axes(); ++k) {
    const double q2 = sq(std::max(0.0, range.least(k) - a.rounding_error - b.rounding_error));
    if (!(q2 > 1e-24)) continue;
    double forward = c.energy[k], backward = c.energy[k];
    if (steepest != nullptr && straight) {
      forward *= ahead / c.length, backward *= behind / c.length;
    } else if (steepest != nullptr) {
      const double per_way = 2 * grid_.acceleration(k) * (*steepest)[k], rounding_error = 64 * epsilon * std::abs(to.s);
      forward = std::min(forward, per_way * (ahead + rounding_error)),
      backward = std::min(backward, per_way * (behind + rounding_error));
    }
    most = std::min({most, sq(grid_.velocity(k)) / q2, (from.most(k) * at_nodes[cell] + forward) / q2,
                     (to.most(k) * at_nodes[cell + 1] + backward) / q2});
  }
  return most * (1 + 1e-12);
}

template <int N>
void JerkPieces<N>::join(const Node& a, const Node& b, double cap) {
  const double along = grid_.along(a, b, cap);
  joint_.cap = joint_.here ? std::max(joint_.cap, cap) : cap;
  joint_.here = true;
  for (std::size_t k = 0; k < grid_.axes(); ++k) {
    const double tangent_jump = b.tangent[k] - a.tangent[k], q2 = b.curvature[k] - a.curvature[k];
    const double allowed = grid_.jerk(k) * cycle_time_;
    // This is the unknown part of the step if the part that follows from q″ is known.
    const double rest = (tangent_jump != 0 ? std::abs(tangent_jump) * along : 0) +
                        1e-9 * (std::abs(a.curvature[k]) + std::abs(b.curvature[k])) * cap;
    joint_.tangent_jump[k] += tangent_jump;
    if (rest <= allowed) joint_.acceleration_step[k] += q2;
    joint_.step[k] += std::min(rest, allowed) * (1 + 1e-9);
  }
}

// Enclosures of the cells are closer than one over all of them.
template <int N>
DirectionRange<N> JerkPieces<N>::range(const Draft& draft) const {
  if (draft.first == draft.last) return grid_.range(draft.a, draft.b);
  DirectionRange<N> all = grid_.range(draft.a, grid_.nodes()[draft.first + 1]);
  for (std::size_t i = draft.first + 1; i <= draft.last; ++i) {
    const DirectionRange<N> one = grid_.range(grid_.nodes()[i], grid_.nodes()[i + 1]);
    for (std::size_t k = 0; k < N; ++k)
      all.low[k] = std::min(all.low[k], one.low[k]), all.high[k] = std::max(all.high[k], one.high[k]);
    progress_.work(8);
  }
  return all;
}

// Appends a piece; where jerk may limit b, in halves as long as b may change so much that little is known of it.
template <int N>
void JerkPieces<N>::append(const Draft& draft, int depth) {
  const Node &a = draft.a, &b = draft.b;
  if (!(b.s > a.s) || !std::isfinite(draft.cap)) return push(draft);
  piece_.length = b.s - a.s, piece_.rounding_error = std::max(a.rounding_error, b.rounding_error);
  piece_.tangent = {a.tangent, b.tangent}, piece_.q2 = {a.curvature, b.curvature};
  if (!jerk_may_limit(piece_, draft.cap)) return push(draft);
  one_way_.set(piece_, a, b, draft.first, draft.last);
  const DirectionRange<N> range = this->range(draft);
  for (std::size_t k = 0; k < grid_.axes(); ++k) {
    piece_.least[k] = range.least(k), piece_.most[k] = range.most(k);
    piece_.displacement[k] = std::abs(b.position[k] - a.position[k]) + 64 * epsilon * std::abs(b.position[k]);
  }
  piece_.unit = grid_.unit_direction(a) && grid_.unit_direction(b);
  const JerkCap found = jerk_cap(piece_, draft.cap);
  if (found.change > much_change_ * found.cap && depth < halvings) {
    const double u = a.u + (b.u - a.u) / 2;
    const std::size_t half = (draft.first + draft.last + 1) / 2;
    const bool joined = draft.first < draft.last;
    if (const Node middle = joined ? grid_.nodes()[half] : grid_.node(a.segment, u); middle.s > a.s && b.s > middle.s) {
      const std::size_t end = joined ? half - 1 : draft.last, begin = joined ? half : draft.first;
      append({a, middle, draft.first, end, draft.extent, found.cap, draft.without}, depth + 1);
      return append({middle, b, begin, draft.last, draft.extent, found.cap, draft.without}, depth + 1);
    }
  }
  push({a, b, draft.first, draft.last, draft.extent, found.cap, draft.without});
}

template <int N>
void JerkPieces<N>::push(const Draft& draft) {
  const Node &a = draft.a, &b = draft.b;
  if (!(b.s > a.s)) return;  // the joint before it stands before the next one
  DualPiece<N> p = dual_piece(grid_, a, b, draft.cap, grid_.third(a, b));
  p.joint = std::exchange(joint_, {});
  Extent extent = draft.extent;
  // The cap without jerk counts: by it cells are short where q″ changes.
  for (std::size_t k = 0; k < grid_.axes(); ++k)
    extent.swing =
        std::max(extent.swing, std::abs(b.curvature[k] - a.curvature[k]) * draft.without / grid_.acceleration(k));
  pieces_.push_back(p);
  if (!grid_.cartesian() && draft.cap < (1 - capped) * draft.without) extent.finest *= capped_part;
  extents_.push_back(extent);
}

// About how fast a motion with limited jerk is where something else than the feed slows it down. Round a bend of
// curvature κ its jerk is κ² v³ and more, where curvature changes κ′ v³; where jerk builds up acceleration v^(3/2)
// grows by 3/√2 √J per length.
template <int N>
void JerkPieces<N>::expect(const std::vector<double>& b, bool rest_first, bool rest_last) {
  const auto& nodes = grid_.nodes();
  const auto& cells = grid_.cells();
  const std::size_t n = b.size() - 1;
  expected_.resize(n + 1), slow_.resize(n + 1), growth_.resize(n);
  for (std::size_t i = 0; i <= n; ++i) {
    const Node& node = nodes[i];
    const double q2 = length_of(node.curvature);
    double cube = never;  // v³
    for (std::size_t k = 0; k < grid_.axes(); ++k)
      if (const double rate = std::abs(node.curvature[k]) * q2; rate > 0)
        cube = std::min(cube, slowing * shown_jerk_[k] / rate);
    const bool fed = b[i] > sq(at_feed * grid_.feed(node.segment));
    const double known = fed ? never : std::pow(b[i], 0.75);
    expected_[i] = std::min(known, std::sqrt(cube)), slow_[i] = std::min(known, std::sqrt(slower_ * cube));
    progress_.work(2);
  }
  for (std::size_t i = 0; i < n; ++i) {
    double jerk = infinite, cube = never;
    for (std::size_t k = 0; k < grid_.axes(); ++k) {
      const Node &from = nodes[i], &to = nodes[i + 1];
      const double along = std::min(std::abs(from.tangent[k]), std::abs(to.tangent[k]));
      if (along > 0) jerk = std::min(jerk, shown_jerk_[k] / along);
      const double change = std::abs(to.curvature[k] - from.curvature[k]);
      if (change > 0) cube = std::min(cube, slowing * shown_jerk_[k] * cells[i].length / change);
    }
    growth_[i] = jerk < infinite ? std::sqrt(4.5 * jerk) : never;
    if (cells[i].kind == Cell::Kind::joint || !(cells[i].length > 0)) continue;
    for (const std::size_t end : {i, i + 1}) {
      expected_[end] = std::min(expected_[end], std::sqrt(cube));
      slow_[end] = std::min(slow_[end], std::sqrt(slower_ * cube));
    }
  }
  for (std::vector<double>* speed : {&expected_, &slow_}) {
    std::vector<double>& v = *speed;
    if (rest_first) v[0] = 0;
    if (rest_last) v[n] = 0;
    const auto reached = [&](std::size_t from, std::size_t cell) {
      return cells[cell].length > 0 ? v[from] + growth_[cell] * cells[cell].length : v[from];
    };
    for (std::size_t i = 0; i < n; ++i) v[i + 1] = std::min(v[i + 1], reached(i, i));
    for (std::size_t i = n; i-- > 0;) v[i] = std::min(v[i], reached(i + 1, i));
  }
}

// Returns the longest piece next to a node: at rest acceleration builds up on a short distance, and where an axis has
// to step by more acceleration than one cycle allows the motion slows down within a few cycles.
template <int N>
double JerkPieces<N>::finest_at(std::size_t node, const std::vector<double>& b) const {
  const Node &from = grid_.nodes()[node], &to = grid_.nodes()[node + 1];
  const double most = std::min(b[node], b[node + 1]);
  double finest = infinite, jerk = infinite;
  for (std::size_t k = 0; k < grid_.axes(); ++k) {
    const double q2 = std::abs(to.curvature[k] - from.curvature[k]), step = shown_jerk_[k] * cycle_time_;
    if (q2 * most > step) finest = std::min(finest, cycle_time_ * std::sqrt(step / q2));
    jerk = std::min(jerk, shown_jerk_[k]);
  }
  if (finest == infinite) return infinite;
  const double q2 = std::max(length_of(from.curvature), length_of(to.curvature));
  const double free =
      std::min({sq(grid_.feed(from.segment)), sq(grid_.feed(to.segment)), std::pow(jerk / sq(q2), 2.0 / 3)});
  return finest * (most < held * free ? held_part_of_cycle : part_of_cycle);
}

template <int N>
void JerkPieces<N>::grade(const std::vector<double>& b, bool rest_first, bool rest_last) {
  const auto& cells = grid_.cells();
  const std::size_t n = b.size() - 1;
  before_.assign(n + 1, infinite), behind_.assign(n + 1, infinite);
  if (rest_first) before_[0] = first_piece_;
  if (rest_last) behind_[n] = first_piece_;
  for (std::size_t i = 0; i < n; ++i) {
    before_[i + 1] = before_[i] + part_of_distance_ * cells[i].length;
    if (cells[i].kind == Cell::Kind::joint) before_[i + 1] = std::min(before_[i + 1], behind_[i] = finest_at(i, b));
    progress_.work(1);
  }
  for (std::size_t i = n; i-- > 0;)
    behind_[i] = std::min(behind_[i], behind_[i + 1] + part_of_distance_ * cells[i].length);
}

// Returns the longest cell x mm into a cell. Where only the feed limits a motion, only the path causes changes, and
// less so with the distance of other conditions.
template <int N>
typename JerkPieces<N>::Extent JerkPieces<N>::extent(std::size_t cell, double x, const Room& room,
                                                     const std::vector<double>& b) const {
  const Cell& c = grid_.cells()[cell];
  const double left = c.length - x, feed = grid_.feed(grid_.nodes()[cell].segment);
  const double most =
      std::min({room.cap, b[cell] + room.energy * (x / c.length), b[cell + 1] + room.energy * (left / c.length)});
  const double expected = std::min(expected_[cell] + growth_[cell] * x, expected_[cell + 1] + growth_[cell] * left);
  const double slow = std::min(slow_[cell] + growth_[cell] * x, slow_[cell + 1] + growth_[cell] * left);
  const double speed = std::min(std::sqrt(std::max(most, 0.0)), std::cbrt(slow * slow));
  const double ease = std::max(1.0, expected / (feed * std::sqrt(feed)));
  Extent e;
  e.spacing = std::min(ease, cruising) * spacing_;
  if (growth_[cell] < never)
    e.spacing = std::min(e.spacing, ease * part_of_change_ * root_4_5 * std::sqrt(speed) / growth_[cell]);
  e.finest = per_cell_ / 2 * std::max(e.spacing * speed, part_of_first * first_piece_);
  e.piece = std::min({e.finest / per_cell_, before_[cell] + part_of_distance_ * x,
                      (behind_[cell + 1] + part_of_distance_ * left) / (1 + part_of_distance_)});
  return e;
}

template <int N>
typename JerkPieces<N>::Room JerkPieces<N>::room(std::size_t cell, const std::vector<double>& b) const {
  const Node &from = grid_.nodes()[cell], &to = grid_.nodes()[cell + 1];
  double energy = infinite;
  for (std::size_t k = 0; k < grid_.axes(); ++k)
    if (const double least = std::min(from.least(k), to.least(k)); least > 1e-12)
      energy = std::min(energy, grid_.cells()[cell].energy[k] / least);
  return {energy, cap(cell, from, to, b, nullptr)};
}

// Pieces of a cell: evenly in time, finer and finer towards rests and steps.
template <int N>
void JerkPieces<N>::divide(std::size_t cell, const Room& room, const std::vector<double>& b) {
  const Cell& c = grid_.cells()[cell];
  const Node &from = grid_.nodes()[cell], &to = grid_.nodes()[cell + 1];
  grid_.remember(from, to);
  const DirectionRange<N> range = grid_.range(from, to);
  Row steepest;
  for (std::size_t k = 0; k < N; ++k) steepest[k] = range.most(k) + from.rounding_error + to.rounding_error;
  double x = 0;
  Extent e{};
  Node last = from;
  while (x < c.length) {
    e = extent(cell, x, room, b);
    const double d = std::max(e.piece, c.length * 1e-4);
    progress_.work(2);
    // A part of the rest is taken, since length is no linear function of the parameter.
    const double u = last.u + (to.u - last.u) * (d / (c.length - x));
    if (x + 1.5 * d >= c.length || !(u > last.u && u < to.u)) break;
    const Node next = grid_.node(from.segment, u);
    e.finest = per_cell_ * d;
    const double most = cap(cell, last, next, b, &steepest);
    append({last, next, cell, cell, e, most, most});
    last = next;
    x = next.s - from.s;
  }
  e.finest = std::min(e.finest, per_cell_ * std::min(before_[cell + 1], behind_[cell + 1]));
  const double most = x > 0 ? cap(cell, last, to, b, &steepest) : room.cap;
  append({last, to, cell, cell, e, most, most});
  grid_.forget();
}

// The cells from `first` on that are so short that they make up one piece: what a piece is worth less for rounding
// grows as it shrinks. Returns one past the last, `first` where there is nothing to join.
template <int N>
std::size_t JerkPieces<N>::joined(std::size_t first, const Room& room, const std::vector<double>& b) {
  const auto& cells = grid_.cells();
  const auto& nodes = grid_.nodes();
  Extent e = extent(first, 0, room, b);
  double length = cells[first].length, most = room.cap;
  std::size_t i = first + 1;
  for (; i + 1 < b.size() && cells[i].kind != Cell::Kind::joint && nodes[i + 1].segment == nodes[first].segment; ++i) {
    const double limit = part_joined * std::min(e.piece, behind_[i + 1]);
    if (!(length + cells[i].length < limit)) break;
    length += cells[i].length;
    most = std::max(most, cap(i, nodes[i], nodes[i + 1], b, nullptr));
    progress_.work(2);
  }
  if (i == first + 1) return first;
  append({nodes[first], nodes[i], first, i - 1, e, most, most});
  return i;
}

template <int N>
void JerkPieces<N>::begin(const std::vector<double>& b, bool rest_first, bool rest_last, double spacing,
                          double first_piece, bool fine) {
  part_of_change_ = !grid_.cartesian() ? kinematic_part : fine ? fine_part : part_of_change;
  spacing_ = spacing, first_piece_ = first_piece;
  pieces_.clear(), extents_.clear();
  joint_ = {};
  most_ = &b, next_ = 0, dropped_ = false;
  one_way_.take(grid_, b, rest_first, rest_last, cycle_time_);
  grade(b, rest_first, rest_last);
  expect(b, rest_first, rest_last);
}

template <int N>
bool JerkPieces<N>::has(std::size_t i) {
  while (pieces_.size() <= i && next_ + 1 < most_->size()) lay_next();
  return i < pieces_.size();
}

template <int N>
void JerkPieces<N>::drop(std::size_t count) {
  pieces_.erase(pieces_.begin(), pieces_.begin() + static_cast<std::ptrdiff_t>(count));
  extents_.erase(extents_.begin(), extents_.begin() + static_cast<std::ptrdiff_t>(count));
  dropped_ = dropped_ || count > 0;
}

template <int N>
void JerkPieces<N>::lay_next() {
  const auto& nodes = grid_.nodes();
  const std::vector<double>& b = *most_;
  progress_.work(8);
  if (grid_.cells()[next_].kind == Cell::Kind::joint) {
    join(nodes[next_], nodes[next_ + 1], std::min(b[next_], b[next_ + 1]));
    ++next_;
    return;
  }
  const Room room = this->room(next_, b);
  const std::size_t behind = joined(next_, room, b);
  if (behind == next_)
    divide(next_++, room, b);
  else
    next_ = behind;
}

template class JerkPieces<2>;
template class JerkPieces<3>;
template class JerkPieces<5>;
template class JerkPieces<8>;

}  // namespace bahnwerk::verify
