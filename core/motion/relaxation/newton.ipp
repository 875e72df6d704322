#pragma once
/// The sweeps of a step of the relaxation over the splines, with the hats beside them.
#include <algorithm>
#include <cmath>

#include "core/motion/relaxation/relaxation.hpp"

namespace bahnwerk {
namespace {

using Sides = Lanes<2>;

constexpr double most_down = 0.9, most_up = 4;  // largest relative change of b in one step

Sides both(double x) { return Sides{x, -x}; }

Sides farthest(double primal, double dual) { return Sides{primal, dual}; }
Sides farthest(Sides primal, Sides dual) { return larger(Sides{primal[0], dual[0]}, Sides{primal[1], dual[1]}); }

/// Sums over the steps of inequalities, and their largest step lengths at a place.
template <class V>
struct Steps {
  V primal{}, dual{}, change{}, product{};

  void predicted(const Inequality<V>& i, V change_of_value) {
    const V step = -(i.residual + change_of_value), part = i.inverse * step;
    // The multiplier's step is −multiplier (1 + part).
    primal = larger(primal, -part), dual = larger(dual, 1.0 + part);
    change = change + i.multiplier * step, product = product + i.pending;
  }
  void followed(const Inequality<V>& i) {
    primal = larger(primal, -(i.pending * i.inverse)), dual = larger(dual, -(i.multiplier_step / i.multiplier));
  }
  /// Returns the reach of slacks and of multipliers.
  Sides reach() const { return farthest(primal, dual); }
};

}  // namespace

// Returns the change of hat_value() for relative changes of b before and after the node.
template <int N>
typename RelaxationSolver<N>::Sides RelaxationSolver<N>::hat_change(std::size_t node, std::size_t k, double before,
                                                                    double after) const {
  return both(form_.cells[node + 1].acceleration[1][k] * (b_[node + 1] * before) +
              form_.cells[node + 2].acceleration[0][k] * (b_[node + 2] * after));
}

// The limits of acceleration at node j: takes their last step, and adds them to the system of b before and after it.
template <int N>
void RelaxationSolver<N>::assemble_hat(std::size_t j, Sides& products, Sides& worst) {
  const WeakCell<N>&before = form_.cells[j + 1], &after = form_.cells[j + 2];
  const auto take = [&](Inequality<Sides>& q, Sides value) {
    q.advance(taken_.primal, taken_.dual), q.residual = value + q.slack;
    products = products + q.slack * q.multiplier, worst = larger(worst, magnitude(q.residual));
    return q.weight();
  };
  double d11 = 0, d10 = 0, d00 = 0, g1 = 0, g0 = 0;
  for (std::size_t k = 0; k < N; ++k) {
    Inequality<Sides>& q = hats_[j][k];
    const double f1 = before.acceleration[1][k] * b_[j + 1], f0 = after.acceleration[0][k] * b_[j + 2];
    const Sides w = take(q, both(f1 + f0) - 1.0), h = w * q.residual;
    const double weight = w[0] + w[1], pull = h[0] - h[1];
    d11 += weight * f1 * f1, d10 += weight * f1 * f0, d00 += weight * f0 * f0;
    g1 += pull * f1, g0 += pull * f0;
  }
  matrix_.at(j + 1, j + 1) += d11, matrix_.at(j + 2, j + 1) += d10, matrix_.at(j + 2, j + 2) += d00;
  step_[j + 1] -= g1, step_[j + 2] -= g0;
}

// Takes the last step, and poses the Newton system by relative changes of b, each T_j eliminated, with the right-hand
// side of the predictor.
template <int N>
void RelaxationSolver<N>::assemble() {
  double complementarity = 0, violation = 0;
  Sides products{}, worst_hat{};
  duration_ = 0;
  matrix_.reset(cells_ + 4);
  for (const std::size_t a : {std::size_t{0}, std::size_t{1}, cells_ + 2, cells_ + 3}) matrix_.at(a, a) = 1;
  for (std::size_t i = 0; i < cells_; ++i) {
    const std::size_t a = i + 2;
    b_[a] *= 1 + taken_.primal * step_[a];
    root_[a] = 1 / std::sqrt(b_[a]);
    Inequality<double>& c = caps_[i];
    c.advance(taken_.primal, taken_.dual);
    const double e = b_[a] * inverse_cap_[a], w = c.weight();
    c.residual = e - 1 + c.slack;
    matrix_.at(a, a) = w * e * e, step_[a] = -w * c.residual * e;
    complementarity += c.slack * c.multiplier;
    violation = std::max(violation, std::abs(c.residual));
  }
  for (std::size_t j = 0; j < splines_.size(); ++j) {
    const std::array<const WeakCell<N>*, 3> c{&form_.cells[j + 2], &form_.cells[j + 1], &form_.cells[j]};
    const std::array<double, 3> b{b_[j + 2], b_[j + 1], b_[j]};
    if (j < hats_.size()) assemble_hat(j, products, worst_hat);
    Spline& s = splines_[j];
    s.T += taken_.primal * s.step;
    duration_ += s.T;
    s.time.advance(taken_.primal, taken_.dual);
    std::array<double, 3> e, pull{}, coupling{};
    std::array<double, 6> block{};  // entries at 00, 10, 11, 20, 21, 22
    double value = -s.T;
    for (std::size_t r = 0; r < 3; ++r) {
      const double time = c[r]->time[r] * root_[j + 2 - r];
      value += time, e[r] = -0.5 * time;
      matrix_.at(j + 2 - r, j + 2 - r) += s.time.multiplier * 0.75 * time;
    }
    s.time.residual = value + s.time.slack;
    const double w0 = s.time.weight(), h0 = w0 * s.time.residual;
    Sides worst{std::abs(s.time.residual), 0}, curvature{w0, 0}, rest{h0 - 1, 0};
    complementarity += s.time.slack * s.time.multiplier;
    for (std::size_t k = 0; k < N; ++k) {
      Inequality<Sides>& q = s.jerk[k];
      const double f0 = c[0]->jerk[0][k], f1 = c[1]->jerk[1][k], f2 = c[2]->jerk[2][k];
      q.advance(taken_.primal, taken_.dual);
      q.residual = both(f0 * b[0] + f1 * b[1] + f2 * b[2]) - (s.T + form_.allowed[j][k]) + q.slack;
      const Sides w = q.weight(), h = w * q.residual;
      products = products + q.slack * q.multiplier, worst = larger(worst, magnitude(q.residual));
      curvature = curvature + w, rest = rest + h;
      const double weight = w[0] + w[1], slant = w[0] - w[1], h1 = h[0] - h[1], g0 = weight * f0, g1 = weight * f1,
                   g2 = weight * f2;
      block[0] += g0 * f0, block[1] += g1 * f0, block[2] += g1 * f1;
      block[3] += g2 * f0, block[4] += g2 * f1, block[5] += g2 * f2;
      coupling[0] += slant * f0, coupling[1] += slant * f1, coupling[2] += slant * f2;
      pull[0] += h1 * f0, pull[1] += h1 * f1, pull[2] += h1 * f2;
    }
    violation = std::max(violation, largest(worst) / s.T);
    s.inverse_curvature = 1 / sum(curvature), s.rest = sum(rest);
    for (std::size_t r = 0; r < 3; ++r) s.coupling[r] = -w0 * e[r] - coupling[r] * b[r];
    const double share = s.rest * s.inverse_curvature;
    for (std::size_t r = 0, p = 0; r < 3; ++r) {
      const double half = s.coupling[r] * s.inverse_curvature;
      for (std::size_t q = 0; q <= r; ++q, ++p)
        matrix_.at(j + 2 - q, j + 2 - r) += w0 * e[r] * e[q] + block[p] * b[r] * b[q] - half * s.coupling[q];
      step_[j + 2 - r] -= h0 * e[r] + pull[r] * b[r] + s.coupling[r] * share;
    }
    progress_->work(1);
  }
  complementarity_ = complementarity + sum(products);
  violation_ = std::max(violation, largest(worst_hat));
}

template <int N>
void RelaxationSolver<N>::solve_factored() {
  step_[0] = step_[1] = step_[cells_ + 2] = step_[cells_ + 3] = 0;
  matrix_.solve(step_);
}

// Effect of the predictor's step on every inequality.
template <int N>
typename RelaxationSolver<N>::Promise RelaxationSolver<N>::affine() {
  Steps<double> one;
  Steps<Sides> two;
  for (std::size_t i = 0; i < cells_; ++i) {
    const double change = step_[i + 2] * b_[i + 2] * inverse_cap_[i + 2];
    caps_[i].predict(change), one.predicted(caps_[i], change);
  }
  for (std::size_t j = 0; j < splines_.size(); ++j) {
    const std::array<const WeakCell<N>*, 3> c{&form_.cells[j + 2], &form_.cells[j + 1], &form_.cells[j]};
    const std::array<double, 3> step{step_[j + 2], step_[j + 1], step_[j]},
        moved{b_[j + 2] * step[0], b_[j + 1] * step[1], b_[j] * step[2]};
    if (j < hats_.size())
      for (std::size_t k = 0; k < N; ++k) {
        const Sides change = hat_change(j, k, step[1], step[0]);
        hats_[j][k].predict(change), two.predicted(hats_[j][k], change);
      }
    Spline& s = splines_[j];
    double T = s.rest, time = 0;
    for (std::size_t r = 0; r < 3; ++r)
      T -= s.coupling[r] * step[r], time -= 0.5 * c[r]->time[r] * root_[j + 2 - r] * step[r];
    T *= s.inverse_curvature;
    s.time.predict(time - T), one.predicted(s.time, time - T);
    for (std::size_t k = 0; k < N; ++k) {
      const Sides change =
          both(c[0]->jerk[0][k] * moved[0] + c[1]->jerk[1][k] * moved[1] + c[2]->jerk[2][k] * moved[2]) - T;
      s.jerk[k].predict(change), two.predicted(s.jerk[k], change);
    }
    progress_->work(1);
  }
  reach_ = larger(one.reach(), two.reach());
  return {one.change + sum(two.change), one.product + sum(two.product)};
}

// The right-hand side of the step towards complementarity `target`, with the product of the predictor's steps, less of
// it where less of them could be taken.
template <int N>
void RelaxationSolver<N>::correct(double target, double part) {
  for (std::size_t i = 0; i < cells_; ++i) {
    caps_[i].pending = caps_[i].aim(target, part);
    step_[i + 2] = -b_[i + 2] * inverse_cap_[i + 2] * caps_[i].pending;
  }
  for (std::size_t j = 0; j < splines_.size(); ++j) {
    const std::array<const WeakCell<N>*, 3> c{&form_.cells[j + 2], &form_.cells[j + 1], &form_.cells[j]};
    if (j < hats_.size()) {
      Sides g0{}, g1{};
      for (std::size_t k = 0; k < N; ++k) {
        const Sides h = hats_[j][k].pending = hats_[j][k].aim(target, part);
        g1 = g1 + c[1]->acceleration[1][k] * h, g0 = g0 + c[0]->acceleration[0][k] * h;
      }
      step_[j + 1] -= (g1[0] - g1[1]) * b_[j + 1], step_[j + 2] -= (g0[0] - g0[1]) * b_[j + 2];
    }
    Spline& s = splines_[j];
    const double h0 = s.time.pending = s.time.aim(target, part);
    Sides rest{h0 - 1, 0};
    std::array<double, 3> pull{};
    for (std::size_t k = 0; k < N; ++k) {
      const Sides h = s.jerk[k].aim(target, part);
      s.jerk[k].pending = h, rest = rest + h;
      const double h1 = h[0] - h[1];
      for (std::size_t r = 0; r < 3; ++r) pull[r] += h1 * c[r]->jerk[r][k];
    }
    s.rest = sum(rest);
    const double share = s.rest * s.inverse_curvature;
    for (std::size_t r = 0; r < 3; ++r) {
      const std::size_t a = j + 2 - r;
      step_[a] -= pull[r] * b_[a] - 0.5 * h0 * c[r]->time[r] * root_[a] + s.coupling[r] * share;
    }
    progress_->work(1);
  }
}

template <int N>
void RelaxationSolver<N>::follow() {
  Steps<double> one;
  Steps<Sides> two;
  for (std::size_t i = 0; i < cells_; ++i) {
    const double step = step_[i + 2];
    caps_[i].follow(step * b_[i + 2] * inverse_cap_[i + 2]), one.followed(caps_[i]);
    one.primal = std::max({one.primal, -step / most_down, step / most_up});
  }
  for (std::size_t j = 0; j < splines_.size(); ++j) {
    const std::array<const WeakCell<N>*, 3> c{&form_.cells[j + 2], &form_.cells[j + 1], &form_.cells[j]};
    const std::array<double, 3> step{step_[j + 2], step_[j + 1], step_[j]},
        moved{b_[j + 2] * step[0], b_[j + 1] * step[1], b_[j] * step[2]};
    if (j < hats_.size())
      for (std::size_t k = 0; k < N; ++k) {
        hats_[j][k].follow(hat_change(j, k, step[1], step[0]));
        two.followed(hats_[j][k]);
      }
    Spline& s = splines_[j];
    double T = s.rest, time = 0;
    for (std::size_t r = 0; r < 3; ++r)
      T -= s.coupling[r] * step[r], time -= 0.5 * c[r]->time[r] * root_[j + 2 - r] * step[r];
    T *= s.inverse_curvature;
    s.step = T;
    s.time.follow(time - T), one.followed(s.time);
    for (std::size_t k = 0; k < N; ++k) {
      s.jerk[k].follow(both(c[0]->jerk[0][k] * moved[0] + c[1]->jerk[1][k] * moved[1] + c[2]->jerk[2][k] * moved[2]) -
                       T);
      two.followed(s.jerk[k]);
    }
    progress_->work(1);
  }
  reach_ = larger(one.reach(), two.reach());
}

// Bound of the effect of the Lagrangian's gradient on the duration, by relative changes of every T and every b.
template <int N>
double RelaxationSolver<N>::dual_residual() {
  std::vector<double> gradient(b_.size(), 0);
  double residual = 0;
  for (std::size_t i = 0; i < cells_; ++i) gradient[i + 2] = caps_[i].multiplier * b_[i + 2] * inverse_cap_[i + 2];
  for (std::size_t j = 0; j < splines_.size(); ++j) {
    if (j < hats_.size())
      for (std::size_t k = 0; k < N; ++k) {
        const Sides z = hats_[j][k].multiplier;
        gradient[j + 1] += sum(z * hat_change(j, k, 1, 0)), gradient[j + 2] += sum(z * hat_change(j, k, 0, 1));
      }
    const Spline& s = splines_[j];
    double by_time = 1 - s.time.multiplier;
    for (std::size_t k = 0; k < N; ++k) by_time -= s.jerk[k].multiplier[0] + s.jerk[k].multiplier[1];
    residual += std::abs(by_time) * s.T;
    for (std::size_t r = 0; r < 3; ++r) {
      const std::size_t a = j + 2 - r;
      gradient[a] -= 0.5 * s.time.multiplier * form_.cells[a].time[r] * root_[a];
      for (std::size_t k = 0; k < N; ++k)
        gradient[a] += (s.jerk[k].multiplier[0] - s.jerk[k].multiplier[1]) * form_.cells[a].jerk[r][k] * b_[a];
    }
  }
  for (const double g : gradient) residual += std::abs(g);
  return residual / duration_;
}

}  // namespace bahnwerk
