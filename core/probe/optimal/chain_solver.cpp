#include "core/probe/optimal/chain_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/probe/optimal/chain_constraints.hpp"
#include "core/probe/optimal/chain_newton.hpp"

namespace bahnwerk {
namespace {

template <int D>
class Solver {
  using Slacks = ChainSlacks<D>;
  static constexpr double no_limit = Slacks::unlimited_slack;

 public:
  Solver(CellChain<D>& chain, const ChainLimits<D>& limits, const ChainSolverOptions& options)
      : chain_(chain),
        options_(options),
        cells_(chain.cell.size()),
        constraints_(limits, options.shortest),
        newton_(constraints_, cells_),
        slack_(cells_, no_limit),
        trial_slack_(cells_, no_limit),
        dual_(cells_),
        change_(cells_) {}

  ChainSolverReport run(const std::function<void()>& stop) {
    ChainSolverReport report;
    if (!constraints_.slacks(chain_, slack_)) return report;
    count_ = constraints_.count(slack_);
    double duration = chain_.duration();
    double mu = (options_.start_mu > 0 ? options_.start_mu : 0.3) * duration / count_;
    start_duals(mu);
    damping_ = 1e-8;
    for (int i = 0; i < options_.iterations; ++i) {
      stop();
      report.iterations = i + 1;
      const double alpha = iterate(mu);
      const double sum = complementarity();
      duration = chain_.duration();
      report.gap = sum / duration;
      if (report.gap <= options_.gap && decrease_ <= (stiffness_ > soft ? 0.02 : 2) * options_.gap * duration) break;
      const double average = sum / count_;
      // The barrier parameter stays while the iterate is far from the minimum that belongs to it.
      if (decrease_ > (stiffness_ > soft ? 0.02 : far) * mu * count_) continue;
      stiffness_ *= 0.25;
      const double factor = alpha > 0.9 ? 0.15 : alpha > 0.5 ? 0.35 : 0.7;
      mu = std::max(std::min(mu, factor * average), 0.2 * options_.gap * duration / count_);
    }
    return report;
  }

 private:
  // Calls f(slack, multiplier, its change) for every slack that counts.
  template <typename Visit>
  void each(Visit&& f) {
    for (std::size_t c = 0; c < cells_; ++c)
      for (std::size_t s = 0; s < slack_.cell[c].size(); ++s)
        if (slack_.cell[c][s] < no_limit) f(slack_.cell[c][s], dual_.cell[c][s], change_.cell[c][s]);
    for (std::size_t n = 0; n <= cells_; ++n)
      if (slack_.ball[n] < no_limit) f(slack_.ball[n], dual_.ball[n], change_.ball[n]);
  }
  void start_duals(double mu) {
    each([&](double g, double& l, double) { l = mu / g; });
  }
  double complementarity() {
    double sum = 0;
    each([&](double g, double l, double) { sum += g * l; });
    return sum;
  }
  double merit(const CellChain<D>& chain, const Slacks& slack, double mu) const {
    return chain.duration() - mu * constraints_.logarithms(slack);
  }

  double iterate(double mu) {
    for (int attempt = 0; attempt < 12; ++attempt) {
      if (newton_.step(chain_, slack_, dual_, {mu, damping_, stiffness_})) break;
      if (attempt > 0) damping_ = std::max(damping_ * 100, 1e-10);
      if (attempt == 11) return 0;
    }
    return line_search(mu);
  }

  // The state after a step. Motion that is quicker by e^r near the node has derivatives that are e^r, e^2r, e^3r times
  // as large: the step follows these powers and what is left of it is scaled by them. To first order that is the step
  // itself; a step that is taken linearly would tear states and durations of short cells apart.
  void move_node(std::size_t n, double alpha, bool powers, ChainNode<D>& node) const {
    if (node.given) return;
    double rate = n > 0 ? -newton_.of_duration(n - 1) : -newton_.of_duration(n);
    if (n > 0 && n < cells_) rate = (rate - newton_.of_duration(n)) / 2;
    if (!powers) rate = 0;
    const double factor = std::exp(alpha * rate);
    double power = 1;
    for (int p = 0; p < 4; ++p, power *= factor)
      for (int k = 0; k < D; ++k) {
        double& x = node.state[p][k];
        x = power * (x + alpha * (newton_.of_node(n)(p * D + k) - p * rate * x));
      }
  }

