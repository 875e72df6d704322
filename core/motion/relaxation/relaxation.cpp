#include "core/motion/relaxation/relaxation.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {
namespace {

constexpr double to_boundary = 0.995;           // part of the longest step that is taken
constexpr double most_down = 0.9, most_up = 4;  // of b by one step
constexpr double min_centring = 1e-4;
constexpr double dual_tolerance = 1e-3;
constexpr double never = 1e300;

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
  for (std::vector<double>* v : {&b_, &inverse_cap_, &root_, &step_, &gradient_}) v->assign(cells_, 0);
  matrix_.assign(cells_, {});
  for (std::size_t k = 0; k < N; ++k)
    inverse_jerk_[k] = 1 / problem.jerk[k], inverse_acceleration_[k] = 1 / problem.acceleration[k];
  // Well below the caps, and from rest no faster than a constant jerk.
  double jerk = never, reach = 0, total = 0;
  for (std::size_t k = 0; k < N; ++k) jerk = std::min(jerk, problem.jerk[k]);
  for (const auto& cell : cells) total += cell.length;
  for (std::size_t i = 0; i < cells_; ++i) {
    const double middle = reach + cells[i].length / 2;
    reach += cells[i].length;
    b_[i] = 0.3 * cells[i].cap;
    inverse_cap_[i] = 1 / cells[i].cap;
    const double way = std::min(problem.rest_first ? middle : never, problem.rest_last ? total - middle : never);
    if (way < never && jerk < never) b_[i] = std::min(b_[i], 0.5 * std::pow(4.5 * jerk * way * way, 2.0 / 3));
  }
}

template <int N>
void RelaxationSolver<N>::start() {
  double total = 0;
  for (std::size_t j = 0; j < splines_.size(); ++j) {
    double time = 0, needed = 0;
    Row sum{};
    support(j, [&](std::size_t r, std::size_t i) {
      const WeakCell<N>& c = form_.cells[i];
      time += c.time[r] / std::sqrt(b_[i]);
      for (std::size_t k = 0; k < N; ++k) sum[k] += c.jerk[r][k] * b_[i];
    });
    for (std::size_t k = 0; k < N; ++k) needed = std::max(needed, std::abs(sum[k]));
    splines_[j].T = 1.2 * std::clamp(needed, time, 3 * time);
    total += splines_[j].T;
  }
  evaluate();
  const double mu = 0.1 * total / static_cast<double>(rows_);
  for (Spline& s : splines_) {
    const auto begin = [&](Inequality& i) {
      i.slack = std::max(-i.value, 0.1 * s.T);
      i.multiplier = 1.0 / (1 + 2 * N);
    };
    begin(s.time);
    for (std::size_t k = 0; k < N; ++k) begin(s.plus[k]), begin(s.minus[k]);
  }
  const auto begin = [&](Inequality& i) {
    i.slack = std::max(-i.value, 0.1);
    i.multiplier = mu / i.slack;
  };
  for (Hat& h : hats_)
    for (std::size_t k = 0; k < N; ++k) begin(h.plus[k]), begin(h.minus[k]);
  for (Inequality& c : caps_) begin(c);
}

// Values of all inequalities.
template <int N>
void RelaxationSolver<N>::evaluate() {
  for (std::size_t i = 0; i < cells_; ++i) {
    root_[i] = 1 / std::sqrt(b_[i]);
    caps_[i].value = b_[i] * inverse_cap_[i] - 1;
  }
  duration_ = 0;
  for (std::size_t j = 0; j < splines_.size(); ++j) {
    Spline& s = splines_[j];
    double time = 0;
    Row sum{};
    support(j, [&](std::size_t r, std::size_t i) {
      const WeakCell<N>& c = form_.cells[i];
      time += c.time[r] * root_[i];
      for (std::size_t k = 0; k < N; ++k) sum[k] += c.jerk[r][k] * b_[i];
    });
    s.time.value = time - s.T;
    for (std::size_t k = 0; k < N; ++k) {
      const double most = s.T + form_.allowed[j][k];
      s.plus[k].value = sum[k] - most, s.minus[k].value = -sum[k] - most;
    }
    duration_ += s.T;
  }
  for (std::size_t i = 0; i <= cells_; ++i)
    for (std::size_t k = 0; k < N; ++k) {
      double sum = 0;
      if (i > 0) sum += form_.cells[i - 1].acceleration[1][k] * b_[i - 1];
      if (i < cells_) sum += form_.cells[i].acceleration[0][k] * b_[i];
      hats_[i].plus[k].value = sum - 1, hats_[i].minus[k].value = -sum - 1;
    }
}

