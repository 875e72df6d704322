#pragma once
/// Block-tridiagonal elimination with 2 × 2 blocks: what a cell adds to the Newton system, and one node at a time.
#include <algorithm>
#include <array>

#include "core/motion/jerk_cell.hpp"

namespace bahnwerk {

/// Diagonal block and right-hand side of one node. L: a number, or one per node.
template <class L>
struct NodeBlock {
  L bb{}, ba{}, aa{}, rb{}, ra{};
  /// A row with gradient (p, q).
  void add(L w, L p, L q, L y) {
    const L wp = w * p;
    bb = bb + wp * p;
    ba = ba + wp * q;
    aa = aa + w * q * q;
    rb = rb - y * p;
    ra = ra - y * q;
  }
};

/// Sums over rows of products of their gradients (t, nb, na) among each other and with the right-hand side.
template <class L>
struct RowSums {
  L tt{}, tb{}, ta{}, bb{}, ba{}, aa{}, yt{}, yb{}, ya{};
  void add(L w, L y, L t, L nb, L na) {
    add(w, y, t, nb);
    ta = ta + w * t * na;
    ba = ba + w * nb * na;
    aa = aa + w * na * na;
    ya = ya + y * na;
  }
  void add(L w, L y, L t, L nb) {
    const L wt = w * t;
    tt = tt + wt * t;
    tb = tb + wt * nb;
    bb = bb + w * nb * nb;
    yt = yt + y * t;
    yb = yb + y * nb;
  }
};

/// Symmetric matrix and right-hand side of one cell by (b₁, a₁, b₂, a₂).
template <class L>
struct CellMatrix {
  L m00{}, m01{}, m11{}, m02{}, m03{}, m12{}, m13{}, m22{}, m23{}, m33{};
  std::array<L, 4> r{};

  /// s q qᵀ, −r q.
  void add(const std::array<L, 4>& q, L s, L y) {
    const L q0 = s * q[0], q1 = s * q[1], q2 = s * q[2];
    m00 += q0 * q[0];
    m01 += q0 * q[1];
    m02 += q0 * q[2];
    m03 += q0 * q[3];
    m11 += q1 * q[1];
    m12 += q1 * q[2];
    m13 += q1 * q[3];
    m22 += q2 * q[2];
    m23 += q2 * q[3];
    m33 += s * q[3] * q[3];
    for (std::size_t i = 0; i < 4; ++i) r[i] -= y * q[i];
  }
  /// Rows with gradient t q + (nb, na) on the left node.
  void add_left(const std::array<L, 4>& q, const RowSums<L>& s) {
    add(q, s.tt, s.yt);
    m00 += 2.0 * s.tb * q[0] + s.bb;
    m01 += s.tb * q[1] + s.ta * q[0] + s.ba;
    m11 += 2.0 * s.ta * q[1] + s.aa;
    m02 += s.tb * q[2];
    m03 += s.tb * q[3];
    m12 += s.ta * q[2];
    m13 += s.ta * q[3];
    r[0] -= s.yb;
    r[1] -= s.ya;
  }
  /// Likewise on the right node.
  void add_right(const std::array<L, 4>& q, const RowSums<L>& s) {
    add(q, s.tt, s.yt);
    m22 += 2.0 * s.tb * q[2] + s.bb;
    m23 += s.tb * q[3] + s.ta * q[2] + s.ba;
    m33 += 2.0 * s.ta * q[3] + s.aa;
    m02 += s.tb * q[0];
    m12 += s.tb * q[1];
    m03 += s.ta * q[0];
    m13 += s.ta * q[1];
    r[2] -= s.yb;
    r[3] -= s.ya;
  }
  /// Rows with gradient t q + nb (1, 0, 1, 0).
  void add_both(const std::array<L, 4>& q, const RowSums<L>& s) {
    add(q, s.tt, s.yt);
    m00 += 2.0 * s.tb * q[0] + s.bb;
    m02 += s.tb * (q[0] + q[2]) + s.bb;
    m22 += 2.0 * s.tb * q[2] + s.bb;
    m01 += s.tb * q[1];
    m12 += s.tb * q[1];
    m03 += s.tb * q[3];
    m23 += s.tb * q[3];
    r[0] -= s.yb;
    r[2] -= s.yb;
  }
};

/// An eliminated node: x = y − F x_next.
struct Elimination {
  double fbb, fba, fab, faa, yb, ya;
  JerkNode back(JerkNode next) const { return {yb - fbb * next.b - fba * next.a, ya - fab * next.b - faa * next.a}; }
};

/// Eliminates the left node of a cell whose block, the cell's matrix included, is `now`; `after` is the right node's.
inline Elimination eliminate(const NodeBlock<double>& now, const CellMatrix<double>& K, NodeBlock<double>& after) {
  Elimination e;
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
  return e;
}

/// The same for a node next to rest, where a = tie · b.
inline Elimination eliminate_tied(const NodeBlock<double>& now, double tie, const CellMatrix<double>& K,
                                  NodeBlock<double>& after) {
  Elimination e;
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
  return e;
}

}  // namespace bahnwerk
