#include "core/redundant/chain_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/redundant/riccati.hpp"

namespace bahnwerk {
namespace {

/// One side of a box: sign·x + slack − excess = limit. Its multiplier z lies between 0 and the penalty. The difference
/// penalty − z is stored separately, because near the penalty a computed difference would have lost its digits.
struct Bound {
  double limit = 0;  // infinite: no bound
  double slack = 1, excess = 1, z = 1, below = 1;
  double d_slack = 0, d_excess = 0, dz = 0;  // Newton step
  double aim1 = 0, aim2 = 0;                 // required changes of slack·z and excess·below
  double by_z = 0, by_elastic = 0;           // 1/z, 1/below; 0: no excess variable
  double inverse = 0;                        // weight of the bound in the Newton system
  bool active() const { return std::isfinite(limit); }
};

constexpr double hard = std::numeric_limits<double>::infinity();
constexpr double rest = 1e-9;  // derivatives at the end up to this count as 0

struct Pair {
  Bound lower, upper;
};

template <std::size_t order>
class Method {
  using State = ChainState<order>;

 public:
  Method(const Chain<order>& chain, const ChainOptions& options)
      : chain_(chain),
        options_(options),
        n_(chain.cells()),
        riccati_(chain.steps, chain.free_at_begin()),
        states_(chain.states.size()),
        controls_(n_),
        state_bounds_(chain.states.size()),
        control_bounds_(n_),
        free_(n_),
        weight_(chain.states.size()),
        gradient_(chain.states.size()),
        cell_weight_(n_),
        cell_gradient_(n_),
        d_states_(chain.states.size()),
        d_controls_(n_) {
    if (chain.begin) begin_ = *chain.begin;
    for (auto& d : end_states_) d.resize(chain.states.size());
    for (auto& d : end_controls_) d.resize(n_);
  }

  ChainSolution<order> run() {
    start();
    ChainSolution<order> solution;
    for (;; ++solution.iterations) {
      if (options_.tick) options_.tick();
      roll();
      measure();
      if (gap_ <= options_.gap * (1 + objective_) && residual_ <= 1e-9 && dual_ <= 1e-6) {
        solution.converged = true;
        break;
      }
      if (options_.any && violation_ <= 0 && dual_ < 1) break;
      if (solution.iterations == options_.max_iterations || !step()) break;
    }
    finish(solution);
    return solution;
  }