// The Newton matrix by relative changes of b, each T_j eliminated, and the Lagrangian's gradient.
template <int N>
void RelaxationSolver<N>::assemble() {
  complementarity_ = violation_ = dual_ = 0;
  for (std::size_t i = 0; i < cells_; ++i) {
    const double e = b_[i] * inverse_cap_[i];
    gradient_[i] = caps_[i].multiplier * e;
    matrix_[i] = {caps_[i].weight() * e * e, 0, 0};
    violation_ = std::max(violation_, std::abs(caps_[i].residual()));
    complementarity_ += caps_[i].slack * caps_[i].multiplier;
  }
  for (std::size_t i = 0; i <= cells_; ++i)
    for (std::size_t k = 0; k < N; ++k) {
      const Inequality &plus = hats_[i].plus[k], &minus = hats_[i].minus[k];
      violation_ = std::max({violation_, std::abs(plus.residual()), std::abs(minus.residual())});
      complementarity_ += plus.slack * plus.multiplier + minus.slack * minus.multiplier;
      const double z = plus.multiplier - minus.multiplier, w = plus.weight() + minus.weight();
      const double left = i > 0 ? form_.cells[i - 1].acceleration[1][k] * b_[i - 1] : 0;
      const double right = i < cells_ ? form_.cells[i].acceleration[0][k] * b_[i] : 0;
      if (i > 0) gradient_[i - 1] += z * left, matrix_[i - 1][0] += w * left * left;
      if (i < cells_) gradient_[i] += z * right, matrix_[i][0] += w * right * right;
      if (i > 0 && i < cells_) matrix_[i - 1][1] += w * left * right;
    }
  for (std::size_t j = 0; j < splines_.size(); ++j) {
    Spline& s = splines_[j];
    complementarity_ += s.time.slack * s.time.multiplier;
    double gradient = 1 - s.time.multiplier, worst = std::abs(s.time.residual());
    std::array<std::array<double, 3>, 3> block{};
    std::array<double, 3> e{}, coupling{};
    std::array<Row, 3> f{};
    const double w0 = s.time.weight();
    s.curvature = w0;
    support(j, [&](std::size_t r, std::size_t i) {
      const WeakCell<N>& c = form_.cells[i];
      const double time = c.time[r] * root_[i];
      e[r] = -0.5 * time;
      gradient_[i] += s.time.multiplier * e[r];
      matrix_[i][0] += s.time.multiplier * 0.75 * time;
      for (std::size_t k = 0; k < N; ++k) {
        f[r][k] = c.jerk[r][k] * b_[i];
        gradient_[i] += (s.plus[k].multiplier - s.minus[k].multiplier) * f[r][k];
      }
    });
    for (std::size_t r = 0; r < 3; ++r) {
      coupling[r] = -w0 * e[r];
      for (std::size_t q = 0; q <= r; ++q) block[r][q] = w0 * e[r] * e[q];
    }
    for (std::size_t k = 0; k < N; ++k) {
      gradient -= s.plus[k].multiplier + s.minus[k].multiplier;
      worst = std::max({worst, std::abs(s.plus[k].residual()), std::abs(s.minus[k].residual())});
      complementarity_ += s.plus[k].slack * s.plus[k].multiplier + s.minus[k].slack * s.minus[k].multiplier;
      const double plus = s.plus[k].weight(), minus = s.minus[k].weight();
      s.curvature += plus + minus;
      for (std::size_t r = 0; r < 3; ++r) {
        coupling[r] -= (plus - minus) * f[r][k];
        for (std::size_t q = 0; q <= r; ++q) block[r][q] += (plus + minus) * f[r][k] * f[q][k];
      }
    }
    violation_ = std::max(violation_, worst / s.T);
    dual_ = std::max(dual_, std::abs(gradient));
    s.gradient = gradient, s.coupling = coupling;
    // Place r of the support is cell j − r: the later the place, the earlier the cell.
    support(j, [&](std::size_t r, std::size_t i) {
      for (std::size_t q = 0; q <= r; ++q)
        if (j - q < cells_) matrix_[i][r - q] += block[r][q] - coupling[r] * coupling[q] / s.curvature;
    });
    pulse_->work(1);
  }
  for (const double g : gradient_) dual_ = std::max(dual_, std::abs(g) / duration_);
}

