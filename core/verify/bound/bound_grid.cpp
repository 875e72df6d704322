#include "core/verify/bound/bound_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/geometry/curve/arc.hpp"

namespace bahnwerk::verify {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double widest_turn = 0.02;  // rad per cell
constexpr double curvature_change = 0.01, slight_turn = 1e-4;
constexpr double no_direction = 1e-12;  // |q'_k| below this: the axis stands still, its conditions are dropped
constexpr double give = 1 + 1e-11;      // caps give way for the rounding of curvatures
constexpr int deepest = 40;
// Cells in which q'_k may have the wrong sign by more than this are halved, so often at most.
constexpr double undecided = 1e-6;
constexpr int halvings = 12;

double sq(double x) { return x * x; }
double rounding_of(double s) { return 64 * epsilon * (1 + s); }  // of a difference of path lengths

template <std::size_t N>
double length_of(const std::array<double, N>& v) {
  double sum = 0;
  for (const double x : v) sum += sq(x);
  return std::sqrt(sum);
}
template <std::size_t N>
std::array<double, N> difference(const std::array<double, N>& a, const std::array<double, N>& b) {
  std::array<double, N> d;
  for (std::size_t k = 0; k < N; ++k) d[k] = a[k] - b[k];
  return d;
}
template <std::size_t N>
Vec direction(const std::array<double, N>& v) {
  return {v[0], v[1], N == 3 ? v[2] : 0};
}

// 12 (1 − x/tan x)/(4x²) with x = turn/2: what the curvature term of the trapezoid rule lacks on a circle. At most a
// few 1e-2 rad.
double circle_factor(double turn) {
  const double q = turn * turn;
  return 1 + q / 60 + q * q / 2520;
}

}  // namespace

template <int N>
BoundGrid<N>::BoundGrid(const AxisPath& path, const Machine& machine, std::vector<double> feeds, double corner_angle,
                        ProgressScope& pulse)
    : path_(path),
      axes_(path.axes()),
      cycle_time_(machine.cycle_time),
      corner_angle_(corner_angle),
      feeds_(std::move(feeds)),
      pulse_(pulse) {
  scale_.fill(1);
  if (!path.cartesian()) scale_axes();
  for (std::size_t k = 0; k < axes_; ++k) {
    acceleration_[k] = machine.axes[k].acceleration * scale_[k];
    velocity_[k] = machine.axes[k].velocity * scale_[k];
    jerk_[k] = machine.axes[k].jerk * scale_[k];
  }
  for (double& f : feeds_)
    if (!(f > 0)) f = unlimited;
}

// What counts as small is measured by 1; nothing else depends on it, so samples will do.
template <int N>
void BoundGrid<N>::scale_axes() {
  Row most{};
  for (std::size_t i = 0; i < path_.size(); ++i)
    for (const double u : path_[i].panel_parameters()) {
      pulse_.work(16);
      const AxisJet q = path_.at_parameter(i, u);
      for (std::size_t k = 0; k < axes_; ++k) most[k] = std::max(most[k], std::abs(q.d1[k]));
    }
  for (std::size_t k = 0; k < axes_; ++k)
    if (most[k] > 0 && std::isfinite(most[k])) scale_[k] = std::exp2(-std::ceil(std::log2(most[k])));
}

