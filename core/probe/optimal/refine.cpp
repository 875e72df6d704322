#include "core/probe/optimal/refine.hpp"

#include <cmath>

#include "core/probe/optimal/cell_rows.hpp"
#include "core/probe/optimal/chain_speed.hpp"

namespace bahnwerk {
namespace {

template <int D>
ChainNode<D> resting_node(const ChainLimits<D>& limits, std::size_t point) {
  ChainNode<D> node;
  node.state[0] = limits.points[point];
  node.point = static_cast<int>(point);
  if (limits.tolerance <= 0 && point > 0 && point + 1 < limits.points.size()) {
    double before = 0;
    for (int k = 0; k < D; ++k)
      before += (limits.points[point][k] - limits.points[point - 1][k]) *
                (limits.points[point + 1][k] - limits.points[point][k]);
    node.still = before < 0;
  }
  return node;
}

}  // namespace

template <int D>
void append_stopping_edge(CellChain<D>& chain, const ChainLimits<D>& limits, std::size_t edge) {
  constexpr double margin = 0.1;
  const Capsule<D> line = capsule<D>(limits.points[edge], limits.points[edge + 1], 0);
  ChainNode<D> end = resting_node(limits, edge + 1);
  const ChainNode<D> begin = resting_node(limits, edge);

  // A ramp from rest to nine tenths of the speed, as long as the limits ask for: slower by f it is f times as long and
  // derivative r + 1 is smaller by f^r.
  const double v = (1 - margin) * limits.speed;
  CellChain<D> ramp;
  ramp.node = {begin, begin};
  for (int k = 0; k < D; ++k) {
    ramp.node[1].state[0][k] += v / 2 * line.u[k];
    ramp.node[1].state[1][k] = v * line.u[k];
  }
  ramp.cell = {{1.0, edge}};
  CellValues<D> values;
  evaluate_cell(ramp.node[0], ramp.node[1], 1.0, values);
  double time = 0;
  for (std::size_t r = CellBasis::first[2]; r < CellBasis::rows; ++r) {
    const int order = cell_basis().order[r];
    for (int k = 0; k < D; ++k) {
      const double ratio =
          std::abs(values.q[r][k]) / limits.derivative[static_cast<std::size_t>(order - 2)][k] / (1 - margin);
      time = std::max(time, std::pow(ratio, 1.0 / (order - 1)));
    }
  }
  // Overshoot of the ramp's velocity above v is none: its Bézier points rise.
  const double ramp_length = v * time / 2;
  if (2.5 * ramp_length < line.length) {
    ChainNode<D> first = begin, second = end;
    first.point = second.point = -1;
    first.still = second.still = false;
    for (int k = 0; k < D; ++k) {
      first.state[0][k] += ramp_length * line.u[k];
      second.state[0][k] -= ramp_length * line.u[k];
      first.state[1][k] = second.state[1][k] = v * line.u[k];
    }
    chain.node.insert(chain.node.end(), {first, second, end});
    chain.cell.insert(chain.cell.end(),
                      {{time, edge, 0}, {(line.length - 2 * ramp_length) / v, edge, 0}, {time, edge, 0}});
    return;
  }
  CellChain<D> move;
  move.node = {begin, end};
  move.cell = {{line.length / limits.speed, edge}};
  const double duration = move.cell[0].duration * slowing_factor(move, limits, margin);
  chain.node.push_back(end);
  chain.cell.push_back({duration, edge, 0});
}

template <int D>
CellChain<D> refined(const CellChain<D>& chain, const ChainLimits<D>& limits, int level, double shortest) {
  constexpr double full = 0.998;
  CellChain<D> out;
  CellValues<D> v;
  for (std::size_t c = 0; c < chain.cell.size(); ++c) {
    const ChainCell& cell = chain.cell[c];
    out.node.push_back(chain.node[c]);
    bool split = cell.level < level && cell.duration > shortest;
    if (split) {
      evaluate_cell(chain.node[c], chain.node[c + 1], cell.duration, v);
      bool fast = true;
      for (std::size_t r = CellBasis::first[1]; r < CellBasis::first[2] && fast; ++r) {
        double sum = 0;
        for (int k = 0; k < D; ++k) sum += v.q[r][k] * v.q[r][k];
        fast = sum > full * full * limits.speed * limits.speed;
      }
      split = !fast;
    }
    if (!split) {
      out.cell.push_back(cell);
      continue;
    }
    ChainNode<D> middle;
    for (std::size_t p = 0; p < 4; ++p)
      for (int k = 0; k < D; ++k) {
        const std::size_t per_piece = 4 - p;  // rows of order p in a piece
        middle.state[p][k] = v.q[CellBasis::first[p] + 2 * per_piece][k];
      }
    out.node.push_back(middle);
    out.cell.push_back({cell.duration / 2, cell.edge, cell.level + 1});
    out.cell.push_back({cell.duration / 2, cell.edge, cell.level + 1});
  }
  out.node.push_back(chain.node.back());
  return out;
}

#define BAHNWERK_REFINE(D)                                                                  \
  template void append_stopping_edge<D>(CellChain<D>&, const ChainLimits<D>&, std::size_t); \
  template CellChain<D> refined<D>(const CellChain<D>&, const ChainLimits<D>&, int, double);
BAHNWERK_REFINE(1)
BAHNWERK_REFINE(2)
BAHNWERK_REFINE(3)
#undef BAHNWERK_REFINE

}  // namespace bahnwerk