// L D Lᵀ of five diagonals.
template <int N>
void RelaxationSolver<N>::factor() {
  for (std::size_t i = 0; i < cells_; ++i) {
    auto [d, next, second] = matrix_[i];
    if (i > 0) {
      const auto& [d1, l1, l2] = matrix_[i - 1];
      d -= l1 * l1 * d1, next -= l1 * l2 * d1;
    }
    if (i > 1) d -= matrix_[i - 2][2] * matrix_[i - 2][2] * matrix_[i - 2][0];
    if (!(d > 0)) d = never;  // rounding only: this b stays as it is
    matrix_[i] = {d, next / d, second / d};
  }
}

// The step towards complementarity `target` in every inequality; `correct`: with the product of the last step's.
template <int N>
void RelaxationSolver<N>::direction(double target, bool correct) {
  const auto pull = [&](const Inequality& i) {
    const double product = correct ? i.slack_step * i.multiplier_step : 0;
    return (target - product + i.multiplier * i.residual()) / i.slack - i.multiplier;
  };
  for (std::size_t i = 0; i < cells_; ++i) step_[i] = -gradient_[i] - b_[i] * inverse_cap_[i] * pull(caps_[i]);
  for (std::size_t i = 0; i <= cells_; ++i)
    for (std::size_t k = 0; k < N; ++k) {
      const double p = pull(hats_[i].plus[k]) - pull(hats_[i].minus[k]);
      if (i > 0) step_[i - 1] -= p * form_.cells[i - 1].acceleration[1][k] * b_[i - 1];
      if (i < cells_) step_[i] -= p * form_.cells[i].acceleration[0][k] * b_[i];
    }
  for (std::size_t j = 0; j < splines_.size(); ++j) {
    Spline& s = splines_[j];
    const double time = pull(s.time);
    Row p;
    s.rest = time - s.gradient;
    for (std::size_t k = 0; k < N; ++k) {
      const double plus = pull(s.plus[k]), minus = pull(s.minus[k]);
      s.rest += plus + minus;
      p[k] = plus - minus;
    }
    const double share = s.rest / s.curvature;
    support(j, [&](std::size_t r, std::size_t i) {
      const WeakCell<N>& c = form_.cells[i];
      double sum = -0.5 * c.time[r] * root_[i] * time + s.coupling[r] * share;
      for (std::size_t k = 0; k < N; ++k) sum += p[k] * c.jerk[r][k] * b_[i];
      step_[i] -= sum;
    });
    pulse_->work(1);
  }
  for (std::size_t i = 0; i < cells_; ++i) {
    if (i > 0) step_[i] -= matrix_[i - 1][1] * step_[i - 1];
    if (i > 1) step_[i] -= matrix_[i - 2][2] * step_[i - 2];
  }
  for (std::size_t i = cells_; i-- > 0;) {
    step_[i] /= matrix_[i][0];
    if (i + 1 < cells_) step_[i] -= matrix_[i][1] * step_[i + 1];
    if (i + 2 < cells_) step_[i] -= matrix_[i][2] * step_[i + 2];
  }
  Reach reach;
  const auto follow = [&](Inequality& i, double change) {
    const double product = correct ? i.slack_step * i.multiplier_step : 0;
    i.slack_step = -i.residual() - change;
    i.multiplier_step = (target - product - i.multiplier * i.slack_step) / i.slack - i.multiplier;
    if (i.slack + reach.primal * i.slack_step < 0) reach.primal = -i.slack / i.slack_step;
    if (i.multiplier + reach.dual * i.multiplier_step < 0) reach.dual = -i.multiplier / i.multiplier_step;
    reach.dual_change += i.slack * i.multiplier_step;
    reach.primal_change += i.multiplier * i.slack_step;
    reach.both += i.slack_step * i.multiplier_step;
  };
  for (std::size_t i = 0; i < cells_; ++i) follow(caps_[i], step_[i] * b_[i] * inverse_cap_[i]);
  for (std::size_t i = 0; i <= cells_; ++i)
    for (std::size_t k = 0; k < N; ++k) {
      double sum = 0;
      if (i > 0) sum += form_.cells[i - 1].acceleration[1][k] * b_[i - 1] * step_[i - 1];
      if (i < cells_) sum += form_.cells[i].acceleration[0][k] * b_[i] * step_[i];
      follow(hats_[i].plus[k], sum), follow(hats_[i].minus[k], -sum);
    }
  for (std::size_t j = 0; j < splines_.size(); ++j) {
    Spline& s = splines_[j];
    double time = 0, T = s.rest;
    Row sum{};
    support(j, [&](std::size_t r, std::size_t i) {
      const WeakCell<N>& c = form_.cells[i];
      T -= s.coupling[r] * step_[i];
      time -= 0.5 * c.time[r] * root_[i] * step_[i];
      for (std::size_t k = 0; k < N; ++k) sum[k] += c.jerk[r][k] * b_[i] * step_[i];
    });
    s.step = T / s.curvature;
    follow(s.time, time - s.step);
    for (std::size_t k = 0; k < N; ++k) follow(s.plus[k], sum[k] - s.step), follow(s.minus[k], -sum[k] - s.step);
    pulse_->work(1);
  }
  reach_ = reach;
}