template <int N>
BoundNode<N> BoundGrid<N>::node(std::size_t segment, double u) const {
  const Segment& s = path_[segment];
  const Curve& curve = s.curve();
  Node n;
  n.u = u, n.segment = segment;
  if (path_.cartesian()) {
    const PathPoint h = s.at_parameter(u);
    n.position[0] = h.value.x, n.tangent[0] = h.d1.x, n.curvature[0] = h.d2.x;
    n.position[1] = h.value.y, n.tangent[1] = h.d1.y, n.curvature[1] = h.d2.y;
    if constexpr (N > 2) n.position[2] = h.value.z, n.tangent[2] = h.d1.z, n.curvature[2] = h.d2.z;
  } else {
    const AxisJet q = path_.at_parameter(segment, u);
    for (std::size_t k = 0; k < axes_; ++k)
      n.position[k] = scale_[k] * q.value[k], n.tangent[k] = scale_[k] * q.d1[k], n.curvature[k] = scale_[k] * q.d2[k];
    n.blur = 64 * epsilon;
  }
  if (curve.kind() == CurveKind::arc) n.blur = std::max(n.blur, 4 * epsilon);
  if (curve.kind() == CurveKind::rational && !s.straight()) {
    const auto& rational = static_cast<const Rational&>(curve);
    n.blur += std::min(1e-3, 16 * epsilon * (1 + rational.extent() / (rational.speed(u) * rational.reach())));
  }
  n.s = u <= curve.begin() ? s.s0() : u >= curve.end() ? s.s1() : s.arc_length(u);
  const bool cusp = (u <= curve.begin() && s.cusp_begin()) || (u >= curve.end() && s.cusp_end());
  if (cusp || linear(segment)) n.curvature = {};
  n.cap = cusp ? 0 : place_cap(n);
  return n;
}

// Velocity, feed, and the existence of an acceleration at this place.
template <int N>
double BoundGrid<N>::place_cap(const Node& n) const {
  double cap = sq(feeds_[n.segment]);
  for (std::size_t k = 0; k < axes_; ++k) {
    const double t = std::abs(n.tangent[k]);
    if (n.least(k) > 0) cap = std::min(cap, sq(velocity_[k]) / n.least(k));
    for (std::size_t m = 0; m < k; ++m) {
      const double turn = std::abs(n.tangent[m] * n.curvature[k] - n.tangent[k] * n.curvature[m]);
      const double reach = acceleration_[k] * std::abs(n.tangent[m]) + acceleration_[m] * t;
      if (turn > 0 && reach > 0) cap = std::min(cap, reach / turn * (give + 16 * n.blur));
    }
  }
  return cap;
}

// The curve may do something between a and b that the two nodes do not tell.
template <int N>
bool BoundGrid<N>::too_wide(const Node& a, const Node& b, double turn_limit) const {
  const double length = b.s - a.s, chord = length_of(difference(b.position, a.position));
  const double turn = path_.cartesian() ? angle_between(direction(a.tangent), direction(b.tangent))
                                        : length_of(difference(b.tangent, a.tangent));
  if (turn > turn_limit) return true;
  if (path_.cartesian()) {
    const double slack =
        1e-12 * path_[a.segment].length() + 8 * epsilon * (length_of(a.position) + length_of(b.position));
    if (length - chord > sq(turn_limit) / 16 * length + slack) return true;
  } else {
    for (std::size_t k = 0; k < axes_; ++k) {
      const double trapezoid = (a.tangent[k] + b.tangent[k]) / 2 * length;
      if (std::abs(b.position[k] - a.position[k] - trapezoid) > turn_limit / 4 * length) return true;
    }
  }
  const double trapezoid = (length_of(a.curvature) + length_of(b.curvature)) / 2 * length;
  return std::abs(trapezoid - turn) > turn / 4 + turn_limit / 20;
}

// Where the curvature changes quickly its cap on b has a valley that only nodes inside can show.
template <int N>
bool BoundGrid<N>::hides_valley(const Node& a, const Node& middle, const Node& b) {
  const double bend = std::max({length_of(a.curvature), length_of(middle.curvature), length_of(b.curvature)});
  if (bend * (b.s - a.s) < slight_turn) return false;
  const double change = std::max(length_of(difference(middle.curvature, a.curvature)),
                                 length_of(difference(b.curvature, middle.curvature)));
  return change > curvature_change * bend;
}

