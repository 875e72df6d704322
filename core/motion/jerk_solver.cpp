#include "core/motion/jerk_solver.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {

namespace {

constexpr double stuck_step = 0.05;
constexpr int stuck_steps = 3;

/// One 4-vector of derivatives by (b1, a1, b2, a2) per row is t·path + a part of its own on one node.
struct Matrix4 {
  double m00 = 0, m01 = 0, m11 = 0, m02 = 0, m03 = 0, m12 = 0, m13 = 0, m22 = 0, m23 = 0, m33 = 0;
  std::array<double, 4> r{};
};

}  // namespace

template <int M>
void JerkSolver<M>::evaluate(std::size_t c) {
  const auto& x = *x_;
  const double h = problem_->cells[c].h;
  if (c == 0)
    cell_[c] = rest_cell(x[1].b, h, 1);
  else if (c + 1 == n_)
    cell_[c] = rest_cell(x[c].b, h, 0);
  else
    cell_[c] = jerk_cell(x[c], x[c + 1], h);
}

/// Linearisation of one set of rows: value g_k and gradient t_k · path + (b_k, a_k) on the node at `at` (0 or 2).
template <int M>
struct Linear {
  std::array<double, M> g, t, nb, na;
};

template <int M>
inline Linear<M> jerk_rows(const JerkStation<M>& s, JerkNode x, double j, const std::array<double, M>& inverse_jerk) {
  const double v = std::sqrt(x.b), va = v * x.a, vb = x.b * v, w = x.b > 0 ? 1.5 * x.a / v : 0;
  Linear<M> row;
  for (std::size_t k = 0; k < M; ++k) {
    const double i = inverse_jerk[k], d1 = i * s.d1[k], d2 = i * s.d2[k], d3 = i * s.d3[k];
    row.g[k] = d3 * vb + 3 * d2 * va + d1 * j;
    row.t[k] = d1;
    row.nb[k] = 1.5 * d3 * v + d2 * w;
    row.na[k] = 3 * d2 * v;
  }
  return row;
}

/// The middle Bernstein coefficient of a(t), with its gradient.
struct Middle {
  double g = 0;
  std::array<double, 4> dg{};
};
inline Middle middle_state(JerkNode l, JerkNode r, const JerkCell& cell) {
  const double v1 = std::sqrt(l.b), v2 = std::sqrt(r.b), u = 1 / cell.T, mean = (v2 - v1) * u;
  const double gT = -3 * mean * u;
  return {3 * mean - l.a - r.a,
          {gT * cell.dT[0] - 1.5 * u / v1, gT * cell.dT[1] - 1, gT * cell.dT[2] + 1.5 * u / v2, gT * cell.dT[3] - 1}};
}

/// Visits the two jerk rows' sets of a cell: (rows, shares, linearisation, path gradient, node offset).
template <int M>
template <class Visit>
void JerkSolver<M>::cell_rows(std::size_t c, Visit&& visit) {
  const auto& cell = problem_->cells[c];
  const auto& x = *x_;
  visit(jerk_[2 * c], cell.share[0],
        jerk_rows<M>(problem_->stations[cell.station], x[c], cell_[c].j1, problem_->inverse_jerk), cell_[c].dj1,
        std::size_t{0});
  visit(jerk_[2 * c + 1], cell.share[1],
        jerk_rows<M>(problem_->stations[cell.station + 1], x[c + 1], cell_[c].j2, problem_->inverse_jerk), cell_[c].dj2,
        std::size_t{2});
}

