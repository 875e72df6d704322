#include "core/redundant/chain/chain_solver.hpp"

#include <algorithm>
#include <cmath>

#include "core/numeric/interior_point/driver.hpp"
#include "core/numeric/linear/riccati.hpp"
#include "core/redundant/chain/chain_bounds.hpp"

namespace bahnwerk {
namespace {

constexpr double hard = ChainBound::hard;
constexpr double rest = 1e-9;  // derivatives at the end up to this count as 0

template <std::size_t order>
class Method final : public InteriorPointProblem {
  using State = ChainState<order>;

 public:
  Method(const Chain<order>& chain, const ChainOptions& options)
      : chain_(chain),
        options_(options),
        n_(chain.cells()),
        states_(chain.states.size()),
        controls_(n_),
        state_bounds_(chain.states.size()),
        control_bounds_(n_),
        free_(n_),
        newton_(chain.steps, chain.free_at_begin(), chain.ends_at_rest) {
    if (chain.begin) begin_ = *chain.begin;
  }

  ChainSolution<order> run() {
    start();
    InteriorPointRule rule;
    rule.gap = options_.gap;
    rule.dual_residual = 1e-6;
    rule.max_iterations = options_.max_iterations;
    rule.tick = options_.tick;
    const InteriorPointResult result = run_interior_point(*this, rule);
    ChainSolution<order> solution;
    solution.iterations = result.iterations;
    solution.converged = result.converged;
    finish(solution);
    return solution;
  }

 private:
  template <class Visit>
  void each(Visit&& visit) {  // every bound: itself, sign, x, its step, penalty
    for (std::size_t i = 0; i <= n_; ++i)
      for (std::size_t k = 0; k < order; ++k) {
        if (!chain_.counts(i, k)) continue;
        ChainBox& p = state_bounds_[i][k];
        if (p.upper.active()) visit(p.upper, 1.0, states_[i][k], newton_.d_states[i][k], options_.penalty);
        if (p.lower.active()) visit(p.lower, -1.0, states_[i][k], newton_.d_states[i][k], options_.penalty);
      }
    for (std::size_t c = 0; c < n_; ++c)
      if (free_[c]) {
        visit(control_bounds_[c].upper, 1.0, controls_[c], newton_.d_controls[c], hard);
        visit(control_bounds_[c].lower, -1.0, controls_[c], newton_.d_controls[c], hard);
      }
  }

  double node_step(std::size_t i) const {
    return 0.5 * ((i > 0 ? chain_.steps[i - 1] : 0) + (i < n_ ? chain_.steps[i] : 0));
  }
  double energy_of_control(std::size_t c) const {
    // Order 3: jerk enters with a weight that only makes the minimum unique.
    return chain_.energy_weight * chain_.steps[c] * (order == 2 ? 1 : 1e-6);
  }
  double energy_of_state(std::size_t i, std::size_t k) const {
    return k == 2 ? chain_.energy_weight * node_step(i) : 0;
  }

  /// Computes the first guess, which stays near the middles of the state boxes, whatever its controls.
  void start() {
    for (std::size_t c = 0; c < n_; ++c) {
      const Range& r = chain_.controls[c];
      free_[c] = r.width() > options_.fixed_width;
      controls_[c] = free_[c] ? 0 : r.middle();
      newton_.cell_weight[c] = free_[c] ? chain_.steps[c] : 0;
    }
    roll();
    for (std::size_t c = 0; c < n_; ++c) newton_.cell_gradient[c] = 0;
    for (std::size_t i = 0; i <= n_; ++i)
      for (std::size_t k = 0; k < order; ++k) {
        const Range& r = chain_.states[i][k];
        const double middle = std::isfinite(r.width()) ? r.middle() : 0;
        const double w = k == 0 ? node_step(i) : 1e-3 * node_step(i);
        newton_.weight[i][k] = w;
        newton_.gradient[i][k] = w * (states_[i][k] - middle);
      }
    newton_.factor();
    newton_.solve(states_[n_]);
    if (finite()) {
      for (std::size_t c = 0; c < n_; ++c) controls_[c] += newton_.d_controls[c];
      begin_by(1);
      roll();
    }
    for (std::size_t i = 0; i <= n_; ++i)
      for (std::size_t k = 0; k < order; ++k) {
        const Range& r = chain_.states[i][k];
        state_bounds_[i][k].upper.limit = r.highest;
        state_bounds_[i][k].lower.limit = -r.lowest;
      }
    for (std::size_t c = 0; c < n_; ++c) {
      control_bounds_[c].upper.limit = chain_.controls[c].highest;
      control_bounds_[c].lower.limit = -chain_.controls[c].lowest;
    }
    each([&](ChainBound& b, double sign, double x, double, double penalty) { b.start(sign * x, penalty); });
  }

