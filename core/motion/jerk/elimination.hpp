#pragma once
/// Block-tridiagonal elimination with 2 × 2 blocks (a Riccati recursion): the contribution of a cell to the Newton
/// system, and the elimination of one node. Eigen is not used here: its LDLT of a 2 × 2 block takes 5 times as long,
/// and its closed inverse does not guard pivots.
#include <array>
#include <limits>

#include "core/motion/jerk/cell.hpp"

namespace bahnwerk {

/// Diagonal block and right-hand side of one node. L is a number, or a vector of one number per node.
template <class L>
struct NodeBlock {
  L bb{}, ba{}, aa{}, rb{}, ra{};
  void add(const NodeBlock& other) {
    bb = bb + other.bb;
    ba = ba + other.ba;
    aa = aa + other.aa;
    rb = rb + other.rb;
    ra = ra + other.ra;
  }
  /// Adds a row with gradient (p, q), weight w and right-hand side y.
  void add(L w, L p, L q, L y) {
    const L wp = w * p;
    bb = bb + wp * p;
    ba = ba + wp * q;
    aa = aa + w * q * q;
    rb = rb - y * p;
    ra = ra - y * q;
  }
};

/// Sums over rows of the products of their gradients (t, nb, na) with each other and with the right-hand side.
template <class L>
struct RowSums {
  L tt{}, tb{}, ta{}, bb{}, ba{}, aa{}, yt{}, yb{}, ya{};
  /// Returns the sums of one row. Sums start from a row, since adding to zeros costs as much as adding.
  static RowSums of(L w, L y, L t, L nb, L na) {
    const L wt = w * t, wb = w * nb;
    return {wt * t, wt * nb, wt * na, wb * nb, wb * na, w * na * na, y * t, y * nb, y * na};
  }
  static RowSums of(L w, L y, L t, L nb) {
    const L wt = w * t;
    return {wt * t, wt * nb, L{}, w * nb * nb, L{}, L{}, y * t, y * nb, L{}};
  }
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

  /// Returns the matrix of the rows at the left node, whose gradient is t q + n with n = (nb, na) on that node; `from`
  /// is the negative gradient of the objective. With u = Σ w t (t q + n) the matrix is q uᵀ + Σ w t n qᵀ + Σ w n nᵀ.
  static CellMatrix of_left(const std::array<L, 4>& q, const RowSums<L>& s, const std::array<L, 4>& from) {
    const L u0 = s.tt * q[0] + s.tb, u1 = s.tt * q[1] + s.ta, u2 = s.tt * q[2];
    return {u0 * q[0] + s.tb * q[0] + s.bb,
            u0 * q[1] + s.ta * q[0] + s.ba,
            u1 * q[1] + s.ta * q[1] + s.aa,
            u0 * q[2],
            u0 * q[3],
            u1 * q[2],
            u1 * q[3],
            u2 * q[2],
            u2 * q[3],
            s.tt * q[3] * q[3],
            {from[0] - s.yt * q[0] - s.yb, from[1] - s.yt * q[1] - s.ya, from[2] - s.yt * q[2], from[3] - s.yt * q[3]}};
  }
  /// Adds the rows at the right node.
  void add_right(const std::array<L, 4>& q, const RowSums<L>& s) {
    const L u1 = s.tt * q[1], u2 = s.tt * q[2] + s.tb, u3 = s.tt * q[3] + s.ta;
    m00 += s.tt * q[0] * q[0];
    m01 += u1 * q[0];
    m11 += u1 * q[1];
    m02 += u2 * q[0];
    m03 += u3 * q[0];
    m12 += u2 * q[1];
    m13 += u3 * q[1];
    m22 += u2 * q[2] + s.tb * q[2] + s.bb;
    m23 += u2 * q[3] + s.ta * q[2] + s.ba;
    m33 += u3 * q[3] + s.ta * q[3] + s.aa;
    r[0] -= s.yt * q[0];
    r[1] -= s.yt * q[1];
    r[2] -= s.yt * q[2] + s.yb;
    r[3] -= s.yt * q[3] + s.ya;
  }
  /// Adds rows with gradient t q + nb (1, 0, 1, 0).
  void add_both(const std::array<L, 4>& q, const RowSums<L>& s) {
    const L u0 = s.tt * q[0] + s.tb, u1 = s.tt * q[1], u2 = s.tt * q[2] + s.tb, u3 = s.tt * q[3];
    m00 += u0 * q[0] + s.tb * q[0] + s.bb;
    m01 += u0 * q[1];
    m11 += u1 * q[1];
    m02 += u0 * q[2] + s.tb * q[0] + s.bb;
    m03 += u0 * q[3];
    m12 += u2 * q[1];
    m13 += u1 * q[3];
    m22 += u2 * q[2] + s.tb * q[2] + s.bb;
    m23 += u2 * q[3];
    m33 += u3 * q[3];
    r[0] -= s.yt * q[0] + s.yb;
    r[1] -= s.yt * q[1];
    r[2] -= s.yt * q[2] + s.yb;
    r[3] -= s.yt * q[3];
  }
};

/// An eliminated node: x = y − F x_next.
template <class L>
struct Elimination {
  L fbb{}, fba{}, fab{}, faa{}, yb{}, ya{};
  void back(L next_b, L next_a, L& b, L& a) const {
    b = yb - fbb * next_b - fba * next_a;
    a = ya - fab * next_b - faa * next_a;
  }
};

/// Share of a diagonal's sum that is added to it. A node's diagonal is the sum of its rows minus the terms that the
/// elimination of earlier nodes subtracts. With stiff rows it is a small difference of large sums, which rounding may
/// make negative.
constexpr double given_back = 0.5 * std::numeric_limits<double>::epsilon();

/// Eliminates the left node of a cell. `now` is its block, the cell's matrix included, `after` the block of the right
/// node; `bb` and `aa` are the sums on its diagonal before any subtraction.
template <class L>
inline Elimination<L> eliminate(const NodeBlock<L>& now, L bb, L aa, const CellMatrix<L>& K, NodeBlock<L>& after) {
  Elimination<L> e;
  const L ib = 1.0 / (now.bb + given_back * bb), l = now.ba * ib;
  const L left = now.aa + given_back * aa;
  const L ia = 1.0 / larger(left - l * now.ba, 1e-15 * left);
  const auto solve = [&](L rb, L ra, L& b, L& a) {
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

/// Eliminates a node next to rest, where a = tie · b.
inline Elimination<double> eliminate_tied(const NodeBlock<double>& now, double tie, const CellMatrix<double>& K,
                                          NodeBlock<double>& after) {
  Elimination<double> e;
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
