#pragma once
/// A chain of cells as polynomials in time.
#include "core/motion/axes/spline_motion.hpp"
#include "core/numeric/polynomial.hpp"
#include "core/probe/landing.hpp"
#include "core/probe/optimal/cell_rows.hpp"
#include "core/probe/optimal/chain.hpp"
#include "core/probe/probe_motion.hpp"

namespace bahnwerk {

/// Appends the four pieces of each cell as coefficients of the time since the piece began: quartics, the last one of
/// degree 6, which compensates rounding. `place` turns the coefficients of D coordinates into those of the machine's
/// axes. Appends to `times` the time, s, at which each point after the first is passed.
template <int D, typename Place>
void append_pieces(const CellChain<D>& chain, Place&& place, std::vector<SplineMotion::Piece>& pieces,
                   std::vector<double>& times);

/// Returns the quartic with state (x, v, a, j) at its begin and a constant snap.
inline Polynomial quartic(const std::array<double, 4>& state, double snap) {
  return {state[0], state[1], state[2] / 2, state[3] / 6, snap / 24};
}

/// Adds a polynomial to a piece of duration T, s, whose end then has velocity, acceleration and jerk of `node`; the
/// position at its end is free.
inline void land(Polynomial& p, double T, const std::array<double, 4>& node) {
  const std::array<double, 4> reached = state_at(p, T);
  const auto rest = probe::landing<double>(node[1] - reached[1], node[2] - reached[2], node[3] - reached[3], T);
  p[4] += rest[0];
  p.push_back(rest[1]);
  p.push_back(rest[2]);
}

template <int D, typename Place>
void append_pieces(const CellChain<D>& chain, Place&& place, std::vector<SplineMotion::Piece>& pieces,
                   std::vector<double>& times) {
  double t = pieces.empty() ? 0 : pieces.back().end;
  CellValues<D> v;
  std::array<double, D> position = chain.node.front().state[0];
  for (std::size_t c = 0; c < chain.cell.size(); ++c) {
    const ChainNode<D>&from = chain.node[c], &to = chain.node[c + 1];
    const double duration = chain.cell[c].duration, h = duration / CellBasis::pieces;
    evaluate_cell(from, to, duration, v);
    // A state is carried from piece to piece and from there on to the node, so that both sides of every joint agree to
    // the rounding of their own terms; the positions are carried through all of them.
    std::array<std::array<double, 4>, D> state;
    for (std::size_t k = 0; k < D; ++k) state[k] = {position[k], from.state[1][k], from.state[2][k], from.state[3][k]};
    double begin = t;
    for (std::size_t piece = 0; piece < CellBasis::pieces; ++piece) {
      const bool last = piece + 1 == CellBasis::pieces;
      const double end = last ? t + duration : t + static_cast<double>(piece + 1) * h, T = end - begin;
      std::array<Polynomial, D> x;
      for (std::size_t k = 0; k < D; ++k) {
        x[k] = quartic(state[k], v.q[CellBasis::first[4] + piece][k]);
        if (last) land(x[k], T, {0, to.state[1][k], to.state[2][k], to.state[3][k]});
        state[k] = state_at(x[k], T);
      }
      pieces.push_back({end, place(x)});
      begin = end;
    }
    for (std::size_t k = 0; k < D; ++k) position[k] = state[k][0];
    t += duration;
    if (to.point >= 0) times.push_back(t);
  }
}

}  // namespace bahnwerk
