#include "core/motion/relaxation/relaxation.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/relaxation/newton.ipp"

namespace bahnwerk {
namespace {

constexpr double dual_tolerance = 1e-3;
constexpr double never = 1e300;
constexpr double first_cap = 0.3,
                 first_slope = 0.8;  // parts of the caps and of the steepest b with which the search begins

}  // namespace

template <int N>
void RelaxationSolver<N>::take(const RelaxationProblem<N>& problem) {
  const auto& cells = problem.cells;
  cells_ = cells.size();
  rows_ = (cells_ + 2) * (1 + 2 * N) + (cells_ + 1) * 2 * N + cells_;
  form_.take(problem);
  splines_.assign(cells_ + 2, {});
  hats_.assign(cells_ + 1, {});
  caps_.assign(cells_, {});
  for (std::vector<double>* v : {&b_, &root_}) v->assign(cells_ + 4, 1);
  for (std::vector<double>* v : {&inverse_cap_, &step_}) v->assign(cells_ + 4, 0);
  for (std::size_t k = 0; k < N; ++k)
    inverse_jerk_[k] = 1 / problem.jerk[k], inverse_acceleration_[k] = 1 / problem.acceleration[k];
  // The start is well below the caps, rises and falls by a part of what accelerations allow, and leaves rest no faster
  // than by a constant jerk.
  double reach = 0, total = 0;
  for (const auto& cell : cells) total += cell.length;
  std::vector<double>& rise = step_;  // rise of b in each cell
  for (std::size_t i = 0; i < cells_; ++i) {
    const RelaxationCell<N>& cell = cells[i];
    const double middle = reach + cell.length / 2;
    reach += cell.length;
    double& b = b_[i + 2];
    b = first_cap * cell.cap;
    inverse_cap_[i + 2] = 1 / cell.cap;
    const double way = std::min(problem.rest_first ? middle : never, problem.rest_last ? total - middle : never);
    double jerk = never, acceleration = never;  // limits along the path
    for (std::size_t k = 0; k < N; ++k)
      if (const double rate = std::max(std::abs(cell.begin[k]), std::abs(cell.end[k])); rate > 0)
        jerk = std::min(jerk, problem.jerk[k] / rate),
        acceleration = std::min(acceleration, problem.acceleration[k] / rate);
    rise[i + 2] = acceleration < never ? first_slope * acceleration * cell.length : never;
    if (!(way < never)) continue;
    if (acceleration < never) b = std::min(b, acceleration * way);
    if (jerk < never) b = std::min(b, 0.5 * std::pow(4.5 * jerk * way * way, 2.0 / 3));
  }
  for (std::size_t a = 3; a < cells_ + 2; ++a) b_[a] = std::min(b_[a], b_[a - 1] + rise[a - 1] + rise[a]);
  for (std::size_t a = cells_ + 1; a-- > 2;) b_[a] = std::min(b_[a], b_[a + 1] + rise[a + 1] + rise[a]);
}

template <int N>
void RelaxationSolver<N>::start() {
  double total = 0;
  for (std::size_t j = 0; j < splines_.size(); ++j) {
    Spline& s = splines_[j];
    double time = 0, needed = 0;
    Row sum{};
    for (std::size_t r = 0; r < 3; ++r) {
      const std::size_t a = j + 2 - r;
      const WeakCell<N>& c = form_.cells[a];
      time += c.time[r] / std::sqrt(b_[a]);
      for (std::size_t k = 0; k < N; ++k) sum[k] += c.jerk[r][k] * b_[a];
    }
    for (std::size_t k = 0; k < N; ++k) needed = std::max(needed, std::abs(sum[k]));
    s.T = 1.2 * std::clamp(needed, time, 3 * time);
    total += s.T;
    const double least = 0.1 * s.T, multiplier = 1.0 / (1 + 2 * N);
    s.time.slack = std::max(s.T - time, least), s.time.multiplier = multiplier;
    for (std::size_t k = 0; k < N; ++k) {
      const double most = s.T + form_.allowed[j][k];
      const Sides value = Sides{sum[k], -sum[k]} - most;
      Inequality<Sides>& q = s.jerk[k];
      q.slack = larger(-value, Sides{least, least}), q.multiplier = Sides{multiplier, multiplier};
      q.residual = value + q.slack;
    }
  }
  constexpr double least = 0.1;
  const double mu = total / static_cast<double>(rows_);
  for (std::size_t i = 0; i < hats_.size(); ++i)
    for (std::size_t k = 0; k < N; ++k) {
      const Sides value = hat_value(i, k);
      Inequality<Sides>& q = hats_[i][k];
      q.slack = larger(-value, Sides{least, least}), q.multiplier = mu / q.slack, q.residual = value + q.slack;
    }
  for (std::size_t i = 0; i < cells_; ++i) {
    const double value = b_[i + 2] * inverse_cap_[i + 2] - 1;
    caps_[i].slack = std::max(-value, least), caps_[i].multiplier = mu / caps_[i].slack;
    caps_[i].residual = value + caps_[i].slack;
  }
}

// ± acceleration less its limit, in parts of A_k.
template <int N>
typename RelaxationSolver<N>::Sides RelaxationSolver<N>::hat_value(std::size_t node, std::size_t k) const {
  const double sum =
      form_.cells[node + 1].acceleration[1][k] * b_[node + 1] + form_.cells[node + 2].acceleration[0][k] * b_[node + 2];
  return Sides{sum, -sum} - 1.0;
}

template <int N>
InteriorPointFigures RelaxationSolver<N>::evaluate(double /*mu*/) {
  assemble();
  return {duration_, complementarity_, static_cast<double>(rows_), violation_};
}

template <int N>
bool RelaxationSolver<N>::factor() {
  matrix_.factor();
  return true;
}

template <int N>
std::optional<double> RelaxationSolver<N>::predict() {
  solve_factored();
  const Promise promise = affine();
  const double p = step_length(reach_[0], 1), d = step_length(reach_[1], 1);
  product_ = std::sqrt(p * d);
  return 1 + (p * promise.change - d * (complementarity_ + promise.change) + p * d * promise.both) / complementarity_;
}

template <int N>
StepLengths RelaxationSolver<N>::step(double mu) {
  correct(mu, product_);
  solve_factored();
  follow();
  return taken_ = {step_length(reach_[0]), step_length(reach_[1])};
}

template <int N>
RelaxationOutcome RelaxationSolver<N>::solve(const RelaxationProblem<N>& problem, const RelaxationOptions& options,
                                             ProgressScope& progress) {
  progress_ = &progress;
  take(problem);
  start();
  taken_ = {0, 0};
  InteriorPointRule rule;
  rule.gap = options.gap, rule.primal_residual = options.violation, rule.dual_residual = dual_tolerance;
  rule.max_iterations = options.iterations;
  const InteriorPointResult result = run_interior_point(*this, rule);
  return {result.iterations, duration_, result.gap, result.primal_residual, result.converged};
}

template <int N>
RelaxationMultipliers<N> RelaxationSolver<N>::multipliers() const {
  RelaxationMultipliers<N> m;
  m.jerk.resize(splines_.size()), m.acceleration.resize(hats_.size());
  for (std::size_t j = 0; j < splines_.size(); ++j) {
    double sum = 0;
    for (std::size_t k = 0; k < N; ++k) {
      const double z = splines_[j].jerk[k].multiplier[0] - splines_[j].jerk[k].multiplier[1];
      sum += std::abs(z);
      m.jerk[j][k] = z * inverse_jerk_[k];
    }
    if (sum > 1)
      for (double& z : m.jerk[j]) z /= sum;
  }
  for (std::size_t i = 0; i < hats_.size(); ++i)
    for (std::size_t k = 0; k < N; ++k)
      m.acceleration[i][k] =
          (hats_[i][k].multiplier[0] - hats_[i][k].multiplier[1]) * inverse_acceleration_[k] / form_.mass[i];
  return m;
}

template class RelaxationSolver<2>;
template class RelaxationSolver<3>;
template class RelaxationSolver<5>;
template class RelaxationSolver<8>;

}  // namespace bahnwerk
