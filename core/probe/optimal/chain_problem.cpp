#include "core/probe/optimal/chain_problem.hpp"

#include <algorithm>
#include <utility>

namespace bahnwerk {

template <int D>
ChainProblem<D>::ChainProblem(CellChain<D>& chain, const ChainLimits<D>& limits, double shortest)
    : chain_(chain),
      limits_(limits),
      shortest_(shortest),
      values_(chain.cell.size()),
      system_(chain.node.size()),
      step_(chain.node.size()),
      tau_row_(chain.cell.size()),
      tau_diagonal_(chain.cell.size()),
      tau_step_(chain.cell.size()) {
  for (std::size_t e = 0; e + 1 < limits.points.size(); ++e)
    capsule_.push_back(capsule<D>(limits.points[e], limits.points[e + 1], limits.radius(e)));
  Slots slots;
  for (std::size_t c = 0; c < chain.cell.size(); ++c) {
    if (limits.tolerance > 0) {
      slots.tube_from = given(chain.node[c], 0) ? 1 : 0;
      slots.tube_to = given(chain.node[c + 1], 0) ? tube_rows - 1 : tube_rows;
    }
    slots_.push_back(slots);
    slots.begin = slots.end();
  }
  for (std::size_t n = 0; n < chain.node.size(); ++n)
    if (chain.node[n].point >= 0 && !given(chain.node[n], 0)) ball_.push_back(n);
}

template <int D>
template <typename Visit>
void ChainProblem<D>::curved_row(std::size_t c, std::size_t row, const double* q, Visit&& visit) const {
  const Slots& slots = slots_[c];
  std::array<double, D> g{};
  if (row < tube_rows) {
    if (row < slots.tube_from || row >= slots.tube_to) return;
    bool cap;
    const Capsule<D>& set = capsule_[chain_.cell[c].edge];
    const std::array<double, D> d = offset(set, q, cap);
    for (int k = 0; k < D; ++k) g[k] = -2 * d[k] / set.radius2;
    visit(slots.curved(row), g, 2 / set.radius2, cap ? nullptr : set.u.data());
  } else {
    const double v2 = limits_.speed * limits_.speed;
    for (int k = 0; k < D; ++k) g[k] = -2 * q[k] / v2;
    visit(slots.curved(row), g, 2 / v2, nullptr);
  }
}

template <int D>
bool ChainProblem<D>::slacks(const CellChain<D>& chain, std::vector<double>& slack) const {
  slack.resize((slots_.empty() ? 0 : slots_.back().end()) + ball_.size());
  CellValues<D> v;
  for (std::size_t c = 0; c < chain.cell.size(); ++c) {
    evaluate_cell(chain.node[c], chain.node[c + 1], chain.cell[c].duration, v);
    const Slots& slots = slots_[c];
    const Capsule<D>& set = capsule_[chain.cell[c].edge];
    double* out = slack.data() + slots.begin;
    for (std::size_t r = slots.tube_from; r < slots.tube_to; ++r) {
      bool cap;
      const std::array<double, D> d = offset(set, v.q[r], cap);
      double sum = 0;
      for (int k = 0; k < D; ++k) sum += d[k] * d[k];
      *out++ = 1 - sum / set.radius2;
    }
    for (std::size_t r = tube_rows; r < speed_rows; ++r) {
      double sum = 0;
      for (int k = 0; k < D; ++k) sum += v.q[r][k] * v.q[r][k];
      *out++ = 1 - sum / (limits_.speed * limits_.speed);
    }
    for (std::size_t r = speed_rows; r < CellBasis::rows; ++r)
      for (int k = 0; k < D; ++k) {
        const double x = v.q[r][k] / axis_limit(r, k);
        *out++ = 1 - x;
        *out++ = 1 + x;
      }
    *out++ = std::log(chain.cell[c].duration / shortest_);
    double least = out[-1];
    for (const double* g = slack.data() + slots.begin; g != out; ++g) least = std::min(least, *g);
    if (!(least > 0)) return false;
  }
  double* out = slack.data() + slack.size() - ball_.size();
  for (const std::size_t n : ball_) {
    const ChainNode<D>& node = chain.node[n];
    double sum = 0;
    for (int k = 0; k < D; ++k) sum += from_point(node, k) * from_point(node, k);
    *out = 1 - sum / (ball_radius(node) * ball_radius(node));
    if (!(*out++ > 0)) return false;
  }
  return true;
}

/// Computes the cell's part of the matrix and of the gradient of the barrier function; derivatives are with respect to
/// the cell's own time. tau_diagonal_ and tau_step_ receive those of the duration's logarithm.
template <int D>
void ChainProblem<D>::assemble_cell(std::size_t c, const BarrierPoint& at, Local& a, LocalVector& b,
                                    LocalVector& gradient) {
  const CellBasis& basis = cell_basis();
  const double h = chain_.cell[c].duration, mu = at.mu;
  const std::vector<double>&g = at.slack, &l = at.multiplier;
  CellValues<D>& v = values_[c];
  evaluate_cell(chain_.node[c], chain_.node[c + 1], h, v);
  double tt = h, tg = h;  // a duration is its own second derivative with respect to its logarithm
  for (std::size_t r = 0; r < CellBasis::rows; ++r) {
    if (r < tube_rows && (r < slots_[c].tube_from || r >= slots_[c].tube_to)) continue;
    const int order = basis.order[r];
    const double* row = basis.row[r];
    const int from = basis.from[r], to = basis.to[r];
    double w[D][D] = {};   // curvature matrix with respect to the row's value
    double force[D] = {};  // gradient of the barrier
    const bool full = r < speed_rows;
    if (full) {
      curved_row(c, r, v.q[r], [&](std::size_t s, const std::array<double, D>& slope, double round, const double* u) {
        for (int k = 0; k < D; ++k) {
          force[k] -= mu / g[s] * slope[k];
          for (int m = 0; m < D; ++m)
            w[k][m] += l[s] / g[s] * slope[k] * slope[m] - (u ? l[s] * round * u[k] * u[m] : 0);
          w[k][k] += l[s] * round;
        }
      });
    } else {
      for (int k = 0; k < D; ++k) {
        const double scale = 1 / axis_limit(r, k);
        const std::size_t s = slots_[c].axis(r, k);
        force[k] = mu * (1 / g[s] - 1 / g[s + 1]) * scale;
        w[k][k] = (l[s] / g[s] + l[s + 1] / g[s + 1]) * scale * scale;
      }
    }
    // The row's value is H^−r Σ row · H^p · state: with respect to ln H it changes by (p − r) of each term.
    const double power = v.power[order], power2 = power * power;
    double dt[D] = {};
    for (int e = from; e < to; ++e) {
      const double f = (e % 4 - order) * row[e] * power;
      for (int k = 0; k < D; ++k) dt[k] += f * v.y[e][k];
    }
    for (int k = 0; k < D; ++k) tg += force[k] * dt[k];
    double wdt[D] = {};
    for (int k = 0; k < D; ++k) {
      for (int m = 0; m < D; ++m) wdt[k] += w[k][m] * dt[m];
      tt += wdt[k] * dt[k];
    }
    for (int e = from; e < to; ++e) {
      const double f = row[e] * power;
      for (int k = 0; k < D; ++k) {
        gradient(e * D + k) += f * force[k];
        b(e * D + k) += f * wdt[k];
      }
      const double f2 = row[e] * power2;
      for (int e2 = from; e2 <= e; ++e2) {
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
  const std::size_t s = slots_[c].duration();
  tau_step_[c] = -(tg - mu / g[s]);
  tau_diagonal_[c] = (tt + l[s] / g[s]) * (1 + at.damping) + at.stiffness * h;
}

template <int D>
bool ChainProblem<D>::assemble(const BarrierPoint& at) {
  system_.clear();
  for (auto& r : step_) r.setZero();
  for (std::size_t c = 0; c < chain_.cell.size(); ++c) {
    Local a = Local::Zero();
    LocalVector b = LocalVector::Zero(), gradient = LocalVector::Zero();
    assemble_cell(c, at, a, b, gradient);
    const double tt = tau_diagonal_[c];
    if (!(tt > 0)) return false;
    // Derivatives are converted from the cell's own time to time itself; given values are no unknowns.
    double scale[8];
    scale[0] = scale[4] = 1;
    for (int p = 1; p < 4; ++p) scale[p] = scale[4 + p] = scale[p - 1] * chain_.cell[c].duration;
    for (int e = 0; e < 8; ++e)
      if (given(chain_.node[c + (e >= 4)], e % 4)) scale[e] = 0;
    for (int i = 0; i < L; ++i) {
      b(i) *= scale[i / D];
      gradient(i) *= scale[i / D];
    }
    tau_row_[c] = b;
    for (int i = 0; i < L; ++i)
      for (int j = 0; j <= i; ++j) {
        const double x = a(i, j) * scale[i / D] * scale[j / D] - b(i) * b(j) / tt;
        a(i, j) = a(j, i) = x;
      }
    system_.diagonal(c) += a.template topLeftCorner<N, N>();
    system_.diagonal(c + 1) += a.template bottomRightCorner<N, N>();
    system_.above(c) = a.template topRightCorner<N, N>();
    const LocalVector push = -gradient - b * (tau_step_[c] / tt);
    step_[c] += push.template head<N>();
    step_[c + 1] += push.template tail<N>();
  }
  assemble_nodes(at);
  return true;
}

template <int D>
void ChainProblem<D>::assemble_nodes(const BarrierPoint& at) {
  std::size_t s = at.slack.size() - ball_.size();
  for (const std::size_t n : ball_) {
    const double r2 = ball_radius(chain_.node[n]) * ball_radius(chain_.node[n]);
    double slope[D];
    for (int k = 0; k < D; ++k) slope[k] = -2 * from_point(chain_.node[n], k) / r2;
    for (int k = 0; k < D; ++k) {
      step_[n](k) += at.mu / at.slack[s] * slope[k];
      system_.diagonal(n)(k, k) += at.multiplier[s] * 2 / r2;
      for (int m = 0; m < D; ++m) system_.diagonal(n)(k, m) += at.multiplier[s] / at.slack[s] * slope[k] * slope[m];
    }
    ++s;
  }
  for (std::size_t n = 0; n < chain_.node.size(); ++n)
    for (int i = 0; i < N; ++i) {
      double& x = system_.diagonal(n)(i, i);
      x = given(chain_.node[n], i / D) ? 1 : x * (1 + at.damping);
    }
}

template <int D>
bool ChainProblem<D>::solve() {
  if (!system_.factor() || !system_.solve(step_)) return false;
  for (std::size_t c = 0; c < chain_.cell.size(); ++c)
    tau_step_[c] = (tau_step_[c] - tau_row_[c].template head<N>().dot(step_[c]) -
                    tau_row_[c].template tail<N>().dot(step_[c + 1])) /
                   tau_diagonal_[c];
  return true;
}

/// Computes the changes of the values of the cell's rows to first order.
template <int D>
void ChainProblem<D>::row_steps(std::size_t c, double (&dq)[CellBasis::rows][D]) const {
  const CellBasis& basis = cell_basis();
  const CellValues<D>& v = values_[c];
  double dy[8][D];
  double up = 1;
  for (int p = 0; p < 4; ++p, up *= chain_.cell[c].duration)
    for (int k = 0; k < D; ++k) {
      dy[p][k] = step_[c](p * D + k) * up;
      dy[4 + p][k] = step_[c + 1](p * D + k) * up;
    }
  for (std::size_t r = 0; r < CellBasis::rows; ++r) {
    const int order = basis.order[r];
    double sum[D] = {};
    for (int e = basis.from[r]; e < basis.to[r]; ++e)
      for (int k = 0; k < D; ++k) sum[k] += basis.row[r][e] * (dy[e][k] + (e % 4 - order) * v.y[e][k] * tau_step_[c]);
    for (int k = 0; k < D; ++k) dq[r][k] = sum[k] * v.power[order];
  }
}

template <int D>
double ChainProblem<D>::changes(std::vector<double>& change) const {
  double slope = 0;
  for (std::size_t c = 0; c < chain_.cell.size(); ++c) {
    double dq[CellBasis::rows][D];
    row_steps(c, dq);
    slope += chain_.cell[c].duration * tau_step_[c];
    for (std::size_t r = 0; r < speed_rows; ++r)
      curved_row(c, r, values_[c].q[r],
                 [&](std::size_t s, const std::array<double, D>& gradient, double, const double*) {
                   change[s] = 0;
                   for (int k = 0; k < D; ++k) change[s] += gradient[k] * dq[r][k];
                 });
    for (std::size_t r = speed_rows; r < CellBasis::rows; ++r)
      for (int k = 0; k < D; ++k) {
        const double x = dq[r][k] / axis_limit(r, k);
        const std::size_t s = slots_[c].axis(r, k);
        change[s] = -x;
        change[s + 1] = x;
      }
    change[slots_[c].duration()] = tau_step_[c];
  }
  std::size_t s = change.size() - ball_.size();
  for (const std::size_t n : ball_) {
    const double r2 = ball_radius(chain_.node[n]) * ball_radius(chain_.node[n]);
    change[s] = 0;
    for (int k = 0; k < D; ++k) change[s] -= 2 * from_point(chain_.node[n], k) / r2 * step_[n](k);
    ++s;
  }
  return slope;
}

template <int D>
double ChainProblem<D>::longest() const {
  double most = 1;
  for (const double longer : tau_step_) most = std::max(most, std::abs(longer));
  return 1 / most;
}

/// The first curve: motion that is quicker by e^r near the node has derivatives that are e^r, e^2r, e^3r times as
/// large; the step follows these powers, and what is left of it is scaled by them. To first order that is the step
/// itself, which is the second curve: taken linearly, a step tears states and durations of short cells apart.
template <int D>
void ChainProblem<D>::move_node(std::size_t n, double length, bool powers, ChainNode<D>& node) const {
  if (node.given) return;
  double rate = n > 0 ? -tau_step_[n - 1] : -tau_step_[n];
  if (n > 0 && n < tau_step_.size()) rate = (rate - tau_step_[n]) / 2;
  if (!powers) rate = 0;
  const double factor = std::exp(length * rate);
  double power = 1;
  for (int p = 0; p < 4; ++p, power *= factor)
    for (int k = 0; k < D; ++k) {
      double& x = node.state[p][k];
      x = power * (x + length * (step_[n](p * D + k) - p * rate * x));
    }
}

template <int D>
bool ChainProblem<D>::go(double length, std::size_t curve, std::vector<double>& slack, double& objective) {
  trial_ = chain_;
  for (std::size_t n = 0; n < trial_.node.size(); ++n) move_node(n, length, curve == 0, trial_.node[n]);
  for (std::size_t c = 0; c < trial_.cell.size(); ++c) trial_.cell[c].duration *= std::exp(length * tau_step_[c]);
  objective = trial_.duration();
  return slacks(trial_, slack);
}

template class ChainProblem<1>;
template class ChainProblem<2>;
template class ChainProblem<3>;

}  // namespace bahnwerk
