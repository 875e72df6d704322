#include "core/motion/relaxation/relaxation.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {
namespace {

constexpr double to_boundary = 0.995;  // part of the longest step that is taken
// Target of the complementarity of a step relative to the present one: what the predictor would leave, near the
// solution its square. It is at least this part of the requested gap, since infeasibility has to fall with it.
constexpr double min_centring = 1e-4, gap_aimed_at = 0.3;
constexpr double near = 0.03;  // gap from which on all places have one step length
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
  matrix_.assign(cells_ + 4, {});
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

// Returns the target of the next step relative to the present complementarity.
template <int N>
double RelaxationSolver<N>::centring(const Promise& promise, bool even) const {
  const double p = parts_.mean()[0], d = parts_.mean()[1],
               left = 1 + (p * promise.change - d * (complementarity_ + promise.change) + p * d * promise.both) /
                              complementarity_;
  return std::max(even ? left * left : left, min_centring);
}

template <int N>
RelaxationOutcome RelaxationSolver<N>::solve(const RelaxationProblem<N>& problem, const RelaxationOptions& options,
                                             ProgressScope& progress) {
  progress_ = &progress;
  take(problem);
  start();
  RelaxationOutcome outcome;
  parts_.begin(splines_.size(), false);
  for (;; ++outcome.iterations) {
    assemble();
    outcome.duration = duration_, outcome.gap = complementarity_ / duration_, outcome.violation = violation_;
    outcome.converged = outcome.gap < options.gap && violation_ < options.violation && dual_residual() < dual_tolerance;
    if (outcome.converged || outcome.iterations == options.iterations) return outcome;
    factor();
    solve_factored();
    const bool even = outcome.gap < near;
    const Promise promise = predict(even);
    parts_.predicted();
    correct(std::max(centring(promise, even) * complementarity_, gap_aimed_at * options.gap * duration_) /
            static_cast<double>(rows_));
    solve_factored();
    follow(even);
    parts_.taken(to_boundary);
    if (!std::isfinite(sum(parts_.mean()))) return outcome;
  }
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
