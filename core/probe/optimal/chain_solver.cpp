#include "core/probe/optimal/chain_solver.hpp"

#include <Eigen/Dense>

#include "core/probe/optimal/cell_rows.hpp"

namespace bahnwerk {
namespace {

constexpr double no_limit = 1e300;  // a slack that is not looked at

template <int D>
class Solver {
  static constexpr int N = 4 * D;  // unknowns of a node
  static constexpr int L = 2 * N;  // of a cell, without its duration
  static constexpr std::size_t S = cell_slacks<D>;
  using Block = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;
  using Slacks = std::array<double, S>;

 public:
  Solver(CellChain<D>& chain, const ChainLimits<D>& limits, const ChainSolverOptions& options)
      : chain_(chain), limits_(limits), options_(options), cells_(chain.cell.size()) {
    make_capsules();
    dual_.resize(cells_);
    slack_.resize(cells_);
    trial_slack_.resize(cells_);
    ball_.assign(cells_ + 1, no_limit);
    ball_dual_.assign(cells_ + 1, 0);
    trial_ball_ = ball_;
    diag_.resize(cells_ + 1);
    off_.resize(cells_);
    rhs_.resize(cells_ + 1);
    step_.resize(cells_ + 1);
    tau_row_.resize(cells_);
    tau_diag_.resize(cells_);
    tau_rhs_.resize(cells_);
    tau_step_.resize(cells_);
    values_.resize(cells_);
  }