template <int M>
void JerkSolver<M>::start(double mu, PlanningPulse& pulse) {
  const auto& p = *problem_;
  const auto& x = *x_;
  n_ = p.cells.size();
  dx_.assign(n_ + 1, {});
  cell_.resize(n_);
  jerk_.resize(2 * n_);
  node_.resize(p.nodes.size());
  cap_.resize(n_ + 1);
  elimination_.resize(n_ + 1);
  weight_.resize(n_);
  for (std::size_t c = 0; c < n_; ++c) {
    evaluate(c);
    weight_[c] = cell_[c].T;
  }
  // A slack starts at what is free, but not too near the wall.
  const double least = std::min(0.1, mu);
  const auto begin = [&](Rows& rows, const std::array<double, M>& share, std::size_t k, double target) {
    rows.sp[k] = std::max(share[k] - rows.g[k], least);
    rows.sm[k] = std::max(share[k] + rows.g[k], least);
    rows.zp[k] = target / rows.sp[k];
    rows.zm[k] = target / rows.sm[k];
    rows.d[k] = 0;
  };
  scale_ = 0;
  for (std::size_t c = 0; c < n_; ++c) {
    pulse(c, n_);
    cell_rows(c, [&](Rows& rows, const auto& share, const Linear<M>& row, const auto&, std::size_t) {
      rows.g = row.g;
      for (std::size_t k = 0; k < M; ++k) begin(rows, share, k, mu * weight_[c]);
      scale_ += 2 * M * weight_[c];
    });
  }
  for (std::size_t i = 0; i < p.nodes.size(); ++i) {
    const auto& set = p.nodes[i];
    const double w = weight(set.node);
    for (std::size_t k = 0; k < M; ++k) {
      node_[i].g[k] = set.p[k] * x[set.node].b + set.q[k] * x[set.node].a;
      begin(node_[i], set.share, k, mu * w);
    }
    scale_ += 2 * M * w;
  }
  start_middles(mu);
  for (std::size_t i = 1; i < n_; ++i) {
    for (std::size_t e = 0; e < 2; ++e) {
      cap_[i].s[e] = std::max(1 - (x[i].b + cap_slope(i, e) * x[i].a) * p.inverse_cap[i][e], least);
      cap_[i].z[e] = mu * weight(i) / cap_[i].s[e];
    }
    scale_ += 2 * weight(i);
  }
}

/// Rows for cells' middles may come later than the others.
template <int M>
void JerkSolver<M>::start_middles(double mu) {
  const auto& p = *problem_;
  const auto& x = *x_;
  const double least = std::min(0.1, mu);
  middle_.resize(p.middles.size());
  for (std::size_t i = 0; i < p.middles.size(); ++i) {
    const auto& set = p.middles[i];
    const Middle m = middle_state(x[set.cell], x[set.cell + 1], cell_[set.cell]);
    for (std::size_t k = 0; k < M; ++k) {
      middle_[i].g[k] = set.d2[k] * (x[set.cell].b + x[set.cell + 1].b) + set.d1[k] * m.g;
      Rows& rows = middle_[i];
      rows.sp[k] = std::max(set.share[k] - rows.g[k], least);
      rows.sm[k] = std::max(set.share[k] + rows.g[k], least);
      rows.zp[k] = mu * weight_[set.cell] / rows.sp[k];
      rows.zm[k] = mu * weight_[set.cell] / rows.sm[k];
      rows.d[k] = 0;
    }
    scale_ += 2 * M * weight_[set.cell];
  }
}

