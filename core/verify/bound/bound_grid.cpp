#include "core/verify/bound/bound_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/curve/arc.hpp"

namespace bahnwerk::verify {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double widest_turn = 0.02;  // rad per cell
constexpr double curvature_change = 0.01, slight_turn = 1e-4;
constexpr double no_direction = 1e-12;  // |h'_k| below this: the axis stands still, its conditions are dropped
constexpr double give = 1 + 1e-11;      // caps give way for the rounding of curvatures
constexpr int deepest = 40;

double sq(double x) { return x * x; }

// 12 (1 − x/tan x)/(4x²) with x = turn/2: what the curvature term of the trapezoid rule lacks on a circle. At most a
// few 1e-2 rad.
double circle_factor(double turn) {
  const double q = turn * turn;
  return 1 + q / 60 + q * q / 2520;
}

}  // namespace

BoundGrid::BoundGrid(const Contour& contour, const Machine& machine, double corner_angle, ProgressScope& pulse)
    : contour_(contour),
      axes_(std::min<std::size_t>(machine.axes.size(), 3)),
      cycle_time_(machine.cycle_time),
      corner_angle_(corner_angle),
      feeds_(contour.feeds()),
      pulse_(pulse) {
  for (std::size_t k = 0; k < axes_; ++k) {
    acceleration_[k] = machine.axes[k].acceleration;
    velocity_[k] = machine.axes[k].velocity;
  }
  for (double& f : feeds_)
    if (!(f > 0)) f = unlimited;
}

BoundNode BoundGrid::node(std::size_t segment, double u) const {
  const Segment& s = contour_.path[segment];
  const Curve& curve = s.curve();
  const PathPoint h = s.at_parameter(u);
  BoundNode n;
  n.position = h.value, n.tangent = h.d1, n.curvature = h.d2, n.u = u, n.segment = segment;
  if (curve.kind() == CurveKind::arc) n.blur = 4 * epsilon;
  if (curve.kind() == CurveKind::rational && !s.straight()) {
    const auto& rational = static_cast<const Rational&>(curve);
    n.blur = std::min(1e-3, 16 * epsilon * (1 + rational.extent() / (rational.speed(u) * rational.reach())));
  }
  n.s = u <= curve.begin() ? s.s0() : u >= curve.end() ? s.s1() : s.arc_length(u);
  const bool cusp = (u <= curve.begin() && s.cusp_begin()) || (u >= curve.end() && s.cusp_end());
  if (cusp || s.straight()) n.curvature = {};
  n.cap = cusp ? 0 : place_cap(n);
  return n;
}