 private:
  template <class Visit>
  void each(Visit&& visit) {  // every bound: itself, sign, x, its step, penalty
    for (std::size_t i = 0; i <= n_; ++i)
      for (std::size_t k = 0; k < order; ++k) {
        if (!chain_.counts(i, k)) continue;
        Pair& p = state_bounds_[i][k];
        if (p.upper.active()) visit(p.upper, 1.0, states_[i][k], d_states_[i][k], options_.penalty);
        if (p.lower.active()) visit(p.lower, -1.0, states_[i][k], d_states_[i][k], options_.penalty);
      }
    for (std::size_t c = 0; c < n_; ++c)
      if (free_[c]) {
        visit(control_bounds_[c].upper, 1.0, controls_[c], d_controls_[c], hard);
        visit(control_bounds_[c].lower, -1.0, controls_[c], d_controls_[c], hard);
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
      cell_weight_[c] = free_[c] ? chain_.steps[c] : 0;
    }
    roll();
    for (std::size_t c = 0; c < n_; ++c) cell_gradient_[c] = 0;
    for (std::size_t i = 0; i <= n_; ++i)
      for (std::size_t k = 0; k < order; ++k) {
        const Range& r = chain_.states[i][k];
        const double middle = std::isfinite(r.width()) ? r.middle() : 0;
        const double w = k == 0 ? node_step(i) : 1e-3 * node_step(i);
        weight_[i][k] = w;
        gradient_[i][k] = w * (states_[i][k] - middle);
      }
    newton();
    if (finite()) {
      for (std::size_t c = 0; c < n_; ++c) controls_[c] += d_controls_[c];
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
    const double penalty = options_.penalty;
    each([&](Bound& b, double sign, double x, double, double elastic) {
      const double room = b.limit - sign * x, kappa = 0.3;
      const double root = std::sqrt(room * room + 4 * kappa * kappa);
      if (elastic == hard) {
        b.slack = std::max(room, 0.1);
        b.excess = 0;
        b.z = 1;
      } else {
        b.slack = room > 0 ? 0.5 * (room + root) : 2 * kappa * kappa / (root - room);
        b.excess = room > 0 ? 2 * kappa * kappa / (root + room) : 0.5 * (root - room);
        b.z = std::min(penalty * b.excess / (b.slack + b.excess), 0.9999 * penalty);
        b.below = penalty - b.z;
      }
    });
  }

  void begin_by(double a) {
    for (std::size_t k = 0; k < order; ++k) begin_[k] += a * d_states_[0][k];
  }

  void roll() {
    State x = states_[0] = begin_;
    for (std::size_t c = 0; c < n_; ++c) states_[c + 1] = x = advanced<order>(x, chain_.steps[c], controls_[c]);
  }

  /// Applies the share `taken_` of the bounds' steps as well, in one pass over all bounds.
  void measure() {
    double sum = 0, residual = 0, excess = 0, violation = 0;
    std::size_t count = 0;
    each([&](Bound& b, double sign, double x, double, double penalty) {
      b.slack += taken_ * b.d_slack;
      b.z += taken_ * b.dz;
      if (penalty < hard) b.excess += taken_ * b.d_excess, b.below -= taken_ * b.dz;
      sum += b.slack * b.z;
      ++count;
      if (penalty < hard) {
        sum += b.excess * b.below;
        excess += b.excess;
        ++count;
      }
      violation = std::max(violation, sign * x - b.limit);
      residual = std::max(residual, std::abs(sign * x + b.slack - b.excess - b.limit));
    });
    for (std::size_t k = 1; chain_.ends_at_rest && k < order; ++k) {
      const double speed = std::abs(states_[n_][k]);
      residual = std::max(residual, speed);
      if (speed > rest) violation = std::max(violation, speed);
    }
    violation_ = violation;
    gap_ = sum;
    mu_ = count > 0 ? sum / static_cast<double>(count) : 0;
    residual_ = residual;
    double energy = 0;
    for (std::size_t c = 0; c < n_; ++c) energy += energy_of_control(c) * controls_[c] * controls_[c];
    for (std::size_t i = 0; i <= n_; ++i)
      for (std::size_t k = 0; k < order; ++k) energy += energy_of_state(i, k) * states_[i][k] * states_[i][k];
    objective_ = 0.5 * energy + options_.penalty * excess;
  }

  /// Returns the residual of a bound, including its centring terms.
  static double shift(const Bound& b, double x) {
    return x + b.slack - b.excess - b.limit + b.aim1 * b.by_z - b.aim2 * b.by_elastic;
  }

  /// Computes weights and gradient for the complementarity targets of the bounds, which aim(bound, penalty) sets.
  template <class Aim>
  void assemble(bool weights, Aim&& aim) {
    const auto bound = [&](Bound& b, double sign, double x, double penalty, double& w, double& g) {
      aim(b, penalty);
      if (weights) {
        b.by_z = 1 / b.z, b.by_elastic = penalty < hard ? 1 / b.below : 0;
        b.inverse = 1 / (b.slack * b.by_z + b.excess * b.by_elastic);
        w += b.inverse;
      }
      g += sign * (b.z + shift(b, sign * x) * b.inverse);
    };
    for (std::size_t i = 0; i <= n_; ++i)
      for (std::size_t k = 0; k < order; ++k) {
        double w = energy_of_state(i, k), g = w * states_[i][k];
        if (chain_.counts(i, k)) {
          Pair& p = state_bounds_[i][k];
          if (p.upper.active()) bound(p.upper, 1, states_[i][k], options_.penalty, w, g);
          if (p.lower.active()) bound(p.lower, -1, states_[i][k], options_.penalty, w, g);
        }
        if (weights) weight_[i][k] = w;
        gradient_[i][k] = g;
      }
    for (std::size_t c = 0; c < n_; ++c) {
      if (!free_[c]) {
        cell_weight_[c] = cell_gradient_[c] = 0;
        continue;
      }
      double w = energy_of_control(c), g = w * controls_[c];
      bound(control_bounds_[c].upper, 1, controls_[c], hard, w, g);
      bound(control_bounds_[c].lower, -1, controls_[c], hard, w, g);
      if (weights) cell_weight_[c] = w;
      cell_gradient_[c] = g;
    }
  }

  /// Factorises, and computes the response to a multiplier of the condition of rest at the end.
  void factorise() {
    riccati_.factorise(weight_, cell_weight_);
    if (!chain_.ends_at_rest) return;
    unit_.resize(n_ + 1), none_.resize(n_);
    for (std::size_t k = 1; k < order; ++k) {
      unit_[n_] = {};
      unit_[n_][k] = 1;
      riccati_.solve(unit_, none_, end_states_[k - 1], end_controls_[k - 1]);
    }
  }

  /// Adds the step that brings the derivatives at the end to 0.
  void solve_step() {
    riccati_.solve(gradient_, cell_gradient_, d_states_, d_controls_);
    if (!chain_.ends_at_rest) return;
    std::array<double, order - 1> nu{};
    const auto at = [&](std::size_t column, std::size_t k) { return end_states_[column][n_][k]; };
    const double r1 = -(states_[n_][1] + d_states_[n_][1]);
    if constexpr (order == 2) {
      if (at(0, 1) != 0) nu[0] = r1 / at(0, 1);  // 0: every control is fixed
    } else {
      const double r2 = -(states_[n_][2] + d_states_[n_][2]);
      const double det = at(0, 1) * at(1, 2) - at(1, 1) * at(0, 2);
      if (det != 0) nu = {(r1 * at(1, 2) - r2 * at(1, 1)) / det, (at(0, 1) * r2 - at(0, 2) * r1) / det};
    }
    for (std::size_t j = 0; j + 1 < order; ++j) {
      const double f = nu[j];
      for (std::size_t i = 0; i <= n_; ++i)
        for (std::size_t k = 0; k < order; ++k) d_states_[i][k] += f * end_states_[j][i][k];
      for (std::size_t c = 0; c < n_; ++c) d_controls_[c] += f * end_controls_[j][c];
      at_end_[j + 1] = f;
    }
  }

  void newton() {
    factorise();
    solve_step();
  }

  /// Returns the complementarity after a step of length a: now + a (linear + a square).
  struct Products {
    double linear = 0, square = 0;
  };
  /// Computes the steps of slacks and multipliers; returns the largest step length, at most 1, that keeps them
  /// positive.
  double reach(double keep, Products* products = nullptr) {
    double least = 1;
    Products sums;
    const auto limit = [&](double value, double change) {
      if (change < 0 && -keep * value > least * change) least = -keep * value / change;
    };
    each([&](Bound& b, double sign, double x, double dx, double penalty) {
      b.dz = shift(b, sign * (x + dx)) * b.inverse;
      b.d_slack = (b.aim1 - b.slack * b.dz) * b.by_z;
      limit(b.slack, b.d_slack);
      limit(b.z, b.dz);
      if (penalty < hard) {
        b.d_excess = (b.aim2 + b.excess * b.dz) * b.by_elastic;
        limit(b.excess, b.d_excess);
        limit(b.below, -b.dz);
        sums.linear += b.d_excess * b.below - b.excess * b.dz;
        sums.square -= b.d_excess * b.dz;
      }
      sums.linear += b.slack * b.dz + b.d_slack * b.z;
      sums.square += b.d_slack * b.dz;
    });
    if (products != nullptr) *products = sums;
    return least;
  }

  /// Returns false, without any change, if the Newton system has no solution in floating-point arithmetic.
  bool step() {
    assemble(true, [](Bound& b, double penalty) {
      b.aim1 = -b.slack * b.z;
      b.aim2 = penalty < hard ? -b.excess * b.below : 0;
    });
    factorise();
    solve_step();
    Products products;
    const double affine = reach(1, &products);
    const double ratio = gap_ > 0 ? 1 + affine * (products.linear + affine * products.square) / gap_ : 0;
    const double target = std::max(ratio * ratio * ratio, 1e-4) * mu_;
    assemble(false, [&](Bound& b, double penalty) {
      b.aim1 = target - b.slack * b.z - b.d_slack * b.dz;
      if (penalty < hard) b.aim2 = target - b.excess * b.below + b.d_excess * b.dz;
    });
    solve_step();
    const double taken = reach(0.995);
    if (!finite()) return false;
    taken_ = taken;
    for (std::size_t c = 0; c < n_; ++c)
      if (free_[c]) controls_[c] += taken_ * d_controls_[c];
    begin_by(taken_);
    dual_ *= 1 - taken_;
    return true;
  }

  /// Tells whether the step is finite everywhere.
  bool finite() {
    double sum = 0;
    for (const State& d : d_states_)
      for (const double x : d) sum += std::abs(x);
    for (std::size_t c = 0; c < n_; ++c) sum += free_[c] ? std::abs(d_controls_[c]) : 0;
    each([&](Bound& b, double, double, double, double) {
      sum += std::abs(b.d_slack) + std::abs(b.d_excess) + std::abs(b.dz);
    });
    return std::isfinite(sum);
  }

  void finish(ChainSolution<order>& s) {
    s.multipliers.resize(n_ + 1);
    for (std::size_t i = 0; i <= n_; ++i)
      for (std::size_t k = 0; k < order; ++k) {
        if (!chain_.counts(i, k)) continue;
        const Pair& p = state_bounds_[i][k];
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
    s.at_end = at_end_;
    s.states = std::move(states_);
    s.controls = std::move(controls_);
  }

  const Chain<order>& chain_;
  const ChainOptions& options_;
  std::size_t n_;
  Riccati<order> riccati_;
  State begin_{};  // at the first node
  std::vector<State> states_;
  std::vector<double> controls_;
  std::vector<std::array<Pair, order>> state_bounds_;
  std::vector<Pair> control_bounds_;
  std::vector<char> free_;
  std::vector<State> weight_, gradient_;
  std::vector<double> cell_weight_, cell_gradient_;
  std::vector<State> d_states_;
  std::vector<double> d_controls_;
  std::vector<State> unit_;   ///< 0 but for the last
  std::vector<double> none_;  ///< 0
  std::array<std::vector<State>, order - 1> end_states_;
  std::array<std::vector<double>, order - 1> end_controls_;
  State at_end_{};
  double taken_ = 0;  ///< part of the last step, which bounds take when they are measured
  double gap_ = 0, mu_ = 0, residual_ = 0, objective_ = 0, dual_ = 1, violation_ = 0;
};

}  // namespace

template <std::size_t order>
ChainSolution<order> solve(const Chain<order>& chain, const ChainOptions& options) {
  return Method<order>(chain, options).run();
}

template ChainSolution<2> solve(const Chain<2>&, const ChainOptions&);
template ChainSolution<3> solve(const Chain<3>&, const ChainOptions&);

}  // namespace bahnwerk