template <int N>
void BoundGrid<N>::append_segment(std::size_t index) {
  const Segment& segment = path_[index];
  const Curve& curve = segment.curve();
  const double u0 = curve.begin(), u1 = curve.end();
  Node last = node(index, u0);
  append(last);
  if (linear(index)) return append(node(index, u1));
  if (curve.kind() != CurveKind::rational) {
    const double sweep = curve.kind() == CurveKind::arc ? std::abs(static_cast<const Arc&>(curve).sweep()) : 0;
    const int n = std::max(path_.cartesian() ? 1 : 8, static_cast<int>(std::ceil(sweep / widest_turn)));
    for (int i = 1; i <= n; ++i) {
      const Node next = node(index, i == n ? u1 : u0 + (u1 - u0) * i / n);
      path_.cartesian() ? append_with_roots(last, next, 0) : append_between(last, next, 0);
      last = next;
    }
    return;
  }
  for (const double u : segment.panel_parameters()) {
    if (!(u > last.u)) continue;
    const Node next = node(index, u);
    append_between(last, next, 0);
    last = next;
  }
}

template <int N>
void BoundGrid<N>::append_between(const Node& a, const Node& b, int depth) {
  const double u = a.u + (b.u - a.u) / 2;
  if (depth >= deepest || !(u > a.u && u < b.u)) return append_with_roots(a, b, 0);
  const Node middle = node(a.segment, u);
  if (!too_wide(a, b, widest_turn) && !hides_valley(a, middle, b)) return append_with_roots(a, b, 0);
  append_between(a, middle, depth + 1);
  append_between(middle, b, depth + 1);
}

// A node wherever a component of the tangent changes sign from a to b.
template <int N>
void BoundGrid<N>::append_with_roots(const Node& a, const Node& b, int axis, int depth) {
  for (std::size_t k = static_cast<std::size_t>(axis); k < axes_; ++k) {
    double flo = a.tangent[k], fhi = b.tangent[k], lo = a.u, hi = b.u;
    if (!(flo * fhi < 0) || std::max(std::abs(flo), std::abs(fhi)) < no_direction) continue;
    Node root;
    for (int i = 0, side = 0; i < 80; ++i) {
      double u = (lo * fhi - hi * flo) / (fhi - flo);
      if (i > 20 || !(u > lo && u < hi)) u = lo + (hi - lo) / 2;
      if (!(u > lo && u < hi)) break;
      root = node(a.segment, u);
      const double f = root.tangent[k];
      if (std::abs(f) < 2 * epsilon) break;
      if (f * flo > 0) {
        lo = u, flo = f;
        if (side < 0) fhi /= 2;
        side = -1;
      } else {
        hi = u, fhi = f;
        if (side > 0) flo /= 2;
        side = 1;
      }
    }
    if (!(root.u > a.u && root.u < b.u)) continue;
    root.tangent[k] = 0;
    append_with_roots(a, root, static_cast<int>(k) + 1, depth);
    append_with_roots(root, b, static_cast<int>(k) + 1, depth);
    return;
  }
  append_monotone(a, b, depth);
}

// The ends of the cell agree on the way that every axis goes. Where it cannot be shown that all between agrees, too,
// half a cell tells more; what is left in doubt then goes into the cell's energy.
template <int N>
void BoundGrid<N>::append_monotone(const Node& a, const Node& b, int depth) {
  const double length = b.s - a.s;
  if (!(length > rounding_of(b.s))) return append(b);
  const DirectionRange<N> all = range(a, b);
  bool doubt = false;
  for (std::size_t k = 0; k < axes_; ++k) doubt = doubt || all.wrong(k) > undecided;
  const double u = a.u + (b.u - a.u) / 2;
  if (!doubt || depth >= halvings || !(length > 1e-7 * path_[a.segment].length()) || !(u > a.u && u < b.u))
    return append(b, &all);
  const Node middle = node(a.segment, u);
  append_with_roots(a, middle, 0, depth + 1);
  append_with_roots(middle, b, 0, depth + 1);
}

