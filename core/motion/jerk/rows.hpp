#pragma once
/// The rows of JerkProblem in the form of the interior-point method. Two cells, or nodes, are computed at once, one per
/// lane of a vector register. L is a number, or a vector of one number per cell.
#include <array>
#include <cstddef>

#include "core/motion/jerk/elimination.hpp"
#include "core/numeric/lanes.hpp"

namespace bahnwerk {

/// Numbers of two cells, or nodes: one of each half of the section.
using Lane2 = Lanes<2>;
constexpr std::size_t lane_count = 2;
inline Lane2 all(double a) { return Lane2{a, a}; }
/// Weight of a lane that represents no cell or node.
constexpr double no_weight = 1e-30;
inline NodeBlock<double> lane(const NodeBlock<Lane2>& n, std::size_t e) {
  return {n.bb[e], n.ba[e], n.aa[e], n.rb[e], n.ra[e]};
}
inline CellMatrix<double> lane(const CellMatrix<Lane2>& K, std::size_t e) {
  return {K.m00[e],
          K.m01[e],
          K.m11[e],
          K.m02[e],
          K.m03[e],
          K.m12[e],
          K.m13[e],
          K.m22[e],
          K.m23[e],
          K.m33[e],
          {K.r[0][e], K.r[1][e], K.r[2][e], K.r[3][e]}};
}
inline void set(NodeBlock<Lane2>& blocks, std::size_t lane, const NodeBlock<double>& block) {
  blocks.bb[lane] = block.bb;
  blocks.ba[lane] = block.ba;
  blocks.aa[lane] = block.aa;
  blocks.rb[lane] = block.rb;
  blocks.ra[lane] = block.ra;
}
inline void set(Elimination<Lane2>& nodes, std::size_t lane, const Elimination<double>& node) {
  nodes.fbb[lane] = node.fbb;
  nodes.fba[lane] = node.fba;
  nodes.fab[lane] = node.fab;
  nodes.faa[lane] = node.faa;
  nodes.yb[lane] = node.yb;
  nodes.ya[lane] = node.ya;
}
inline void set(JerkCellOf<Lane2>& laws, std::size_t lane, const JerkCell& law) {
  laws.T[lane] = law.T;
  laws.j1[lane] = law.j1;
  laws.j2[lane] = law.j2;
  for (std::size_t i = 0; i < 4; ++i) {
    laws.dT[i][lane] = law.dT[i];
    laws.dj1[i][lane] = law.dj1[i];
    laws.dj2[i][lane] = law.dj2[i];
  }
}

/// What a step of the rows of one cell or node assembles with: the target of the rows' complementarity, and the parts
/// of the last step that slacks and multipliers take.
template <class L>
struct JerkTarget {
  L mu, primal, dual;
};

/// How far a step of rows reaches: the first slack becomes zero at −1/primal of it, or later; the first multiplier at
/// 1/dual of it, or later.
template <class L>
struct JerkReach {
  L primal{}, dual{};
};

/// A row g ≤ share with slack s, multiplier z and step d of the slack.
template <class L>
struct JerkSide {
  L s, z, d;
  L i;  ///< 1/(s z), which gives 1/s and 1/z without a second division; after step() the part of z that the step takes

  /// Initialises the slack with `room`, but with at least `least`.
  void begin(L room, L mu, L least) {
    s = larger(room, least);
    z = mu / s;
    d = i = 0.0 * s;
  }
  /// Moves by the given parts of the last step.
  void move(L primal, L dual) {
    s = s + primal * d;
    z = z - dual * i * z;
  }
  /// Computes weight w and right-hand side y of the row in the Newton system for room = share − g. Returns s z.
  L weigh(L room, L mu, L& w, L& y) {
    const L gap = s * z;
    d = room - s;
    i = 1.0 / gap;
    const L is = z * i;
    w = z * is;
    y = is * (mu - z * d);
    return gap;
  }
  /// Computes the step for a change of g by `change`, and reduces `reach` to what it allows.
  void step(L change, L mu, JerkReach<L>& reach) {
    d = d - change;
    const L f = d * (z * i);
    reach.primal = smaller(reach.primal, f);
    i = 1.0 + f - mu * i;
    reach.dual = larger(reach.dual, i);
  }
};

/// Sums over the rows at an iterate.
template <class L>
struct JerkTotals {
  L gap{}, violation{};
  void count(const JerkSide<L>& side, L side_gap) {
    gap = gap + side_gap;
    violation = larger(violation, magnitude(side.d));
  }
};

/// A row |g| ≤ share.
template <class L>
struct JerkRow {
  JerkSide<L> up, down;

  void begin(L g, L share, L mu, L least) {
    up.begin(share - g, mu, least);
    down.begin(share + g, mu, least);
  }
  void move(L primal, L dual) {
    up.move(primal, dual);
    down.move(primal, dual);
  }
  void weigh(L g, L share, L mu, L& w, L& y, JerkTotals<L>& totals) {
    L w2, y2;
    totals.count(up, up.weigh(share - g, mu, w, y));
    totals.count(down, down.weigh(share + g, mu, w2, y2));
    w = w + w2;
    y = y - y2;
  }
  void step(L change, L mu, JerkReach<L>& reach) {
    up.step(change, mu, reach);
    down.step(-change, mu, reach);
  }
};

/// M rows |p b + q a| ≤ share at one node.
template <class L, int M>
struct JerkNodeRows {
  std::array<L, M> p, q, share;
  std::array<JerkRow<L>, M> rows;

