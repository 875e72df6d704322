#include "core/probe/optimal/chain_newton.hpp"

#include <algorithm>

namespace bahnwerk {

template <int D>
ChainNewton<D>::ChainNewton(const ChainConstraints<D>& constraints, std::size_t cells)
    : constraints_(constraints),
      values_(cells),
      diag_(cells + 1),
      off_(cells),
      coupling_(cells),
      rhs_(cells + 1),
      step_(cells + 1),
      factor_(cells + 1),
      tau_row_(cells),
      tau_diag_(cells),
      tau_rhs_(cells),
      tau_step_(cells) {}

template <int D>
bool ChainNewton<D>::assemble(const CellChain<D>& chain, const Slacks& slack, const Slacks& dual,
                              const Barrier& barrier) {
  const double mu = barrier.mu;
  const std::size_t cells = chain.cell.size();
  for (auto& d : diag_) d.setZero();
  for (auto& r : rhs_) r.setZero();
  const CellBasis& basis = cell_basis();
  using Local = Eigen::Matrix<double, L, L>;
  using LocalVector = Eigen::Matrix<double, L, 1>;
  for (std::size_t c = 0; c < cells; ++c) {
    const double h = chain.cell[c].duration;
    CellValues<D>& v = values_[c];
    evaluate_cell(chain.node[c], chain.node[c + 1], h, v);
    Local a = Local::Zero();
    LocalVector b = LocalVector::Zero(), grad = LocalVector::Zero();
    double tt = h, tg = h;  // a duration is its own second derivative with respect to its logarithm
    const auto& g = slack.cell[c];
    const auto& l = dual.cell[c];
    std::size_t at = 30;
    for (std::size_t r = 0; r < CellBasis::rows; ++r) {
      const int order = basis.order[r];
      const double* row = basis.row[r];
      const int from = basis.from[r], to = basis.to[r];
      double w[D][D] = {};   // curvature matrix with respect to the row's value
      double force[D] = {};  // gradient of the barrier
      bool full = false;
      if (r < 30) {
        if (r < 17 && !constraints_.tube_row(chain, c, r)) continue;
        full = true;
        constraints_.curved(chain, c, r, v.q[r],
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
          const double scale = 1 / constraints_.derivative_limit(r, k);
          const std::size_t s = at + 2 * static_cast<std::size_t>(k);
          force[k] = mu * (1 / g[s] - 1 / g[s + 1]) * scale;
          w[k][k] = (l[s] / g[s] + l[s + 1] / g[s + 1]) * scale * scale;
        }
        at += 2 * D;
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
          grad(e * D + k) += f * force[k];
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
    if (g.back() < Slacks::unlimited_slack) {
      tg -= mu / g.back();
      tt += l.back() / g.back();
    }
    // Derivatives are converted from the cell's own time to time itself; given values are no unknowns.
    double scale[8];
    scale[0] = scale[4] = 1;
    for (int p = 1; p < 4; ++p) scale[p] = scale[4 + p] = scale[p - 1] * h;
    for (int e = 0; e < 8; ++e) {
      const ChainNode<D>& node = chain.node[c + (e >= 4)];
      if (constraints_.component_given(node, e % 4)) scale[e] = 0;
    }
    tt = tt * (1 + barrier.damping) + barrier.stiffness * h;
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
  for (std::size_t n = 0; n <= cells; ++n) {
    const ChainNode<D>& node = chain.node[n];
    if (slack.ball[n] < Slacks::unlimited_slack) {
      const double r2 = constraints_.ball_radius(node) * constraints_.ball_radius(node);
      double grad[D];
      for (int k = 0; k < D; ++k) grad[k] = -2 * constraints_.from_point(node, k) / r2;
      for (int k = 0; k < D; ++k) {
        rhs_[n](k) += mu / slack.ball[n] * grad[k];
        diag_[n](k, k) += dual.ball[n] * 2 / r2;
        for (int m = 0; m < D; ++m) diag_[n](k, m) += dual.ball[n] / slack.ball[n] * grad[k] * grad[m];
      }
    }
    for (int i = 0; i < N; ++i) {
      diag_[n](i, i) = constraints_.component_given(node, i / D) ? 1 : diag_[n](i, i) * (1 + barrier.damping);
    }
  }
  return true;
}

template <int D>
bool ChainNewton<D>::solve() {
  const std::size_t cells = tau_diag_.size();
  Block d = diag_[0];
  for (std::size_t n = 0; n <= cells; ++n) {
    factor_[n].compute(d);
    if (factor_[n].info() != Eigen::Success) return false;
    step_[n] = rhs_[n];
    if (n > 0) step_[n].noalias() -= coupling_[n - 1].transpose() * step_[n - 1];
    factor_[n].matrixL().solveInPlace(step_[n]);
    if (n < cells) {
      coupling_[n] = off_[n];
      factor_[n].matrixL().solveInPlace(coupling_[n]);
      d = diag_[n + 1];
      d.noalias() -= coupling_[n].transpose() * coupling_[n];
    }
  }
  for (std::size_t n = cells + 1; n-- > 0;) {
    if (n < cells) step_[n].noalias() -= coupling_[n] * step_[n + 1];
    factor_[n].matrixU().solveInPlace(step_[n]);
    if (!step_[n].allFinite()) return false;
  }
  for (std::size_t c = 0; c < cells; ++c)
    tau_step_[c] = (tau_rhs_[c] - tau_row_[c].template head<N>().dot(step_[c]) -
                    tau_row_[c].template tail<N>().dot(step_[c + 1])) /
                   tau_diag_[c];
  return true;
}

template <int D>
void ChainNewton<D>::row_steps(const CellChain<D>& chain, std::size_t c, double (&dq)[CellBasis::rows][D]) const {
  const CellBasis& basis = cell_basis();
  const CellValues<D>& v = values_[c];
  const double h = chain.cell[c].duration;
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
    for (int e = basis.from[r]; e < basis.to[r]; ++e)
      for (int k = 0; k < D; ++k) sum[k] += basis.row[r][e] * (dy[e][k] + (e % 4 - order) * v.y[e][k] * tau_step_[c]);
    for (int k = 0; k < D; ++k) dq[r][k] = sum[k] * v.power[order];
  }
}

template class ChainNewton<1>;
template class ChainNewton<2>;
template class ChainNewton<3>;

}  // namespace bahnwerk