template <int M>
void JerkSolver<M>::assemble(double target, PlanningPulse& pulse) {
  const auto& p = *problem_;
  const auto& x = *x_;
  double duration = 0, gap = 0, violation = 0;
  std::size_t next_node = 0, next_middle = 0;
  Block now, after;
  std::array<double, M> w, y;
  const auto weigh = [&](Rows& rows, const std::array<double, M>& share, double mu) {
    for (std::size_t k = 0; k < M; ++k) {
      const double rp = rows.g[k] + rows.sp[k] - share[k], rm = rows.sm[k] - rows.g[k] - share[k];
      const double ip = 1 / rows.sp[k], im = 1 / rows.sm[k];
      w[k] = rows.zp[k] * ip + rows.zm[k] * im;
      y[k] = (mu + rows.zp[k] * rp) * ip - (mu + rows.zm[k] * rm) * im;
      gap += rows.sp[k] * rows.zp[k] + rows.sm[k] * rows.zm[k];
      violation = std::max(violation, std::max(std::abs(rp), std::abs(rm)));
    }
  };
  for (std::size_t c = 0; c < n_; ++c) {
    pulse(c, n_);
    now = after;
    const double h = p.cells[c].h;
    if (c > 0) {
      const double b = x[c].b, ib = 1 / b;
      now.bb += 0.375 * (p.cells[c - 1].h + h) * ib * ib * std::sqrt(ib);
      const Cap& cap = cap_[c];
      const double mu = target * weight(c);
      for (std::size_t e = 0; e < 2; ++e) {
        const double is = 1 / cap.s[e], i = p.inverse_cap[c][e], q = i * cap_slope(c, e);
        const double residual = b * i + x[c].a * q + cap.s[e] - 1, w1 = cap.z[e] * is;
        const double y1 = (mu + cap.z[e] * residual) * is;
        now.bb += w1 * i * i;
        now.ba += w1 * i * q;
        now.aa += w1 * q * q;
        now.rb -= y1 * i;
        now.ra -= y1 * q;
        gap += cap.s[e] * cap.z[e];
        violation = std::max(violation, std::abs(residual));
      }
      for (; next_node < p.nodes.size() && p.nodes[next_node].node == c; ++next_node) {
        const auto& set = p.nodes[next_node];
        Rows& rows = node_[next_node];
        for (std::size_t k = 0; k < M; ++k) rows.g[k] = set.p[k] * b + set.q[k] * x[c].a;
        weigh(rows, set.share, mu);
        for (std::size_t k = 0; k < M; ++k) {
          const double wp = w[k] * set.p[k], wq = w[k] * set.q[k];
          now.bb += wp * set.p[k];
          now.ba += wp * set.q[k];
          now.aa += wq * set.q[k];
          now.rb -= y[k] * set.p[k];
          now.ra -= y[k] * set.q[k];
        }
      }
    }
    evaluate(c);
    const JerkCell& law = cell_[c];
    duration += law.T;
    Matrix4 K;
    for (std::size_t i = 0; i < 4; ++i) K.r[i] = -law.dT[i];
    const auto add_path = [&](const std::array<double, 4>& q, double s, double r) {
      const double q0 = s * q[0], q1 = s * q[1], q2 = s * q[2];
      K.m00 += q0 * q[0];
      K.m01 += q0 * q[1];
      K.m02 += q0 * q[2];
      K.m03 += q0 * q[3];
      K.m11 += q1 * q[1];
      K.m12 += q1 * q[2];
      K.m13 += q1 * q[3];
      K.m22 += q2 * q[2];
      K.m23 += q2 * q[3];
      K.m33 += s * q[3] * q[3];
      for (std::size_t i = 0; i < 4; ++i) K.r[i] -= r * q[i];
    };
    cell_rows(c,
              [&](Rows& rows, const auto& share, const Linear<M>& row, const std::array<double, 4>& q, std::size_t at) {
                rows.g = row.g;
                weigh(rows, share, target * weight_[c]);
                double tt = 0, tb = 0, ta = 0, bb = 0, ba = 0, aa = 0, yt = 0, yb = 0, ya = 0;
                for (std::size_t k = 0; k < M; ++k) {
                  const double wt = w[k] * row.t[k], wb = w[k] * row.nb[k];
                  tt += wt * row.t[k];
                  tb += wt * row.nb[k];
                  ta += wt * row.na[k];
                  bb += wb * row.nb[k];
                  ba += wb * row.na[k];
                  aa += w[k] * row.na[k] * row.na[k];
                  yt += y[k] * row.t[k];
                  yb += y[k] * row.nb[k];
                  ya += y[k] * row.na[k];
                }
                add_path(q, tt, yt);
                if (at == 0) {
                  K.m00 += 2 * tb * q[0] + bb;
                  K.m01 += tb * q[1] + ta * q[0] + ba;
                  K.m11 += 2 * ta * q[1] + aa;
                  K.m02 += tb * q[2];
                  K.m03 += tb * q[3];
                  K.m12 += ta * q[2];
                  K.m13 += ta * q[3];
                } else {
                  K.m22 += 2 * tb * q[2] + bb;
                  K.m23 += tb * q[3] + ta * q[2] + ba;
                  K.m33 += 2 * ta * q[3] + aa;
                  K.m02 += tb * q[0];
                  K.m12 += tb * q[1];
                  K.m03 += ta * q[0];
                  K.m13 += ta * q[1];
                }
                K.r[at] -= yb;
                K.r[at + 1] -= ya;
              });
    for (; next_middle < p.middles.size() && p.middles[next_middle].cell == c; ++next_middle) {
      const auto& set = p.middles[next_middle];
      Rows& rows = middle_[next_middle];
      const Middle m = middle_state(x[c], x[c + 1], law);
      const double b = x[c].b + x[c + 1].b;
      for (std::size_t k = 0; k < M; ++k) rows.g[k] = set.d2[k] * b + set.d1[k] * m.g;
      weigh(rows, set.share, target * weight_[c]);
      double tt = 0, tb = 0, bb = 0, yt = 0, yb = 0;
      for (std::size_t k = 0; k < M; ++k) {
        const double wt = w[k] * set.d1[k];
        tt += wt * set.d1[k];
        tb += wt * set.d2[k];
        bb += w[k] * set.d2[k] * set.d2[k];
        yt += y[k] * set.d1[k];
        yb += y[k] * set.d2[k];
      }
      add_path(m.dg, tt, yt);
      K.m00 += 2 * tb * m.dg[0] + bb;
      K.m02 += tb * (m.dg[0] + m.dg[2]) + bb;
      K.m22 += 2 * tb * m.dg[2] + bb;
      K.m01 += tb * m.dg[1];
      K.m12 += tb * m.dg[1];
      K.m03 += tb * m.dg[3];
      K.m23 += tb * m.dg[3];
      K.r[0] -= yb;
      K.r[2] -= yb;
    }
    after = {K.m22, K.m23, K.m33, K.r[2], K.r[3]};
    if (c == 0) continue;
    now.bb += K.m00;
    now.ba += K.m01;
    now.aa += K.m11;
    now.rb += K.r[0];
    now.ra += K.r[1];
    Elimination& e = elimination_[c];
    if (c == 1 || c + 1 == n_) {  // a is tied to b there
      const double tie = c == 1 ? rest_tie(p.cells[0].h) : -rest_tie(h);
      const double i = 1 / (now.bb + tie * (2 * now.ba + tie * now.aa));
      const double eb = K.m02 + tie * K.m12, ea = K.m03 + tie * K.m13, r = now.rb + tie * now.ra;
      e.fbb = i * eb;
      e.fba = i * ea;
      e.yb = i * r;
      e.fab = tie * e.fbb;
      e.faa = tie * e.fba;
      e.ya = tie * e.yb;
      after.bb -= eb * e.fbb;
      after.ba -= eb * e.fba;
      after.aa -= ea * e.fba;
      after.rb -= eb * e.yb;
      after.ra -= ea * e.yb;
    } else {
      const double ib = 1 / now.bb, l = now.ba * ib;
      const double ia = 1 / std::max(now.aa - l * now.ba, 1e-15 * now.aa);
      const auto solve = [&](double rb, double ra, double& b, double& a) {
        a = ia * (ra - l * rb);
        b = ib * rb - l * a;
      };
      solve(K.m02, K.m12, e.fbb, e.fab);
      solve(K.m03, K.m13, e.fba, e.faa);
      solve(now.rb, now.ra, e.yb, e.ya);
      after.bb -= K.m02 * e.fbb + K.m12 * e.fab;
      after.ba -= K.m02 * e.fba + K.m12 * e.faa;
      after.aa -= K.m03 * e.fba + K.m13 * e.faa;
      after.rb -= K.m02 * e.yb + K.m12 * e.ya;
      after.ra -= K.m03 * e.yb + K.m13 * e.ya;
    }
  }
  duration_ = duration;
  gap_ = gap;
  violation_ = violation;
}

