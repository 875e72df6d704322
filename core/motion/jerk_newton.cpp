/// One step of the interior-point method: forwards through the run the last step is taken, the linear system assembled
/// and eliminated, backwards its solution found and how much of it can be taken.
#include <algorithm>
#include <cmath>

#include "core/motion/jerk_solver.hpp"

namespace bahnwerk {

namespace {

/// Sums of products of rows with weights w and right-hand sides y.
template <int M>
inline RowSums row_sums(const Lanes<M>& w, const Lanes<M>& y, const Lanes<M>& t, const Lanes<M>& nb,
                        const Lanes<M>& na) {
  const Lanes<M> wt = w * t, wb = w * nb;
  return {sum<M>(wt * t),      sum<M>(wt * nb), sum<M>(wt * na), sum<M>(wb * nb), sum<M>(wb * na),
          sum<M>(w * na * na), sum<M>(y * t),   sum<M>(y * nb),  sum<M>(y * na)};
}

inline double along(const std::array<double, 4>& q, JerkNode l, JerkNode r) {
  return q[0] * l.b + q[1] * l.a + q[2] * r.b + q[3] * r.a;
}

}  // namespace

template <int M>
void JerkSolver<M>::assemble_node(std::size_t c, NodeBlock& now, Sums& sums, std::size_t& next_node) {
  const auto& p = *problem_;
  const JerkNode x = (*x_)[c];
  const double mu = target_ * weight(c), moved = moved_target_ * weight(c);
  const double primal = std::min(steps_.primal[c - 1], steps_.primal[c]),
               dual = std::min(steps_.dual[c - 1], steps_.dual[c]);
  now.bb += 3 * (p.cells[c - 1].h + p.cells[c].h) * speed_[c].dv * speed_[c].dv * speed_[c].dv / x.b;
  RowState<2>& cap = node_[c].cap;
  // Only the upper side of a cap counts; its rows have RowState's form with the lower side left alone.
  const Lanes<2> i = lanes<2>(p.inverse_cap[c]), q = i * cap_slopes(c);
  cap.zp = cap.zp + dual * ((moved - cap.zp * cap.dp) * cap.ip - cap.zp);
  cap.sp = cap.sp + primal * cap.dp;
  cap.ip = 1.0 / cap.sp;
  cap.dp = 1.0 - (i * x.b + q * x.a) - cap.sp;
  const Lanes<2> w = cap.zp * cap.ip, y = (mu - cap.zp * cap.dp) * cap.ip;
  for (std::size_t e = 0; e < 2; ++e) now.add(w[e], i[e], q[e], y[e]);
  sums.cap_gap += sum<2>(cap.sp * cap.zp);
  sums.cap_violation = std::max(sums.cap_violation, largest<2>(magnitude<2>(cap.dp)));
  for (; next_node < p.nodes.size() && p.nodes[next_node].node == c; ++next_node) {
    const auto& set = p.nodes[next_node];
    RowState<M>& rows = acceleration_[next_node];
    const Lanes<M> sb = lanes<M>(set.p), sa = lanes<M>(set.q);
    Lanes<M> v, r;
    rows.move(moved, primal, dual);
    rows.weigh(sb * x.b + sa * x.a, lanes<M>(set.share), mu, v, r, sums.gap, sums.violation);
    const Lanes<M> vb = v * sb;
    now.bb += sum<M>(vb * sb);
    now.ba += sum<M>(vb * sa);
    now.aa += sum<M>(v * sa * sa);
    now.rb -= sum<M>(r * sb);
    now.ra -= sum<M>(r * sa);
  }
}

template <int M>
void JerkSolver<M>::assemble_cell(std::size_t c, CellMatrix& K, Sums& sums, std::size_t& next_middle) {
  const auto& p = *problem_;
  const auto& x = *x_;
  const double mu = target_ * weight_[c], moved = moved_target_ * weight_[c];
  CellState& cell = cell_[c];
  evaluate(c);
  const JerkCell& law = cell.law;
  sums.duration += law.T;
  for (std::size_t i = 0; i < 4; ++i) K.r[i] = -law.dT[i];
  Lanes<M> w, y;
  for (std::size_t e = 0; e < 2; ++e) {
    const JerkRows<M> row = rows_at(c, e);
    cell.by_b[e] = row.nb;
    cell.by_a[e] = row.na;
    cell.jerk[e].move(moved, steps_.primal[c], steps_.dual[c]);
    cell.jerk[e].weigh(row.g, lanes<M>(p.cells[c].share[e]), mu, w, y, sums.gap, sums.violation);
    const RowSums s = row_sums<M>(w, y, row.t, row.nb, row.na);
    if (e == 0)
      K.add_left(law.dj1, s);
    else
      K.add_right(law.dj2, s);
  }
  for (; next_middle < p.middles.size() && p.middles[next_middle].cell == c; ++next_middle) {
    const auto& set = p.middles[next_middle];
    MiddleState& state = middle_[next_middle];
    const JerkMiddle m = middle_at(c);
    state.gradient = m.dg;
    const Lanes<M> d1 = lanes<M>(set.d1), d2 = lanes<M>(set.d2);
    state.rows.move(moved, steps_.primal[c], steps_.dual[c]);
    state.rows.weigh(d2 * (x[c].b + x[c + 1].b) + d1 * m.g, lanes<M>(set.share), mu, w, y, sums.gap, sums.violation);
    K.add_both(m.dg, row_sums<M>(w, y, d1, d2, all_lanes<M>(0)));
  }
}

template <int M>
void JerkSolver<M>::assemble(PlanningPulse& pulse) {
  std::size_t next_node = 0, next_middle = 0;
  NodeBlock now, after;
  Sums sums;
  sums.gap = sums.violation = all_lanes<M>(0);
  move_node(1);
  for (std::size_t c = 0; c < n_; ++c) {
    pulse(c, n_);
    now = after;
    if (c > 0) assemble_node(c, now, sums, next_node);
    if (c > 0 && c + 1 < n_) move_node(c + 1);
    CellMatrix K;
    assemble_cell(c, K, sums, next_middle);
    after = {K.m22, K.m23, K.m33, K.r[2], K.r[3]};
    if (c == 0) continue;
    now.bb += K.m00;
    now.ba += K.m01;
    now.aa += K.m11;
    now.rb += K.r[0];
    now.ra += K.r[1];
    const bool first = c == 1, last = c + 1 == n_;
    node_[c].elimination =
        first || last ? eliminate_tied(now, rest_tie(problem_->cells[first ? 0 : c].h) * (first ? 1 : -1), K, after)
                      : eliminate(now, K, after);
  }
  duration_ = sums.duration;
  gap_ = sum<M>(sums.gap) + sums.cap_gap;
  violation_ = std::max(largest<M>(sums.violation), sums.cap_violation);
}

template <int M>
void JerkSolver<M>::direction(PlanningPulse& pulse) {
  const auto& p = *problem_;
  const auto& x = *x_;
  const Lanes<M> inverse_jerk = lanes<M>(p.inverse_jerk), none = all_lanes<M>(0);
  std::size_t next_node = p.nodes.size(), next_middle = p.middles.size();
  double promise = 0;
  dx_[n_] = dx_[0] = {};
  for (std::size_t c = n_; c-- > 0;) {
    pulse(n_ - 1 - c, n_);
    if (c > 0) dx_[c] = node_[c].elimination.back(dx_[c + 1]);
    const JerkNode l = dx_[c], r = dx_[c + 1];
    CellState& cell = cell_[c];
    Lanes<M> primal = none, dual = none;
    const double change = along(cell.law.dT, l, r);
    promise += change;
    const double mu = target_ * weight_[c];
    for (std::size_t e = 0; e < 2; ++e) {
      const JerkNode d = e ? r : l;
      const Lanes<M> t = inverse_jerk * lanes<M>(p.stations[p.cells[c].station + e].d1);
      cell.jerk[e].step(t * along(e ? cell.law.dj2 : cell.law.dj1, l, r) + cell.by_b[e] * d.b + cell.by_a[e] * d.a, mu,
                        primal, dual);
    }
    for (; next_middle > 0 && p.middles[next_middle - 1].cell == c; --next_middle) {
      const auto& set = p.middles[next_middle - 1];
      MiddleState& state = middle_[next_middle - 1];
      state.rows.step(lanes<M>(set.d2) * (l.b + r.b) + lanes<M>(set.d1) * along(state.gradient, l, r), mu, primal,
                      dual);
    }
    // No cell may leave the range in which its linearisation means something.
    double most_primal = 2 * std::abs(change) / cell.law.T, most_dual = 0;
    if (c > 0 && c + 1 < n_) {  // the root in the cell's law (jerk_cell.hpp) loses no more than half
      const double h = p.cells[c].h, mean = 0.5 * (speed_[c].v + speed_[c + 1].v);
      const double root = mean * mean + (1.0 / 3) * h * (x[c].a - x[c + 1].a);
      const double fall = -mean * (speed_[c].dv * l.b + speed_[c + 1].dv * r.b) - (1.0 / 3) * h * (l.a - r.a);
      if (2 * fall > most_primal * root)
        most_primal = 2 * fall / std::max(root, jerk_cell_detail::least_root * mean * mean);
    }
    if (c > 0) {
      const double node_mu = target_ * weight(c);
      for (; next_node > 0 && p.nodes[next_node - 1].node == c; --next_node) {
        const auto& set = p.nodes[next_node - 1];
        acceleration_[next_node - 1].step(lanes<M>(set.p) * l.b + lanes<M>(set.q) * l.a, node_mu, primal, dual);
      }
      RowState<2>& cap = node_[c].cap;
      cap.dp = cap.dp - lanes<2>(p.inverse_cap[c]) * (l.b + cap_slopes(c) * l.a);
      const Lanes<2> f = cap.dp * cap.ip;
      most_primal = std::max(most_primal, largest<2>(-1.0 * f));
      most_dual = largest<2>(1.0 + f - node_mu * cap.ip / cap.zp);
      // Speeds stay positive, and no node runs away on the strength of its linearisation.
      const double growth = l.b / x[c].b;
      most_primal = std::max(most_primal, std::max(-growth / 0.8, growth / 1.5));
    }
    steps_.primal[c] = std::max(most_primal, largest<M>(primal));
    steps_.dual[c] = std::max(most_dual, largest<M>(dual));
  }
  promise_ = promise;
}

template void JerkSolver<2>::assemble_node(std::size_t, NodeBlock&, Sums&, std::size_t&);
template void JerkSolver<2>::assemble_cell(std::size_t, CellMatrix&, Sums&, std::size_t&);
template void JerkSolver<2>::assemble(PlanningPulse&);
template void JerkSolver<2>::direction(PlanningPulse&);
template void JerkSolver<3>::assemble_node(std::size_t, NodeBlock&, Sums&, std::size_t&);
template void JerkSolver<3>::assemble_cell(std::size_t, CellMatrix&, Sums&, std::size_t&);
template void JerkSolver<3>::assemble(PlanningPulse&);
template void JerkSolver<3>::direction(PlanningPulse&);
template void JerkSolver<4>::assemble_node(std::size_t, NodeBlock&, Sums&, std::size_t&);
template void JerkSolver<4>::assemble_cell(std::size_t, CellMatrix&, Sums&, std::size_t&);
template void JerkSolver<4>::assemble(PlanningPulse&);
template void JerkSolver<4>::direction(PlanningPulse&);

}  // namespace bahnwerk
