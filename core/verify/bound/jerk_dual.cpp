#include "core/verify/bound/jerk_dual.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bahnwerk::verify {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// Pieces are halved that lose more than this part of their time, so often at most; through kinematics the cells'
// width costs far more than that.
constexpr double much = 2e-4, kinematic_much = 1e-2;
constexpr int halvings = 8;

/// Returns min over 0 < b ≤ cap of w/√b + G b for w ≥ 0.
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

/// Kahan, Commun. ACM 8 (1965): a sum that does not lose what a piece gives.
struct Sum {
  double now = 0, lost = 0;
  void add(double x) {
    const double term = x - lost, next = now + term;
    lost = (next - now) - term;
    now = next;
  }
};

}  // namespace

template <int N>
DualPiece<N> dual_piece(const BoundGrid<N>& grid, const BoundNode<N>& a, const BoundNode<N>& b, double cap,
                        const typename DualPiece<N>::Row& third) {
  DualPiece<N> p;
  p.segment = a.segment, p.u0 = a.u, p.u1 = b.u;
  p.length = b.s - a.s;
  p.cap = cap;
  p.time = p.length / std::sqrt(cap);
  p.rounding = 128 * epsilon * (1 + b.s) / p.length + 64 * epsilon + a.rounding_error + b.rounding_error;
  p.third = third;
  p.along = infinite;
  // Rounding of a coordinate comes from an origin's sum, or an arc's centre and radius, at either end; other axes have
  // longer formulas.
  const double rounding_factor = (grid.cartesian() ? 4 : 16) * epsilon;
  for (std::size_t k = 0; k < grid.axes(); ++k) {
    p.displacement[k] = b.position[k] - a.position[k];
    p.displacement_error = std::max(
        {p.displacement_error, rounding_factor * std::abs(a.position[k]), rounding_factor * std::abs(b.position[k])});
    p.begin[k] = a.tangent[k], p.end[k] = b.tangent[k];
    p.q2[k] = std::max(std::abs(a.curvature[k]), std::abs(b.curvature[k]));
    const double q2 = p.q2[k] + p.third[k] * p.length;  // |q″_k| anywhere in it
    const double least = std::min(std::abs(p.begin[k]), std::abs(p.end[k])) - q2 * p.length;
    if (least > 1e-3) p.along = std::min(p.along, (grid.acceleration(k) + q2 * cap) / least);
  }
  return p;
}

template <int N>
void JerkDual<N>::enter(std::size_t cell, const RelaxationProblem<N>& problem,
                        const RelaxationMultipliers<N>& multipliers) {
  length_ = problem.cells[cell].length;
  parts_ = splines_on(problem.cells, cell);
  for (std::size_t r = 0; r < 3; ++r) {
    lambda_[r] = multipliers.jerk[cell + r];
    double load = 0;
    for (std::size_t k = 0; k < N; ++k)
      if (lambda_[r][k] != 0) load += problem.jerk[k] * std::abs(lambda_[r][k]);
    weight_[r] = 1 - load;
  }
  mu_ = {multipliers.acceleration[cell], multipliers.acceleration[cell + 1]};
}

template <int N>
typename JerkDual<N>::Value JerkDual<N>::of(const DualPiece<N>& p, double x, const DualPiece<N>* next) const {
  const double y = x + p.length;
  // w is at least a quadratic with these Bernstein coefficients.
  double w0 = 0, w1 = 0, slope = 0;
  for (std::size_t r = 0; r < 3; ++r)
    w0 += weight_[r] * parts_[r].at(x), w1 += weight_[r] * parts_[r].at(y), slope += weight_[r] * parts_[r].slope(x);
  const double middle = w0 + slope * p.length / 2;
  const auto positive = [](double w) { return std::max(0.0, w - 1e-14); };
  const Range w{positive(std::min({w0, w1, middle})), positive(std::max({w0, w1, middle})),
                positive((w0 + w1 + middle) / 3)};
  double integral = 0, size = 0, moved = 0, radius = 0, cost = 0, tangent_jump = 0, next_tangent_jump = 0, loss = 0;
  for (std::size_t k = 0; k < grid_.axes(); ++k) {
    const double rise = (mu_[1][k] - mu_[0][k]) / length_;
    double slope0 = 0, slope1 = 0, second = 0;
    for (std::size_t r = 0; r < 3; ++r) {
      const double l = lambda_[r][k];
      slope0 += l * parts_[r].slope(x), slope1 += l * parts_[r].slope(y), second += l * parts_[r].second;
    }
    const auto lambda = [&](double at) {
      double sum = 0;
      for (std::size_t r = 0; r < 3; ++r) sum += lambda_[r][k] * parts_[r].at(at);
      return sum;
    };
    const double u0 = mu_[0][k] + rise * x, u1 = mu_[0][k] + rise * y;
    const double e0 = u0 - slope0, e1 = u1 - slope1, change = rise - second;
    integral += 0.5 * (e1 * p.end[k] - e0 * p.begin[k]) - change * p.displacement[k];
    size += (std::abs(e0) + std::abs(e1)) * (1 + p.q2[k] * p.length) + std::abs(change) * p.length;
    moved += std::abs(change) * p.displacement_error;
    radius += 0.5 * std::max(std::abs(e0), std::abs(e1)) * p.third[k];
    cost += grid_.acceleration(k) * p.length * (std::abs(u0) + std::abs(u1)) / 2;
    if (p.joint.here) {
      const double l = lambda(x);
      cost += std::abs(l) * p.joint.step[k];
      tangent_jump -= 0.5 * e0 * p.joint.tangent_jump[k] + l * p.joint.acceleration_step[k];
    }
    if (next != nullptr)
      next_tangent_jump -= 0.5 * e1 * next->joint.tangent_jump[k] + lambda(y) * next->joint.acceleration_step[k];
  }
  // The contribution of jumps of q′ and q″ to G lies at the joint. Half of it may be distributed to the pieces on
  // either side, since b cannot change much there: on average by |v̇| times the length.
  const auto spread = [&](double jump, double joint_cap) {
    const double change = p.along * p.length;
    if (change < joint_cap)
      integral += jump / 2, size += std::abs(jump), loss += std::abs(jump) / 2 * change;
    else
      loss += std::max(0.0, -jump) / 2 * joint_cap;
  };
  if (p.joint.here) spread(tangent_jump, p.joint.cap);
  if (next != nullptr) spread(next_tangent_jump, next->joint.cap);
  // G stays within half of what it may change by about its mean.
  const double mean = (integral - p.rounding * size - moved) / p.length, half = radius * p.length / 2;
  const double sure = least_mean(w, {mean - half, mean + half, mean}, p.cap), best = least(w.mean, mean, p.cap);
  return {sure * p.length - cost - loss - 4 * epsilon * (cost + loss + p.time), (best - sure) * p.length + loss};
}