template <int N>
void BoundGrid<N>::append(const Node& b, const DirectionRange<N>* range) {
  nodes_.push_back(b);
  pulse_.work(linear(b.segment) ? 1 : 8);
  if (nodes_.size() < 2) return;
  cells_.push_back(cell(nodes_[nodes_.size() - 2], nodes_.back(), range));
}

// Under a limit of jerk the acceleration of an axis may step by jerk · cycle time, |Δq''_k b + Δq'_k v̇| at most, and
// the acceleration v̇ along the path does not step.
template <int N>
double BoundGrid<N>::step_cap(const Node& a, const Node& b, double cap) const {
  double along = std::numeric_limits<double>::infinity();
  for (const Node* n : {&a, &b})
    for (std::size_t k = 0; k < axes_; ++k)
      if (n->least(k) > 0)
        along = std::min(along, (acceleration_[k] + std::abs(n->curvature[k]) * cap) / std::sqrt(n->least(k)));
  double most = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < axes_; ++k) {
    const double step = std::abs(b.curvature[k] - a.curvature[k]), kink = std::abs(b.tangent[k] - a.tangent[k]);
    const double allowed = jerk_[k] * cycle_time_ + (kink > 0 ? kink * along : 0);
    if (step > 0 && allowed < most * step) most = allowed / step * give;
  }
  return most;
}

// By how much the tool's direction jumps.
template <int N>
double BoundGrid<N>::corner(const Node& a, const Node& b) const {
  if (unit_direction(a) && unit_direction(b)) return angle_between(direction(a.tangent), direction(b.tangent));
  const Segment &before = path_[a.segment], &after = path_[b.segment];
  return angle_between(before.at_parameter(a.u).d1, after.at_parameter(b.u).d1);
}

// No axis that the tool moves along is left out.
template <int N>
bool BoundGrid<N>::unit_direction(const Node& n) const {
  double square = 0;
  for (const double t : n.tangent) square += sq(t);
  return path_.cartesian() && axes_ == N && std::abs(square - 1) < 1e-9;
}