  ChainSolverReport run(const std::function<void()>& stop) {
    ChainSolverReport report;
    if (!slacks_of(chain_, slack_, ball_)) return report;
    for (const auto& s : slack_)
      for (double g : s) count_ += g < no_limit;
    for (double g : ball_) count_ += g < no_limit;
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
  void make_capsules() {
    for (std::size_t e = 0; e + 1 < limits_.points.size(); ++e)
      capsule_.push_back(capsule<D>(limits_.points[e], limits_.points[e + 1], limits_.tolerance));
  }

  double ball_radius(const ChainNode<D>& node) const { return limits_.ball[static_cast<std::size_t>(node.point)]; }
  bool position_given(const ChainNode<D>& node) const {
    return node.given || (node.point >= 0 && ball_radius(node) <= 0);
  }
  bool component_given(const ChainNode<D>& node, int p) const {
    return node.given || (p == 0 && node.point >= 0 && ball_radius(node) <= 0) || (p == 1 && node.still);
  }
  bool tube_row(std::size_t cell, std::size_t r) const {
    if (limits_.tolerance <= 0) return false;
    if (r == 0) return !position_given(chain_.node[cell]);
    if (r == 16) return !position_given(chain_.node[cell + 1]);
    return true;
  }

  // False: one is not positive.
  bool slacks_of(const CellChain<D>& chain, std::vector<Slacks>& slack, std::vector<double>& ball) {
    CellValues<D> v;
    for (std::size_t c = 0; c < cells_; ++c) {
      evaluate_cell(chain.node[c], chain.node[c + 1], chain.cell[c].duration, v);
      if (!slacks_of_cell(c, v, chain.cell[c].duration, slack[c])) return false;
    }
    for (std::size_t n = 0; n <= cells_; ++n) {
      const ChainNode<D>& node = chain.node[n];
      if (node.point < 0 || position_given(node)) continue;
      double sum = 0;
      for (int k = 0; k < D; ++k) {
        const double d = node.state[0][k] - limits_.points[static_cast<std::size_t>(node.point)][k];
        sum += d * d;
      }
      ball[n] = 1 - sum / (ball_radius(node) * ball_radius(node));
      if (!(ball[n] > 0)) return false;
    }
    return true;
  }
  bool slacks_of_cell(std::size_t c, const CellValues<D>& v, double h, Slacks& out) const {
    double least = no_limit;
    for (std::size_t r = 0; r < 17; ++r) {
      if (!tube_row(c, r)) {
        out[r] = no_limit;
        continue;
      }
      bool cap;
      const Capsule<D>& set = capsule_[chain_.cell[c].edge];
      const std::array<double, D> d = offset(set, v.q[r], cap);
      double sum = 0;
      for (int k = 0; k < D; ++k) sum += d[k] * d[k];
      out[r] = 1 - sum / set.radius2;
      least = std::min(least, out[r]);
    }
    for (std::size_t r = 17; r < 30; ++r) {
      double sum = 0;
      for (int k = 0; k < D; ++k) sum += v.q[r][k] * v.q[r][k];
      out[r] = 1 - sum / (limits_.speed * limits_.speed);
      least = std::min(least, out[r]);
    }
    std::size_t at = 30;
    for (std::size_t r = 30; r < CellBasis::rows; ++r)
      for (int k = 0; k < D; ++k) {
        const double x = v.q[r][k] / limits_.derivative[static_cast<std::size_t>(cell_basis().order[r] - 2)][k];
        out[at++] = 1 - x;
        out[at++] = 1 + x;
        least = std::min({least, 1 - x, 1 + x});
      }
    out[at] = options_.shortest > 0 ? std::log(h / options_.shortest) : no_limit;
    least = std::min(least, out[at]);
    return least > 0;
  }
  void start_duals(double mu) {
    for (std::size_t c = 0; c < cells_; ++c)
      for (std::size_t s = 0; s < S; ++s) dual_[c][s] = slack_[c][s] < no_limit ? mu / slack_[c][s] : 0;
    for (std::size_t n = 0; n <= cells_; ++n) ball_dual_[n] = ball_[n] < no_limit ? mu / ball_[n] : 0;
  }
  double complementarity() const {
    double sum = 0;
    for (std::size_t c = 0; c < cells_; ++c)
      for (std::size_t s = 0; s < S; ++s)
        if (slack_[c][s] < no_limit) sum += slack_[c][s] * dual_[c][s];
    for (std::size_t n = 0; n <= cells_; ++n)
      if (ball_[n] < no_limit) sum += ball_[n] * ball_dual_[n];
    return sum;
  }
  double merit(const CellChain<D>& chain, const std::vector<Slacks>& slack, const std::vector<double>& ball,
               double mu) const {
    double product = 1, sum = 0;
    const auto add = [&](double g) {
      product *= g;
      if (product < 1e-200 || product > 1e200) {
        sum += std::log(product);
        product = 1;
      }
    };
    for (const Slacks& s : slack)
      for (double g : s)
        if (g < no_limit) add(g);
    for (double g : ball)
      if (g < no_limit) add(g);
    return chain.duration() - mu * (sum + std::log(product));
  }

  // For each constraint of a row: its gradient with respect to the row's value, and the matrix of its curvature.
  template <typename Visit>
  void constraints(std::size_t c, std::size_t r, const double* q, Visit&& visit) const {
    std::array<double, D> g{};
    if (r < 17) {
      if (!tube_row(c, r)) return;
      bool cap;
      const Capsule<D>& set = capsule_[chain_.cell[c].edge];
      const std::array<double, D> d = offset(set, q, cap);
      for (int k = 0; k < D; ++k) g[k] = -2 * d[k] / set.radius2;
      visit(r, g, 2 / set.radius2, cap ? nullptr : set.u.data());
    } else if (r < 30) {
      const double v2 = limits_.speed * limits_.speed;
      for (int k = 0; k < D; ++k) g[k] = -2 * q[k] / v2;
      visit(r, g, 2 / v2, nullptr);
    }
  }

  double iterate(double mu) {
    for (int attempt = 0; attempt < 12; ++attempt) {
      if (assemble(mu) && solve()) break;
      if (attempt > 0) damping_ = std::max(damping_ * 100, 1e-10);
      if (attempt == 11) return 0;
    }
    return line_search(mu);
  }

  bool assemble(double mu) {
    for (auto& d : diag_) d.setZero();
    for (auto& r : rhs_) r.setZero();
    const CellBasis& basis = cell_basis();
    using Local = Eigen::Matrix<double, L, L>;
    using LocalVector = Eigen::Matrix<double, L, 1>;
    for (std::size_t c = 0; c < cells_; ++c) {
      const double h = chain_.cell[c].duration;
      CellValues<D>& v = values_[c];
      evaluate_cell(chain_.node[c], chain_.node[c + 1], h, v);
      Local a = Local::Zero();
      LocalVector b = LocalVector::Zero(), grad = LocalVector::Zero();
      double tt = h, tg = h;  // a duration is its own second derivative with respect to its logarithm
      const Slacks& g = slack_[c];
      const Slacks& l = dual_[c];
      std::size_t at = 30;
      for (std::size_t r = 0; r < CellBasis::rows; ++r) {
        const int order = basis.order[r];
        const double* row = basis.row[r];
        double w[D][D] = {};   // curvature matrix with respect to the row's value
        double force[D] = {};  // gradient of the barrier
        bool full = false;
        if (r < 30) {
          if (r < 17 && !tube_row(c, r)) continue;
          full = true;
          constraints(c, r, v.q[r],
                      [&](std::size_t s, const std::array<double, D>& grad_q, double round, const double* u) {
                        for (int k = 0; k < D; ++k) {
                          force[k] -= mu / g[s] * grad_q[k];
                          for (int m = 0; m < D; ++m)
                            w[k][m] += l[s] / g[s] * grad_q[k] * grad_q[m] - (u ? l[s] * round * u[k] * u[m] : 0);
                          w[k][k] += l[s] * round;
                        }
                      });
        } else {
          for (int k = 0; k < D; ++k) {
            const double scale = 1 / limits_.derivative[static_cast<std::size_t>(order - 2)][k];
            const std::size_t s = at + 2 * static_cast<std::size_t>(k);
            force[k] = mu * (1 / g[s] - 1 / g[s + 1]) * scale;
            w[k][k] = (l[s] / g[s] + l[s + 1] / g[s + 1]) * scale * scale;
          }
          at += 2 * D;
        }
        // The row's value is H^−r Σ row · H^p · state: with respect to ln H it changes by (p − r) of each term.
        const double power = v.power[order], power2 = power * power;
        double dt[D] = {};
        for (int e = 0; e < 8; ++e) {
          const double f = (e % 4 - order) * row[e] * power;
          for (int k = 0; k < D; ++k) dt[k] += f * v.y[e][k];
        }
        for (int k = 0; k < D; ++k) tg += force[k] * dt[k];
        double wdt[D] = {};
        for (int k = 0; k < D; ++k) {
          for (int m = 0; m < D; ++m) wdt[k] += w[k][m] * dt[m];
          tt += wdt[k] * dt[k];
        }
        for (int e = 0; e < 8; ++e) {
          if (row[e] == 0) continue;
          const double f = row[e] * power;
          for (int k = 0; k < D; ++k) {
            grad(e * D + k) += f * force[k];
            b(e * D + k) += f * wdt[k];
          }
          const double f2 = row[e] * power2;
          for (int e2 = 0; e2 <= e; ++e2) {
            const double ff = f2 * row[e2];
            if (full) {
              for (int k = 0; k < D; ++k)
                for (int m = 0; m < D; ++m) a(e * D + k, e2 * D + m) += ff * w[k][m];
            } else {
              for (int k = 0; k < D; ++k) a(e * D + k, e2 * D + k) += ff * w[k][k];
            }
          }
        }
      }
      if (g[S - 1] < no_limit) {
        tg -= mu / g[S - 1];
        tt += l[S - 1] / g[S - 1];
      }
      // From the cell's own time to time itself, and what is given is no unknown.
      double scale[8];
      scale[0] = scale[4] = 1;
      for (int p = 1; p < 4; ++p) scale[p] = scale[4 + p] = scale[p - 1] * h;
      for (int e = 0; e < 8; ++e) {
        const ChainNode<D>& node = chain_.node[c + (e >= 4)];
        if (component_given(node, e % 4)) scale[e] = 0;
      }
      tt = tt * (1 + damping_) + stiffness_ * h;
      if (!(tt > 0)) return false;
      tau_diag_[c] = tt;
      tau_rhs_[c] = -tg;
      for (int i = 0; i < L; ++i) {
        b(i) *= scale[i / D];
        grad(i) *= scale[i / D];
      }
      tau_row_[c] = b;
      for (int i = 0; i < L; ++i)
        for (int j = 0; j <= i; ++j) {
          const double x = a(i, j) * scale[i / D] * scale[j / D] - b(i) * b(j) / tt;
          a(i, j) = a(j, i) = x;
        }
      diag_[c] += a.template topLeftCorner<N, N>();
      diag_[c + 1] += a.template bottomRightCorner<N, N>();
      off_[c] = a.template topRightCorner<N, N>();
      const LocalVector push = -grad + b * (tg / tt);
      rhs_[c] += push.template head<N>();
      rhs_[c + 1] += push.template tail<N>();
    }
    for (std::size_t n = 0; n <= cells_; ++n) {
      const ChainNode<D>& node = chain_.node[n];
      if (ball_[n] < no_limit) {
        const double r2 = ball_radius(node) * ball_radius(node);
        double grad[D];
        for (int k = 0; k < D; ++k)
          grad[k] = -2 * (node.state[0][k] - limits_.points[static_cast<std::size_t>(node.point)][k]) / r2;
        for (int k = 0; k < D; ++k) {
          rhs_[n](k) += mu / ball_[n] * grad[k];
          diag_[n](k, k) += ball_dual_[n] * 2 / r2;
          for (int m = 0; m < D; ++m) diag_[n](k, m) += ball_dual_[n] / ball_[n] * grad[k] * grad[m];
        }
      }
      for (int i = 0; i < N; ++i) {
        diag_[n](i, i) = component_given(node, i / D) ? 1 : diag_[n](i, i) * (1 + damping_);
      }
    }
    return true;
  }

  bool solve() {
    factor_.resize(cells_ + 1);
    coupling_.resize(cells_);
    Block d = diag_[0];
    for (std::size_t n = 0; n <= cells_; ++n) {
      factor_[n].compute(d);
      if (factor_[n].info() != Eigen::Success) return false;
      step_[n] = rhs_[n];
      if (n > 0) step_[n].noalias() -= coupling_[n - 1].transpose() * step_[n - 1];
      factor_[n].matrixL().solveInPlace(step_[n]);
      if (n < cells_) {
        coupling_[n] = off_[n];
        factor_[n].matrixL().solveInPlace(coupling_[n]);
        d = diag_[n + 1];
        d.noalias() -= coupling_[n].transpose() * coupling_[n];
      }
    }
    for (std::size_t n = cells_ + 1; n-- > 0;) {
      if (n < cells_) step_[n].noalias() -= coupling_[n] * step_[n + 1];
      factor_[n].matrixU().solveInPlace(step_[n]);
      if (!step_[n].allFinite()) return false;
    }
    for (std::size_t c = 0; c < cells_; ++c)
      tau_step_[c] = (tau_rhs_[c] - tau_row_[c].template head<N>().dot(step_[c]) -
                      tau_row_[c].template tail<N>().dot(step_[c + 1])) /
                     tau_diag_[c];
    return true;
  }

  void row_steps(std::size_t c, double (&dq)[CellBasis::rows][D]) const {
    const CellBasis& basis = cell_basis();
    const CellValues<D>& v = values_[c];
    const double h = chain_.cell[c].duration;
    double dy[8][D];
    double up = 1;
    for (int p = 0; p < 4; ++p, up *= h)
      for (int k = 0; k < D; ++k) {
        dy[p][k] = step_[c](p * D + k) * up;
        dy[4 + p][k] = step_[c + 1](p * D + k) * up;
      }
    for (std::size_t r = 0; r < CellBasis::rows; ++r) {
      const int order = basis.order[r];
      double sum[D] = {};
      for (int e = 0; e < 8; ++e)
        for (int k = 0; k < D; ++k) sum[k] += basis.row[r][e] * (dy[e][k] + (e % 4 - order) * v.y[e][k] * tau_step_[c]);
      for (int k = 0; k < D; ++k) dq[r][k] = sum[k] * v.power[order];
    }
  }

  // The state after a step. Motion that is quicker by e^r near the node has derivatives that are e^r, e^2r, e^3r times
  // as large: the step follows these powers and what is left of it is scaled by them. To first order that is the step
  // itself; a step that is taken linearly would tear states and durations of short cells apart.
  void move_node(std::size_t n, double alpha, bool powers, ChainNode<D>& node) const {
    if (node.given) return;
    double rate = n > 0 ? -tau_step_[n - 1] : -tau_step_[n];
    if (n > 0 && n < cells_) rate = (rate - tau_step_[n]) / 2;
    if (!powers) rate = 0;
    const double factor = std::exp(alpha * rate);
    double power = 1;
    for (int p = 0; p < 4; ++p, power *= factor)
      for (int k = 0; k < D; ++k) {
        double& x = node.state[p][k];
        x = power * (x + alpha * (step_[n](p * D + k) - p * rate * x));
      }
  }

  double line_search(double mu) {
    // Linear changes of the slacks, and the largest steps that keep slacks and multipliers positive.
    constexpr double keep = 0.005;
    double alpha = 1, alpha_dual = 1, slope = 0;
    std::vector<Slacks>& change = change_;
    change.resize(cells_);
    const auto visit = [&](double g, double l, double dg) {
      slope -= mu / g * dg;
      if (dg < -(1 - keep) * g) alpha = std::min(alpha, -(1 - keep) * g / dg);
      const double dl = mu / g - l - l / g * dg;
      if (dl < -(1 - keep) * l) alpha_dual = std::min(alpha_dual, -(1 - keep) * l / dl);
    };
    for (std::size_t c = 0; c < cells_; ++c) {
      double dq[CellBasis::rows][D];
      row_steps(c, dq);
      slope += chain_.cell[c].duration * tau_step_[c];
      if (std::abs(tau_step_[c]) > 1) alpha = std::min(alpha, 1 / std::abs(tau_step_[c]));
      Slacks& dg = change[c];
      dg.fill(0);
      for (std::size_t r = 0; r < 30; ++r)
        constraints(c, r, values_[c].q[r],
                    [&](std::size_t s, const std::array<double, D>& grad, double, const double*) {
                      for (int k = 0; k < D; ++k) dg[s] += grad[k] * dq[r][k];
                    });
      std::size_t at = 30;
      for (std::size_t r = 30; r < CellBasis::rows; ++r)
        for (int k = 0; k < D; ++k) {
          const double x = dq[r][k] / limits_.derivative[static_cast<std::size_t>(cell_basis().order[r] - 2)][k];
          dg[at++] = -x;
          dg[at++] = x;
        }
      dg[at] = tau_step_[c];
      for (std::size_t s = 0; s < S; ++s)
        if (slack_[c][s] < no_limit) visit(slack_[c][s], dual_[c][s], dg[s]);
    }
    ball_change_.assign(cells_ + 1, 0);
    for (std::size_t n = 0; n <= cells_; ++n) {
      if (ball_[n] >= no_limit) continue;
      const double r2 = ball_radius(chain_.node[n]) * ball_radius(chain_.node[n]);
      for (int k = 0; k < D; ++k)
        ball_change_[n] -=
            2 * (chain_.node[n].state[0][k] - limits_.points[static_cast<std::size_t>(chain_.node[n].point)][k]) / r2 *
            step_[n](k);
      visit(ball_[n], ball_dual_[n], ball_change_[n]);
    }
    decrease_ = -slope;
    const double before = merit(chain_, slack_, ball_, mu);
    bool moved = false;
    for (int attempt = 0; attempt < 60; ++attempt) {
      // Each length is tried both ways: along the powers of the change of speed, then straight.
      const bool powers = attempt % 2 == 0;
      if (powers && attempt > 0) alpha *= attempt < 8 ? 0.7 : 0.4;
      trial_ = chain_;
      for (std::size_t n = 0; n <= cells_; ++n) move_node(n, alpha, powers, trial_.node[n]);
      for (std::size_t c = 0; c < cells_; ++c) trial_.cell[c].duration *= std::exp(alpha * tau_step_[c]);
      if (!slacks_of(trial_, trial_slack_, trial_ball_)) continue;
      const double after = merit(trial_, trial_slack_, trial_ball_, mu);
      if (after > before + 1e-4 * alpha * slope + 1e-12 * std::abs(before)) continue;
      moved = true;
      break;
    }
    if (!moved) {
      damping_ = std::min(std::max(damping_ * 100, 1e-6), 1e6);
      return 0;
    }
    for (std::size_t c = 0; c < cells_; ++c)
      for (std::size_t s = 0; s < S; ++s) {
        if (slack_[c][s] >= no_limit) continue;
        update_dual(dual_[c][s], slack_[c][s], change[c][s], trial_slack_[c][s], mu, alpha_dual);
      }
    for (std::size_t n = 0; n <= cells_; ++n)
      if (ball_[n] < no_limit) update_dual(ball_dual_[n], ball_[n], ball_change_[n], trial_ball_[n], mu, alpha_dual);
    std::swap(chain_, trial_);
    std::swap(slack_, trial_slack_);
    std::swap(ball_, trial_ball_);
    stiffness_ = alpha < 0.1    ? std::min(std::max(4 * stiffness_, 0.01), 1e6)
                 : alpha > 0.25 ? 0.25 * stiffness_
                                : stiffness_;
    damping_ = alpha > 0.1 ? std::max(damping_ * 0.1, 1e-10) : damping_;
    return alpha;
  }
  static void update_dual(double& l, double g, double dg, double g_new, double mu, double alpha) {
    l += alpha * (mu / g - l - l / g * dg);
    l = std::clamp(l, 1e-3 * mu / g_new, 1e3 * mu / g_new);
  }

  CellChain<D>& chain_;
  CellChain<D> trial_;
  const ChainLimits<D>& limits_;
  const ChainSolverOptions& options_;
  std::size_t cells_;
  static constexpr double far = 1, soft = 0.3;
  double count_ = 0, damping_ = 0, decrease_ = 0,
         stiffness_ = 0;  // Newton's prediction for the barrier function, twice
  std::vector<Capsule<D>> capsule_;
  std::vector<Slacks> slack_, trial_slack_, dual_, change_;
  std::vector<double> ball_, trial_ball_, ball_dual_, ball_change_;
  std::vector<CellValues<D>> values_;
  std::vector<Block, Eigen::aligned_allocator<Block>> diag_, off_, coupling_;
  std::vector<Vector, Eigen::aligned_allocator<Vector>> rhs_, step_;
  std::vector<Eigen::LLT<Block>, Eigen::aligned_allocator<Eigen::LLT<Block>>> factor_;
  std::vector<Eigen::Matrix<double, L, 1>, Eigen::aligned_allocator<Eigen::Matrix<double, L, 1>>> tau_row_;
  std::vector<double> tau_diag_, tau_rhs_, tau_step_;
};

}  // namespace

template <int D>
ChainSolverReport shorten_chain(CellChain<D>& chain, const ChainLimits<D>& limits, const ChainSolverOptions& options,
                                const std::function<void()>& stop) {
  return Solver<D>(chain, limits, options).run(stop);
}

template <int D>
double slowing_factor(const CellChain<D>& chain, const ChainLimits<D>& limits, double margin) {
  double factor = 0;
  CellValues<D> v;
  for (std::size_t c = 0; c < chain.cell.size(); ++c) {
    evaluate_cell(chain.node[c], chain.node[c + 1], chain.cell[c].duration, v);
    for (std::size_t r = CellBasis::first[1]; r < CellBasis::rows; ++r) {
      const int order = cell_basis().order[r];
      double ratio = 0;
      for (int k = 0; k < D; ++k)
        ratio = order == 1
                    ? std::hypot(ratio, v.q[r][k] / limits.speed)
                    : std::max(ratio, std::abs(v.q[r][k]) / limits.derivative[static_cast<std::size_t>(order - 2)][k]);
      factor = std::max(factor, std::pow(ratio / (1 - margin), 1.0 / order));
    }
  }
  return factor;
}

template <int D>
void slow_down(CellChain<D>& chain, double factor) {
  for (ChainNode<D>& n : chain.node) {
    double scale = 1;
    for (int p = 1; p < 4; ++p) {
      scale /= factor;
      for (int k = 0; k < D; ++k) n.state[p][k] *= scale;
    }
  }
  for (ChainCell& c : chain.cell) c.duration *= factor;
}

#define BAHNWERK_CHAIN(D)                                                                                      \
  template ChainSolverReport shorten_chain<D>(CellChain<D>&, const ChainLimits<D>&, const ChainSolverOptions&, \
                                              const std::function<void()>&);                                   \
  template double slowing_factor<D>(const CellChain<D>&, const ChainLimits<D>&, double);                       \
  template void slow_down<D>(CellChain<D>&, double);
BAHNWERK_CHAIN(1)
BAHNWERK_CHAIN(2)
BAHNWERK_CHAIN(3)
#undef BAHNWERK_CHAIN

}  // namespace bahnwerk