// Halves where that gains. Through kinematics a bound of |q‴| costs more than all the rest: halves of halves take over
// that of what they are part of.
template <int N>
double JerkDual<N>::refined(const DualPiece<N>& p, double x, const DualPiece<N>* next, Value coarse, int depth,
                            Ends ends) {
  if (!(coarse.loss > (grid_.cartesian() ? much : kinematic_much) * p.time) || depth == halvings) return coarse.now;
  const double u = p.u0 + (p.u1 - p.u0) / 2;
  const BoundNode<N> m = grid_.node(p.segment, u), a = ends.first ? *ends.first : grid_.node(p.segment, p.u0),
                     b = ends.second ? *ends.second : grid_.node(p.segment, p.u1);
  if (!(m.s > a.s && b.s > m.s)) return coarse.now;
  progress_.work(8);
  const bool enclosed = grid_.cartesian() || depth == 0;
  DualPiece<N> left = dual_piece(grid_, a, m, p.cap, enclosed ? grid_.third(a, m) : p.third);
  const DualPiece<N> right = dual_piece(grid_, m, b, p.cap, enclosed ? grid_.third(m, b) : p.third);
  left.joint = p.joint;
  const double middle = x + left.length;
  const Value first = of(left, x, nullptr), second = of(right, middle, next);
  if (!(first.now + second.now > coarse.now)) return coarse.now;
  return refined(left, x, nullptr, first, depth + 1, {&a, &m}) +
         refined(right, middle, next, second, depth + 1, {&m, &b});
}

template <int N>
double JerkDual<N>::value(const Blocks<DualPiece<N>>& pieces, std::size_t first, std::size_t last,
                          const std::vector<std::size_t>& cell_of, const RelaxationProblem<N>& problem,
                          const RelaxationMultipliers<N>& multipliers) {
  Sum sum;
  std::size_t cell = problem.cells.size();
  double x = 0;
  for (std::size_t i = first; i < last; ++i) {
    const DualPiece<N>& p = pieces[i];
    if (cell_of[i] != cell) {
      cell = cell_of[i], x = 0;
      enter(cell, problem, multipliers);
    }
    const DualPiece<N>* next = i + 1 < cell_of.size() && pieces[i + 1].joint.here ? &pieces[i + 1] : nullptr;
    sum.add(refined(p, x, next, of(p, x, next), 0, {}));
    x += p.length;
    progress_.work(1);
  }
  return sum.now;
}

template class JerkDual<2>;
template class JerkDual<3>;
template class JerkDual<5>;
template class JerkDual<8>;
template DualPiece<2> dual_piece(const BoundGrid<2>&, const BoundNode<2>&, const BoundNode<2>&, double,
                                 const DualPiece<2>::Row&);
template DualPiece<3> dual_piece(const BoundGrid<3>&, const BoundNode<3>&, const BoundNode<3>&, double,
                                 const DualPiece<3>::Row&);
template DualPiece<5> dual_piece(const BoundGrid<5>&, const BoundNode<5>&, const BoundNode<5>&, double,
                                 const DualPiece<5>::Row&);
template DualPiece<8> dual_piece(const BoundGrid<8>&, const BoundNode<8>&, const BoundNode<8>&, double,
                                 const DualPiece<8>::Row&);

}  // namespace bahnwerk::verify