  void begin(L b, L a, L mu, L least) {
    for (std::size_t k = 0; k < M; ++k) rows[k].begin(p[k] * b + q[k] * a, share[k], mu, least);
  }
  void assemble(L b, L a, const JerkTarget<L>& target, NodeBlock<L>& block, JerkTotals<L>& totals) {
    for (std::size_t k = 0; k < M; ++k) {
      L w, y;
      rows[k].move(target.primal, target.dual);
      rows[k].weigh(p[k] * b + q[k] * a, share[k], target.mu, w, y, totals);
      block.add(w, p[k], q[k], y);
    }
  }
  void step(L db, L da, L mu, JerkReach<L>& reach) {
    for (std::size_t k = 0; k < M; ++k) rows[k].step(p[k] * db + q[k] * da, mu, reach);
  }
};

/// Jerk of M quantities at one end of a cell, divided by their limits: d₃ v³ + d₂ v a + d₁ j.
template <class L, int M>
struct JerkEndRows {
  std::array<L, M> d1, d2, d3, share;  ///< h′/J, 3 h″/J, h‴/J
  std::array<JerkRow<L>, M> rows;

  /// Returns the value at a node for the jerk j; by_b() and by_a() return its gradients by b and a of the node, and d1
  /// is the gradient by j.
  L value(std::size_t k, const MovingNode<L>& at, L j) const {
    return at.v * (d3[k] * at.b + d2[k] * at.a) + d1[k] * j;
  }
  L by_b(std::size_t k, const MovingNode<L>& at) const { return d3[k] * (1.5 * at.v) + d2[k] * (at.a * at.w); }
  L by_a(std::size_t k, const MovingNode<L>& at) const { return d2[k] * at.v; }

  void begin(const MovingNode<L>& at, L j, L mu, L least) {
    for (std::size_t k = 0; k < M; ++k) rows[k].begin(value(k, at, j), share[k], mu, least);
  }
  RowSums<L> assemble(const MovingNode<L>& at, L j, const JerkTarget<L>& target, JerkTotals<L>& totals) {
    RowSums<L> sums;
    for (std::size_t k = 0; k < M; ++k) {
      L weight, y;
      rows[k].move(target.primal, target.dual);
      rows[k].weigh(value(k, at, j), share[k], target.mu, weight, y, totals);
      if (k == 0)
        sums = RowSums<L>::of(weight, y, d1[k], by_b(k, at), by_a(k, at));
      else
        sums.add(weight, y, d1[k], by_b(k, at), by_a(k, at));
    }
    return sums;
  }
  /// `db`, `da` and `dj` are the changes of b, a and j by the step.
  void step(const MovingNode<L>& at, L db, L da, L dj, L mu, JerkReach<L>& reach) {
    const L by_d3 = 1.5 * at.v * db, by_d2 = at.a * at.w * db + at.v * da;
    for (std::size_t k = 0; k < M; ++k) rows[k].step(d1[k] * dj + d2[k] * by_d2 + d3[k] * by_d3, mu, reach);
  }
};

/// The middle Bernstein coefficient of a(t), with its gradient.
template <class L>
struct JerkMiddle {
  L g;
  std::array<L, 4> dg;
};
template <class L>
inline JerkMiddle<L> jerk_middle(const MovingNode<L>& left, const MovingNode<L>& right, const JerkCellOf<L>& cell) {
  const L u = 1.0 / cell.T, mean = (right.v - left.v) * u, gT = -3.0 * mean * u, u3 = 3.0 * u;
  return {
      3.0 * mean - left.a - right.a,
      {gT * cell.dT[0] - u3 * left.w, gT * cell.dT[1] - 1.0, gT * cell.dT[2] + u3 * right.w, gT * cell.dT[3] - 1.0}};
}

/// M rows |d₂ (b₁ + b₂) + d₁ g| ≤ share, g the middle coefficient.
template <class L, int M>
struct JerkMiddleRows {
  std::array<L, M> d1, d2, share;
  std::array<JerkRow<L>, M> rows;
  std::array<L, 4> gradient;

  void begin(L b, L g, L mu, L least) {
    for (std::size_t k = 0; k < M; ++k) rows[k].begin(d2[k] * b + d1[k] * g, share[k], mu, least);
  }
  RowSums<L> assemble(L b, const JerkMiddle<L>& m, const JerkTarget<L>& target, JerkTotals<L>& totals) {
    RowSums<L> sums;
    gradient = m.dg;
    for (std::size_t k = 0; k < M; ++k) {
      L w, y;
      rows[k].move(target.primal, target.dual);
      rows[k].weigh(d2[k] * b + d1[k] * m.g, share[k], target.mu, w, y, totals);
      if (k == 0)
        sums = RowSums<L>::of(w, y, d1[k], d2[k]);
      else
        sums.add(w, y, d1[k], d2[k]);
    }
    return sums;
  }
  void step(L db, L dg, L mu, JerkReach<L>& reach) {
    for (std::size_t k = 0; k < M; ++k) rows[k].step(d2[k] * db + d1[k] * dg, mu, reach);
  }
};

}  // namespace bahnwerk