template <int M>
void JerkSolver<M>::direction(double target, PlanningPulse& pulse) {
  const auto& p = *problem_;
  const auto& x = *x_;
  std::size_t next_node = p.nodes.size(), next_middle = p.middles.size();
  double most_primal = 0, most_dual = 0, promise = 0;
  dx_[n_] = {};
  const auto ratio = [&](const Rows& rows, const std::array<double, M>& share, double mu) {
    for (std::size_t k = 0; k < M; ++k) {
      const double dp = share[k] - rows.g[k] - rows.sp[k] - rows.d[k],
                   dm = share[k] + rows.g[k] - rows.sm[k] + rows.d[k];
      const double ip = 1 / rows.sp[k], im = 1 / rows.sm[k], fp = dp * ip, fm = dm * im;
      most_primal = std::max(most_primal, std::max(-fp, -fm));
      most_dual = std::max(most_dual, std::max(1 + fp - mu * ip / rows.zp[k], 1 + fm - mu * im / rows.zm[k]));
    }
  };
  for (std::size_t c = n_; c-- > 0;) {
    pulse(n_ - 1 - c, n_);
    if (c > 0) {
      const Elimination& e = elimination_[c];
      const JerkNode r = dx_[c + 1];
      dx_[c] = {e.yb - e.fbb * r.b - e.fba * r.a, e.ya - e.fab * r.b - e.faa * r.a};
    } else {
      dx_[0] = {};
    }
    const JerkNode l = dx_[c], r = dx_[c + 1];
    const std::array<double, 4> d{l.b, l.a, r.b, r.a};
    const std::array<double, 4>& dT = cell_[c].dT;
    const double change = dT[0] * d[0] + dT[1] * d[1] + dT[2] * d[2] + dT[3] * d[3];
    promise += change;
    // No cell may leave the range in which its linearisation means something.
    most_primal = std::max(most_primal, 2 * std::abs(change) / cell_[c].T);
    cell_rows(c,
              [&](Rows& rows, const auto& share, const Linear<M>& row, const std::array<double, 4>& q, std::size_t at) {
                const double path = q[0] * d[0] + q[1] * d[1] + q[2] * d[2] + q[3] * d[3];
                for (std::size_t k = 0; k < M; ++k)
                  rows.d[k] = row.t[k] * path + row.nb[k] * d[at] + row.na[k] * d[at + 1];
                ratio(rows, share, target * weight_[c]);
              });
    for (; next_middle > 0 && p.middles[next_middle - 1].cell == c; --next_middle) {
      const auto& set = p.middles[next_middle - 1];
      Rows& rows = middle_[next_middle - 1];
      const Middle m = middle_state(x[c], x[c + 1], cell_[c]);
      const double dg = m.dg[0] * d[0] + m.dg[1] * d[1] + m.dg[2] * d[2] + m.dg[3] * d[3], db = l.b + r.b;
      for (std::size_t k = 0; k < M; ++k) rows.d[k] = set.d2[k] * db + set.d1[k] * dg;
      ratio(rows, set.share, target * weight_[c]);
    }
    if (c == 0) break;
    const double mu = target * weight(c);
    for (; next_node > 0 && p.nodes[next_node - 1].node == c; --next_node) {
      const auto& set = p.nodes[next_node - 1];
      Rows& rows = node_[next_node - 1];
      for (std::size_t k = 0; k < M; ++k) rows.d[k] = set.p[k] * l.b + set.q[k] * l.a;
      ratio(rows, set.share, mu);
    }
    const Cap& cap = cap_[c];
    for (std::size_t e = 0; e < 2; ++e) {
      const double value = (x[c].b + l.b + cap_slope(c, e) * (x[c].a + l.a)) * p.inverse_cap[c][e];
      const double is = 1 / cap.s[e], f = (1 - value - cap.s[e]) * is;
      most_primal = std::max(most_primal, -f);
      most_dual = std::max(most_dual, 1 + f - mu * is / cap.z[e]);
    }
    // Speeds stay positive, and no node runs away on the strength of its linearisation.
    const double growth = l.b / x[c].b;
    most_primal = std::max(most_primal, std::max(-growth / 0.8, growth / 1.5));
  }
  promise_ = promise;
  most_primal_ = most_primal;
  most_dual_ = most_dual;
}