  // Computes the linear changes of the slacks; returns the durations' part of the merit's slope.
  double find_changes(double& alpha) {
    double slope = 0;
    for (std::size_t c = 0; c < cells_; ++c) {
      double dq[CellBasis::rows][D];
      newton_.row_steps(chain_, c, dq);
      const double longer = newton_.of_duration(c);
      slope += chain_.cell[c].duration * longer;
      if (std::abs(longer) > 1) alpha = std::min(alpha, 1 / std::abs(longer));
      auto& dg = change_.cell[c];
      dg.fill(0);
      for (std::size_t r = 0; r < 30; ++r)
        constraints_.curved(chain_, c, r, newton_.values(c).q[r],
                            [&](std::size_t s, const std::array<double, D>& grad, double, const double*) {
                              for (int k = 0; k < D; ++k) dg[s] += grad[k] * dq[r][k];
                            });
      std::size_t at = 30;
      for (std::size_t r = 30; r < CellBasis::rows; ++r)
        for (int k = 0; k < D; ++k) {
          const double x = dq[r][k] / constraints_.derivative_limit(r, k);
          dg[at++] = -x;
          dg[at++] = x;
        }
      dg[at] = longer;
    }
    for (std::size_t n = 0; n <= cells_; ++n) {
      if (slack_.ball[n] >= no_limit) continue;
      const ChainNode<D>& node = chain_.node[n];
      const double r2 = constraints_.ball_radius(node) * constraints_.ball_radius(node);
      change_.ball[n] = 0;
      for (int k = 0; k < D; ++k) change_.ball[n] -= 2 * constraints_.from_point(node, k) / r2 * newton_.of_node(n)(k);
    }
    return slope;
  }

  double line_search(double mu) {
    // The largest steps that keep slacks and multipliers positive.
    constexpr double keep = 0.005;
    double alpha = 1, alpha_dual = 1;
    double slope = find_changes(alpha);
    each([&](double g, double l, double dg) {
      slope -= mu / g * dg;
      if (dg < -(1 - keep) * g) alpha = std::min(alpha, -(1 - keep) * g / dg);
      const double dl = mu / g - l - l / g * dg;
      if (dl < -(1 - keep) * l) alpha_dual = std::min(alpha_dual, -(1 - keep) * l / dl);
    });
    decrease_ = -slope;
    const double before = merit(chain_, slack_, mu);
    bool moved = false;
    for (int attempt = 0; attempt < 60; ++attempt) {
      // Each length is tried both ways: along the powers of the change of speed, then straight.
      const bool powers = attempt % 2 == 0;
      if (powers && attempt > 0) alpha *= attempt < 8 ? 0.7 : 0.4;
      trial_ = chain_;
      for (std::size_t n = 0; n <= cells_; ++n) move_node(n, alpha, powers, trial_.node[n]);
      for (std::size_t c = 0; c < cells_; ++c) trial_.cell[c].duration *= std::exp(alpha * newton_.of_duration(c));
      if (!constraints_.slacks(trial_, trial_slack_)) continue;
      const double after = merit(trial_, trial_slack_, mu);
      if (after > before + 1e-4 * alpha * slope + 1e-12 * std::abs(before)) continue;
      moved = true;
      break;
    }
    if (!moved) {
      damping_ = std::min(std::max(damping_ * 100, 1e-6), 1e6);
      return 0;
    }
    move_duals(mu, alpha_dual);
    std::swap(chain_, trial_);
    std::swap(slack_, trial_slack_);
    stiffness_ = alpha < 0.1    ? std::min(std::max(4 * stiffness_, 0.01), 1e6)
                 : alpha > 0.25 ? 0.25 * stiffness_
                                : stiffness_;
    damping_ = alpha > 0.1 ? std::max(damping_ * 0.1, 1e-10) : damping_;
    return alpha;
  }
  // The multipliers' own step, kept near to what the barrier parameter says of the new slacks.
  void move_duals(double mu, double alpha) {
    const auto move = [&](double& l, double g, double dg, double g_new) {
      if (g >= no_limit) return;
      l += alpha * (mu / g - l - l / g * dg);
      l = std::clamp(l, 1e-3 * mu / g_new, 1e3 * mu / g_new);
    };
    for (std::size_t c = 0; c < cells_; ++c)
      for (std::size_t s = 0; s < slack_.cell[c].size(); ++s)
        move(dual_.cell[c][s], slack_.cell[c][s], change_.cell[c][s], trial_slack_.cell[c][s]);
    for (std::size_t n = 0; n <= cells_; ++n)
      move(dual_.ball[n], slack_.ball[n], change_.ball[n], trial_slack_.ball[n]);
  }

  CellChain<D>& chain_;
  CellChain<D> trial_;
  const ChainSolverOptions& options_;
  std::size_t cells_;
  static constexpr double far = 1, soft = 0.3;
  double count_ = 0, damping_ = 0, stiffness_ = 0;
  double decrease_ = 0;  // Newton's prediction for the barrier function, twice
  ChainConstraints<D> constraints_;
  ChainNewton<D> newton_;
  Slacks slack_, trial_slack_, dual_, change_;
};

}  // namespace

template <int D>
ChainSolverReport shorten_chain(CellChain<D>& chain, const ChainLimits<D>& limits, const ChainSolverOptions& options,
                                const std::function<void()>& stop) {
  return Solver<D>(chain, limits, options).run(stop);
}

#define BAHNWERK_CHAIN(D)                                                                                      \
  template ChainSolverReport shorten_chain<D>(CellChain<D>&, const ChainLimits<D>&, const ChainSolverOptions&, \
                                              const std::function<void()>&);
BAHNWERK_CHAIN(1)
BAHNWERK_CHAIN(2)
BAHNWERK_CHAIN(3)
#undef BAHNWERK_CHAIN

}  // namespace bahnwerk