template <int N>
BoundCell<N> BoundGrid<N>::cell(Node& a, Node& b, const DirectionRange<N>* range) const {
  Cell c;
  if (a.segment != b.segment) {
    double cap = std::min(a.cap, b.cap);
    for (std::size_t k = 0; k < axes_; ++k)
      if (const double step = b.tangent[k] - a.tangent[k]; step != 0)
        cap = std::min(cap, sq(acceleration_[k] * cycle_time_ / step) * give);
    cap = std::min(cap, step_cap(a, b, cap));
    a.cap = b.cap = corner(a, b) > corner_angle_ ? 0 : cap;
    return c;
  }
  const Segment& segment = path_[a.segment];
  c.length = b.s - a.s;
  if (const double blur = rounding_of(b.s); c.length <= blur && unit_direction(a)) {
    // Differences over such a cell are rounding: only |d(v²)/ds| ≤ 2 |A| is asked of it.
    double square = 0;
    for (std::size_t k = 0; k < axes_; ++k) square += sq(acceleration_[k]);
    c.slip = 2 * std::sqrt(square) * (c.length + blur);
    return c;
  }
  c.kind = linear(a.segment) ? Cell::Kind::straight : Cell::Kind::curved;
  const bool arc = path_.cartesian() && segment.curve().kind() == CurveKind::arc;
  double bend = 0, rounding = 0;
  if (arc) {
    bend = sq(c.length) / 12 * circle_factor(static_cast<const Arc&>(segment.curve()).sweep() * (b.u - a.u));
  } else if (c.kind == Cell::Kind::curved) {
    double size = length_of(a.position) + length_of(b.position);
    if (segment.curve().kind() == CurveKind::rational) size += static_cast<const Rational&>(segment.curve()).extent();
    rounding = 4 * epsilon * size;
    if (!path_.cartesian()) rounding = 4 * rounding + 16 * epsilon * norm(segment.curve().at(a.u).value);
  }
  if (c.kind == Cell::Kind::curved && range == nullptr) {
    const DirectionRange<N> own = this->range(a, b);
    return cell(a, b, &own);
  }
  for (std::size_t k = 0; k < axes_; ++k) {
    double way = 0;
    if (c.kind == Cell::Kind::straight)
      way = std::abs(a.tangent[k]) * c.length;
    else if (arc)  // ∫h' ds from both ends without cancellation, exact on circles and helices
      way = std::abs((a.tangent[k] + b.tangent[k]) / 2 * c.length + bend * (a.curvature[k] - b.curvature[k]));
    else
      way = std::abs(b.position[k] - a.position[k]);
    c.way[k] = std::max(0.0, way * (1 - 1e-13) - rounding);
    if (c.kind == Cell::Kind::curved)  // there and back
      way = std::min(way + 2 * c.length * range->wrong(k), c.length * range->most(k));
    c.energy[k] = 2 * acceleration_[k] * (way + 1e-13 * c.length + rounding);
  }
  if (c.kind == Cell::Kind::straight) return c;
  c.divisible = c.length > 1e4 * rounding;
  double fastest = feeds_[a.segment];
  for (std::size_t k = 0; k < axes_; ++k)
    if (const double least = range->least(k) - a.blur - b.blur; least > no_direction)
      fastest = std::min(fastest, velocity_[k] / least);
  for (std::size_t k = 0; k < axes_; ++k)
    c.velocity[k] = std::min(velocity_[k], fastest * (range->most(k) + a.blur + b.blur));
  // p_m b_a ≤ q_m b_b + c_m and q_k b_b ≤ p_k b_a + c_k leave b_a and b_b finite where the lines cross.
  for (std::size_t k = 0; k < axes_; ++k)
    for (std::size_t m = 0; m < axes_; ++m) {
      if (m == k) continue;
      const double pk = a.most(k), qk = b.least(k), pm = a.least(m), qm = b.most(m);
      const double cross = pm * qk * (1 - 4 * epsilon) - pk * qm;
      if (!(cross > 0)) continue;
      b.cap = std::min(b.cap, (pk * c.energy[m] + pm * c.energy[k]) / cross * give);
      a.cap = std::min(a.cap, (qm * c.energy[k] + qk * c.energy[m]) / cross * give);
    }
  return c;
}

template <int N>
void BoundGrid<N>::build(std::size_t first, std::size_t last, bool rest_first, bool rest_last) {
  nodes_.clear(), cells_.clear();
  for (std::size_t i = first; i < last; ++i) append_segment(i);
  if (rest_first) nodes_.front().cap = 0;
  if (rest_last) nodes_.back().cap = 0;
}

template <int N>
void BoundGrid<N>::refine(const std::vector<unsigned char>& marked) {
  Blocks<Node> old;
  Blocks<Cell> old_cells;
  old.swap(nodes_), old_cells.swap(cells_);
  nodes_.push_back(old.front());
  for (std::size_t i = 0; i < old_cells.size(); ++i) {
    if (i % 64 == 0) pulse_.work(16);
    Node& b = old[i + 1];
    if (!marked[i] || !old_cells[i].divisible) {
      nodes_.push_back(b);
      cells_.push_back(old_cells[i]);
      continue;
    }
    const double from = old[i].u, width = b.u - from;
    Node last = nodes_.back();
    for (int part = 1; part <= 3; ++part) {
      const double u = from + width * part / 4;
      if (!(u > last.u && u < b.u)) continue;
      const Node next = node(b.segment, u);
      append_with_roots(last, next, 0);
      last = next;
    }
    append_with_roots(last, Node(b), 0);
  }
}

template class BoundGrid<2>;
template class BoundGrid<3>;
template class BoundGrid<8>;

}  // namespace bahnwerk::verify