template <int M>
void JerkSolver<M>::advance(double target, double primal, double dual, PlanningPulse& pulse) {
  const auto& p = *problem_;
  auto& x = *x_;
  const auto move = [&](Rows& rows, const std::array<double, M>& share, double mu) {
    for (std::size_t k = 0; k < M; ++k) {
      const double dp = share[k] - rows.g[k] - rows.sp[k] - rows.d[k],
                   dm = share[k] + rows.g[k] - rows.sm[k] + rows.d[k];
      const double ip = 1 / rows.sp[k], im = 1 / rows.sm[k];
      rows.zp[k] += dual * ((mu - rows.zp[k] * dp) * ip - rows.zp[k]);
      rows.zm[k] += dual * ((mu - rows.zm[k] * dm) * im - rows.zm[k]);
      rows.sp[k] += primal * dp;
      rows.sm[k] += primal * dm;
    }
  };
  for (std::size_t c = 0; c < n_; ++c) {
    pulse(c, n_);
    for (std::size_t e = 0; e < 2; ++e) move(jerk_[2 * c + e], p.cells[c].share[e], target * weight_[c]);
    if (c == 0) continue;
    Cap& cap = cap_[c];
    for (std::size_t e = 0; e < 2; ++e) {
      const double value = (x[c].b + dx_[c].b + cap_slope(c, e) * (x[c].a + dx_[c].a)) * p.inverse_cap[c][e];
      const double ds = 1 - value - cap.s[e];
      cap.z[e] += dual * ((target * weight(c) - cap.z[e] * ds) / cap.s[e] - cap.z[e]);
      cap.s[e] += primal * ds;
    }
    x[c].b += primal * dx_[c].b;
    x[c].a += primal * dx_[c].a;
  }
  for (std::size_t i = 0; i < p.nodes.size(); ++i) move(node_[i], p.nodes[i].share, target * weight(p.nodes[i].node));
  for (std::size_t i = 0; i < p.middles.size(); ++i)
    move(middle_[i], p.middles[i].share, target * weight_[p.middles[i].cell]);
}