  void begin_by(double a) {
    for (std::size_t k = 0; k < order; ++k) begin_[k] += a * newton_.d_states[0][k];
  }

  void roll() {
    State x = states_[0] = begin_;
    for (std::size_t c = 0; c < n_; ++c) states_[c + 1] = x = advanced<order>(x, chain_.steps[c], controls_[c]);
  }

  /// Applies the bounds' last step as well, in one pass over all bounds.
  InteriorPointFigures evaluate(double /*mu*/) override {
    roll();
    InteriorPointFigures figures;
    double excess = 0, violation = 0;
    std::size_t count = 0;
    each([&](ChainBound& b, double sign, double x, double, double penalty) {
      b.advance(taken_, penalty);
      figures.complementarity += b.slack * b.z;
      ++count;
      if (penalty < hard) {
        figures.complementarity += b.excess * b.below;
        excess += b.excess;
        ++count;
      }
      violation = std::max(violation, sign * x - b.limit);
      figures.primal_residual = std::max(figures.primal_residual, std::abs(sign * x + b.slack - b.excess - b.limit));
    });
    for (std::size_t k = 1; chain_.ends_at_rest && k < order; ++k) {
      const double speed = std::abs(states_[n_][k]);
      figures.primal_residual = std::max(figures.primal_residual, speed);
      if (speed > rest) violation = std::max(violation, speed);
    }
    double energy = 0;
    for (std::size_t c = 0; c < n_; ++c) energy += energy_of_control(c) * controls_[c] * controls_[c];
    for (std::size_t i = 0; i <= n_; ++i)
      for (std::size_t k = 0; k < order; ++k) energy += energy_of_state(i, k) * states_[i][k] * states_[i][k];
    figures.scale = 1 + 0.5 * energy + options_.penalty * excess;
    figures.weight = static_cast<double>(std::max<std::size_t>(count, 1));
    figures.enough = options_.any && violation <= 0 && dual_ < 1;
    gap_ = figures.complementarity;
    return figures;
  }
  double dual_residual() override { return dual_; }
  bool factor() override {
    assemble(true, [](ChainBound& b, double penalty) { b.aim_at_zero(penalty); });
    newton_.factor();
    return true;
  }
  std::optional<double> predict() override {
    newton_.solve(states_[n_]);
    ChainProducts products;
    const double affine = reach(1, &products);
    return gap_ > 0 ? 1 + affine * (products.linear + affine * products.square) / gap_ : 0;
  }
  /// Changes nothing if the Newton system has no solution in floating-point arithmetic.
  StepLengths step(double mu) override {
    assemble(false, [&](ChainBound& b, double penalty) { b.aim_at(mu, penalty); });
    newton_.solve(states_[n_]);
    const double taken = reach(to_boundary);
    if (!finite()) return {HUGE_VAL, HUGE_VAL};
    taken_ = taken;
    for (std::size_t c = 0; c < n_; ++c)
      if (free_[c]) controls_[c] += taken_ * newton_.d_controls[c];
    begin_by(taken_);
    dual_ *= 1 - taken_;
    return {taken_, taken_};
  }

