#pragma once
/// Block-tridiagonal elimination with 2 × 2 blocks: what a cell adds to the Newton system, and one node at a time.
#include <algorithm>
#include <array>

#include "core/motion/jerk_cell.hpp"

namespace bahnwerk {

/// Diagonal block and right-hand side of one node.
struct NodeBlock {
  double bb = 0, ba = 0, aa = 0, rb = 0, ra = 0;
  void add(double weight, double p, double q, double r) {
    bb += weight * p * p;
    ba += weight * p * q;
    aa += weight * q * q;
    rb -= r * p;
    ra -= r * q;
  }
};

/// Sums over rows of products of (t, nb, na) among each other and with the right-hand side.
struct RowSums {
  double tt = 0, tb = 0, ta = 0, bb = 0, ba = 0, aa = 0, yt = 0, yb = 0, ya = 0;
};

/// Symmetric matrix and right-hand side of one cell by (b₁, a₁, b₂, a₂).
struct CellMatrix {
  double m00 = 0, m01 = 0, m11 = 0, m02 = 0, m03 = 0, m12 = 0, m13 = 0, m22 = 0, m23 = 0, m33 = 0;
  std::array<double, 4> r{};

  /// s q qᵀ, −r q.
  void add(const std::array<double, 4>& q, double s, double y) {
    const double q0 = s * q[0], q1 = s * q[1], q2 = s * q[2];
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
  void add_left(const std::array<double, 4>& q, const RowSums& s) {
    add(q, s.tt, s.yt);
    m00 += 2 * s.tb * q[0] + s.bb;
    m01 += s.tb * q[1] + s.ta * q[0] + s.ba;
    m11 += 2 * s.ta * q[1] + s.aa;
    m02 += s.tb * q[2];
    m03 += s.tb * q[3];
    m12 += s.ta * q[2];
    m13 += s.ta * q[3];
    r[0] -= s.yb;
    r[1] -= s.ya;
  }
  /// Likewise on the right node.
  void add_right(const std::array<double, 4>& q, const RowSums& s) {
    add(q, s.tt, s.yt);
    m22 += 2 * s.tb * q[2] + s.bb;
    m23 += s.tb * q[3] + s.ta * q[2] + s.ba;
    m33 += 2 * s.ta * q[3] + s.aa;
    m02 += s.tb * q[0];
    m12 += s.tb * q[1];
    m03 += s.ta * q[0];
    m13 += s.ta * q[1];
    r[2] -= s.yb;
    r[3] -= s.ya;
  }
  /// Rows with gradient t q + nb (1, 0, 1, 0).
  void add_both(const std::array<double, 4>& q, const RowSums& s) {
    add(q, s.tt, s.yt);
    m00 += 2 * s.tb * q[0] + s.bb;
    m02 += s.tb * (q[0] + q[2]) + s.bb;
    m22 += 2 * s.tb * q[2] + s.bb;
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
inline Elimination eliminate(const NodeBlock& now, const CellMatrix& K, NodeBlock& after) {
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
inline Elimination eliminate_tied(const NodeBlock& now, double tie, const CellMatrix& K, NodeBlock& after) {
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