// Velocity, feed, and the existence of an acceleration at this place.
double BoundGrid::place_cap(const BoundNode& n) const {
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
bool BoundGrid::too_wide(const BoundNode& a, const BoundNode& b, double turn_limit) const {
  const double turn = angle_between(a.tangent, b.tangent), length = b.s - a.s;
  if (turn > turn_limit) return true;
  const double slack = 1e-12 * contour_.path[a.segment].length() + 8 * epsilon * (norm(a.position) + norm(b.position));
  if (length - norm(b.position - a.position) > sq(turn_limit) / 16 * length + slack) return true;
  const double trapezoid = (norm(a.curvature) + norm(b.curvature)) / 2 * length;
  if (std::abs(trapezoid - turn) > turn / 4 + turn_limit / 20) return true;
  for (std::size_t k = 0; k < axes_; ++k) {  // h'_k comes down from both sides: may it touch zero in between?
    const double sign = a.tangent[k] > 0 ? 1 : -1, t0 = sign * a.tangent[k], t1 = sign * b.tangent[k];
    const double d0 = sign * a.curvature[k], d1 = sign * b.curvature[k];
    if (!(t0 > no_direction && t1 > no_direction && d0 < 0 && d1 > 0)) continue;
    const double meet = (t1 - t0 - d1 * length) / (d0 - d1);  // of the tangents to h'_k
    if (t0 + d0 * meet < 0 && length > 1e-9 * contour_.path[a.segment].length()) return true;
  }
  return false;
}

// Where the curvature changes quickly its cap on b has a valley that only nodes inside can show.
bool BoundGrid::hides_valley(const BoundNode& a, const BoundNode& middle, const BoundNode& b) {
  const double bend = std::max({norm(a.curvature), norm(middle.curvature), norm(b.curvature)});
  if (bend * (b.s - a.s) < slight_turn) return false;
  const double change = std::max(norm(middle.curvature - a.curvature), norm(b.curvature - middle.curvature));
  return change > curvature_change * bend;
}

void BoundGrid::append_segment(std::size_t index) {
  const Segment& segment = contour_.path[index];
  const Curve& curve = segment.curve();
  const double u0 = curve.begin(), u1 = curve.end();
  BoundNode last = node(index, u0);
  append(last);
  if (segment.straight()) return append(node(index, u1));
  if (curve.kind() == CurveKind::arc) {
    const double sweep = std::abs(static_cast<const Arc&>(curve).sweep());
    const int n = std::max(1, static_cast<int>(std::ceil(sweep / widest_turn)));
    for (int i = 1; i <= n; ++i) {
      const BoundNode next = node(index, i == n ? u1 : u0 + (u1 - u0) * i / n);
      append_with_roots(last, next, 0);
      last = next;
    }
    return;
  }
  for (const double u : segment.panel_parameters()) {
    if (!(u > last.u)) continue;
    const BoundNode next = node(index, u);
    append_between(last, next, 0);
    last = next;
  }
}

void BoundGrid::append_between(const BoundNode& a, const BoundNode& b, int depth) {
  const double u = a.u + (b.u - a.u) / 2;
  if (depth >= deepest || !(u > a.u && u < b.u)) return append_with_roots(a, b, 0);
  const BoundNode middle = node(a.segment, u);
  if (!too_wide(a, b, widest_turn) && !hides_valley(a, middle, b)) return append_with_roots(a, b, 0);
  append_between(a, middle, depth + 1);
  append_between(middle, b, depth + 1);
}

// A node wherever a component of the tangent changes sign: between nodes every axis then moves one way only.
void BoundGrid::append_with_roots(const BoundNode& a, const BoundNode& b, int axis) {
  for (std::size_t k = static_cast<std::size_t>(axis); k < axes_; ++k) {
    double flo = a.tangent[k], fhi = b.tangent[k], lo = a.u, hi = b.u;
    if (!(flo * fhi < 0) || std::max(std::abs(flo), std::abs(fhi)) < no_direction) continue;
    BoundNode root;
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
    append_with_roots(a, root, static_cast<int>(k) + 1);
    append_with_roots(root, b, static_cast<int>(k) + 1);
    return;
  }
  append(b);
}

void BoundGrid::append(const BoundNode& b) {
  nodes_.push_back(b);
  pulse_.work(contour_.path[b.segment].straight() ? 1 : 8);
  if (nodes_.size() < 2) return;
  cells_.push_back(cell(nodes_[nodes_.size() - 2], nodes_.back()));
}

BoundCell BoundGrid::cell(BoundNode& a, BoundNode& b) const {
  BoundCell c;
  if (a.segment != b.segment) {
    const double angle = angle_between(a.tangent, b.tangent);
    double cap = std::min(a.cap, b.cap);
    const Vec step = b.tangent - a.tangent;
    for (std::size_t k = 0; k < axes_; ++k)
      if (step[k] != 0) cap = std::min(cap, sq(acceleration_[k] * cycle_time_ / step[k]) * give);
    a.cap = b.cap = angle > corner_angle_ ? 0 : cap;
    return c;
  }
  const Segment& segment = contour_.path[a.segment];
  c.length = b.s - a.s;
  if (const double blur = 64 * epsilon * (1 + b.s); c.length <= blur) {
    // Differences over such a cell are rounding: only |d(v²)/ds| ≤ 2 |A| is asked of it.
    double square = 0;
    for (std::size_t k = 0; k < axes_; ++k) square += sq(acceleration_[k]);
    c.slip = 2 * std::sqrt(square) * (c.length + blur);
    return c;
  }
  c.kind = segment.straight() ? BoundCell::Kind::straight : BoundCell::Kind::curved;
  const bool arc = segment.curve().kind() == CurveKind::arc;
  double bend = 0, rounding = 0;
  if (arc)
    bend = sq(c.length) / 12 * circle_factor(static_cast<const Arc&>(segment.curve()).sweep() * (b.u - a.u));
  else if (c.kind == BoundCell::Kind::curved)
    rounding =
        4 * epsilon * (norm(a.position) + norm(b.position) + static_cast<const Rational&>(segment.curve()).extent());
  for (std::size_t k = 0; k < axes_; ++k) {
    double way = 0;
    if (c.kind == BoundCell::Kind::straight)
      way = std::abs(a.tangent[k]) * c.length;
    else if (arc)  // ∫h' ds from both ends without cancellation, exact on circles and helices
      way = std::abs((a.tangent[k] + b.tangent[k]) / 2 * c.length + bend * (a.curvature[k] - b.curvature[k]));
    else
      way = std::abs(b.position[k] - a.position[k]);
    c.way[k] = std::max(0.0, way * (1 - 1e-13) - rounding);
    c.energy[k] = 2 * acceleration_[k] * (way + 1e-13 * c.length + rounding);
  }
  if (c.kind == BoundCell::Kind::straight) return c;
  c.divisible = c.length > 1e4 * rounding;
  // What the components of the tangent may reach in between: beyond their ends by no more than the cell turns.
  const double turn = norm(b.tangent - a.tangent) + (norm(a.curvature) + norm(b.curvature)) / 2 * c.length;
  double fastest = feeds_[a.segment];
  for (std::size_t k = 0; k < axes_; ++k) {
    const double least = std::min(std::abs(a.tangent[k]), std::abs(b.tangent[k])) - turn;
    if (least > no_direction) fastest = std::min(fastest, velocity_[k] / least);
  }
  for (std::size_t k = 0; k < axes_; ++k)
    c.velocity[k] = std::min(velocity_[k], fastest * (std::max(std::abs(a.tangent[k]), std::abs(b.tangent[k])) + turn));
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

void BoundGrid::build(std::size_t first, std::size_t last, bool rest_first, bool rest_last) {
  nodes_.clear(), cells_.clear();
  for (std::size_t i = first; i < last; ++i) append_segment(i);
  if (rest_first) nodes_.front().cap = 0;
  if (rest_last) nodes_.back().cap = 0;
}

void BoundGrid::refine(const std::vector<unsigned char>& marked) {
  Blocks<BoundNode> old;
  Blocks<BoundCell> old_cells;
  old.swap(nodes_), old_cells.swap(cells_);
  nodes_.push_back(old.front());
  for (std::size_t i = 0; i < old_cells.size(); ++i) {
    if (i % 64 == 0) pulse_.work(16);
    BoundNode& b = old[i + 1];
    if (!marked[i] || !old_cells[i].divisible) {
      nodes_.push_back(b);
      cells_.push_back(old_cells[i]);
      continue;
    }
    const double from = old[i].u, width = b.u - from;
    BoundNode last = nodes_.back();
    for (int part = 1; part <= 3; ++part) {
      const double u = from + width * part / 4;
      if (!(u > last.u && u < b.u)) continue;
      const BoundNode next = node(b.segment, u);
      append_with_roots(last, next, 0);
      last = next;
    }
    append(b);
  }
}

}  // namespace bahnwerk::verify