  /// Computes weights and gradient for the complementarity targets of the bounds, which aim(bound, penalty) sets.
  template <class Aim>
  void assemble(bool weights, Aim&& aim) {
    const auto bound = [&](ChainBound& b, double sign, double x, double penalty, double& w, double& g) {
      aim(b, penalty);
      if (weights) {
        b.weigh(penalty);
        w += b.inverse;
      }
      g += sign * (b.z + b.shift(sign * x) * b.inverse);
    };
    for (std::size_t i = 0; i <= n_; ++i)
      for (std::size_t k = 0; k < order; ++k) {
        double w = energy_of_state(i, k), g = w * states_[i][k];
        if (chain_.counts(i, k)) {
          ChainBox& p = state_bounds_[i][k];
          if (p.upper.active()) bound(p.upper, 1, states_[i][k], options_.penalty, w, g);
          if (p.lower.active()) bound(p.lower, -1, states_[i][k], options_.penalty, w, g);
        }
        if (weights) newton_.weight[i][k] = w;
        newton_.gradient[i][k] = g;
      }
    for (std::size_t c = 0; c < n_; ++c) {
      if (!free_[c]) {
        newton_.cell_weight[c] = newton_.cell_gradient[c] = 0;
        continue;
      }
      double w = energy_of_control(c), g = w * controls_[c];
      bound(control_bounds_[c].upper, 1, controls_[c], hard, w, g);
      bound(control_bounds_[c].lower, -1, controls_[c], hard, w, g);
      if (weights) newton_.cell_weight[c] = w;
      newton_.cell_gradient[c] = g;
    }
  }

  /// Computes the steps of slacks and multipliers; returns the length of the step.
  double reach(double part, ChainProducts* products = nullptr) {
    double most = 0;
    ChainProducts sums;
    const auto limit = [&](double value, double change) {
      if (-change > most * value) most = -change / value;
    };
    each([&](ChainBound& b, double sign, double x, double dx, double penalty) {
      b.direct(sign * (x + dx), penalty);
      limit(b.slack, b.d_slack);
      limit(b.z, b.dz);
      if (penalty < hard) {
        limit(b.excess, b.d_excess);
        limit(b.below, -b.dz);
      }
      sums.add(b, penalty);
    });
    if (products != nullptr) *products = sums;
    return step_length(most, part);
  }

  /// Tells whether the step is finite everywhere.
  bool finite() {
    double sum = 0;
    for (const State& d : newton_.d_states)
      for (const double x : d) sum += std::abs(x);
    for (std::size_t c = 0; c < n_; ++c) sum += free_[c] ? std::abs(newton_.d_controls[c]) : 0;
    each([&](ChainBound& b, double, double, double, double) {
      sum += std::abs(b.d_slack) + std::abs(b.d_excess) + std::abs(b.dz);
    });
    return std::isfinite(sum);
  }

  void finish(ChainSolution<order>& s) {
    s.multipliers.resize(n_ + 1);
    for (std::size_t i = 0; i <= n_; ++i)
      for (std::size_t k = 0; k < order; ++k) {
        if (!chain_.counts(i, k)) continue;
        const ChainBox& p = state_bounds_[i][k];
        if (p.upper.active()) {
          s.multipliers[i][k] += p.upper.z;
          s.excess = std::max(s.excess, states_[i][k] - p.upper.limit);
        }
        if (p.lower.active()) {
          s.multipliers[i][k] -= p.lower.z;
          s.excess = std::max(s.excess, -p.lower.limit - states_[i][k]);
        }
      }
    for (std::size_t c = 0; c < n_; ++c) s.energy += order == 2 ? chain_.steps[c] * controls_[c] * controls_[c] : 0;
    for (std::size_t i = 0; i <= n_; ++i)
      if constexpr (order == 3) s.energy += node_step(i) * states_[i][2] * states_[i][2];
    for (std::size_t k = 1; chain_.ends_at_rest && k < order; ++k)
      if (const double speed = std::abs(states_[n_][k]); !(speed <= rest)) s.excess = std::max(s.excess, speed);
    s.at_end = newton_.at_end();
    s.states = std::move(states_);
    s.controls = std::move(controls_);
  }

  const Chain<order>& chain_;
  const ChainOptions& options_;
  std::size_t n_;
  State begin_{};  // at the first node
  std::vector<State> states_;
  std::vector<double> controls_;
  std::vector<std::array<ChainBox, order>> state_bounds_;
  std::vector<ChainBox> control_bounds_;
  std::vector<char> free_;
  Riccati<order> newton_;
  double taken_ = 0;  ///< length of the last step, which bounds go when they are evaluated
  double gap_ = 0, dual_ = 1;
};

}  // namespace

template <std::size_t order>
ChainSolution<order> solve(const Chain<order>& chain, const ChainOptions& options) {
  return Method<order>(chain, options).run();
}

template ChainSolution<2> solve(const Chain<2>&, const ChainOptions&);
template ChainSolution<3> solve(const Chain<3>&, const ChainOptions&);

}  // namespace bahnwerk