template <int N>
void RelaxationSolver<N>::advance(double primal, double dual) {
  for (std::size_t i = 0; i < cells_; ++i) b_[i] *= 1 + primal * step_[i];
  const auto move = [&](Inequality& i) { i.slack += primal * i.slack_step, i.multiplier += dual * i.multiplier_step; };
  for (Spline& s : splines_) {
    s.T += primal * s.step;
    move(s.time);
    for (std::size_t k = 0; k < N; ++k) move(s.plus[k]), move(s.minus[k]);
  }
  for (Hat& h : hats_)
    for (std::size_t k = 0; k < N; ++k) move(h.plus[k]), move(h.minus[k]);
  for (Inequality& c : caps_) move(c);
}

template <int N>
RelaxationOutcome RelaxationSolver<N>::solve(const RelaxationProblem<N>& problem, const RelaxationOptions& options,
                                             ProgressScope& pulse) {
  pulse_ = &pulse;
  take(problem);
  start();
  RelaxationOutcome outcome;
  for (;; ++outcome.iterations) {
    assemble();
    outcome.duration = duration_, outcome.gap = complementarity_ / duration_, outcome.violation = violation_;
    outcome.converged = outcome.gap < options.gap && violation_ < options.violation && dual_ < dual_tolerance;
    if (outcome.converged || outcome.iterations == options.iterations) return outcome;
    factor();
    direction(0, false);
    const double now = complementarity_ / static_cast<double>(rows_);
    const double left = 1 + (reach_.primal * reach_.primal_change + reach_.dual * reach_.dual_change +
                             reach_.primal * reach_.dual * reach_.both) /
                                complementarity_;
    direction(std::max(left * left * left, min_centring) * now, true);
    double primal = std::min(1.0, to_boundary * reach_.primal);
    const double dual = std::min(1.0, to_boundary * reach_.dual);
    for (const double s : step_) {
      if (s < -most_down) primal = std::min(primal, most_down / -s);
      if (s > most_up) primal = std::min(primal, most_up / s);
    }
    if (!std::isfinite(primal) || !std::isfinite(dual)) return outcome;
    advance(primal, dual);
    evaluate();
  }
}

template <int N>
RelaxationMultipliers<N> RelaxationSolver<N>::multipliers() const {
  RelaxationMultipliers<N> m;
  m.jerk.resize(splines_.size()), m.acceleration.resize(hats_.size());
  for (std::size_t j = 0; j < splines_.size(); ++j) {
    double sum = 0;
    for (std::size_t k = 0; k < N; ++k) {
      const double z = splines_[j].plus[k].multiplier - splines_[j].minus[k].multiplier;
      sum += std::abs(z);
      m.jerk[j][k] = z * inverse_jerk_[k];
    }
    if (sum > 1)
      for (double& z : m.jerk[j]) z /= sum;
  }
  for (std::size_t i = 0; i < hats_.size(); ++i)
    for (std::size_t k = 0; k < N; ++k)
      m.acceleration[i][k] =
          (hats_[i].plus[k].multiplier - hats_[i].minus[k].multiplier) * inverse_acceleration_[k] / form_.mass[i];
  return m;
}

template class RelaxationSolver<2>;
template class RelaxationSolver<3>;
template class RelaxationSolver<5>;
template class RelaxationSolver<8>;

}  // namespace bahnwerk