template <int M>
JerkSolverResult JerkSolver<M>::solve(const JerkProblem<M>& problem, LargeVector<JerkNode>& x, double mu,
                                      const JerkSolverOptions& options, PlanningPulse& pulse) {
  problem_ = &problem;
  x_ = &x;
  n_ = problem.cells.size();
  x[1].a = rest_tie(problem.cells[0].h) * x[1].b;
  x[n_ - 1].a = -rest_tie(problem.cells[n_ - 1].h) * x[n_ - 1].b;
  if (mu > 0) start(mu, pulse);
  if (mu == 0 && middle_.size() != problem.middles.size()) start_middles(gap_ / scale_);
  JerkSolverResult result;
  int stuck = 0;
  double target = mu > 0 ? mu : gap_ / scale_;
  for (;; ++result.iterations) {
    assemble(target, pulse);
    result.duration = duration_;
    result.gap = gap_ / duration_;
    result.violation = violation_;
    result.mu = gap_ / scale_;
    if (!std::isfinite(duration_ + gap_)) break;
    direction(target, pulse);
    if (result.gap <= options.gap && result.violation <= options.violation &&
        std::abs(promise_) <= options.gap * duration_) {
      result.converged = true;
      break;
    }
    if (result.iterations == options.iterations) break;
    const double reach = std::max(0.9, 1 - 10 * target);
    const double primal = std::min(1.0, reach / most_primal_), dual = std::min(1.0, reach / most_dual_);
    advance(target, primal, dual, pulse);
    // What the next step aims at: the less of this one could be taken, the nearer to the present μ.
    const double step = std::min(primal, dual), miss = 1 - step;
    const double now = (1 - step) * gap_ / scale_ + step * target;
    target = now * std::clamp(miss * miss, 0.1, 0.8);
    stuck = step < stuck_step ? stuck + 1 : 0;
    if (stuck == stuck_steps) {  // too near a wall: from here again, with slacks and multipliers in balance
      target = std::min(0.1, std::max(1e-3, 10 * now));
      start(target, pulse);
      stuck = 0;
    }
  }
  return result;
}

template class JerkSolver<2>;
template class JerkSolver<3>;
template class JerkSolver<4>;

}  // namespace bahnwerk
