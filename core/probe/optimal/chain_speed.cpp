#include "core/probe/optimal/chain_speed.hpp"

#include <algorithm>
#include <cmath>

#include "core/probe/optimal/cell_rows.hpp"

namespace bahnwerk {

template <int D>
double slowing_factor(const CellChain<D>& chain, const ChainLimits<D>& limits, double margin) {
  double factor = 0;
  CellValues<D> v;
  for (std::size_t c = 0; c < chain.cell.size(); ++c) {
    evaluate_cell(chain.node[c], chain.node[c + 1], chain.cell[c].duration, v);
    for (std::size_t r = CellBasis::first[1]; r < CellBasis::rows; ++r) {
      const int order = cell_basis().order[r];
      double ratio = 0;
      for (int k = 0; k < D; ++k)
        ratio = order == 1
                    ? std::hypot(ratio, v.q[r][k] / limits.speed)
                    : std::max(ratio, std::abs(v.q[r][k]) / limits.derivative[static_cast<std::size_t>(order - 2)][k]);
      factor = std::max(factor, std::pow(ratio / (1 - margin), 1.0 / order));
    }
  }
  return factor;
}

template <int D>
void slow_down(CellChain<D>& chain, double factor) {
  for (ChainNode<D>& n : chain.node) {
    double scale = 1;
    for (int p = 1; p < 4; ++p) {
      scale /= factor;
      for (int k = 0; k < D; ++k) n.state[p][k] *= scale;
    }
  }
  for (ChainCell& c : chain.cell) c.duration *= factor;
}

#define BAHNWERK_CHAIN_SPEED(D)                                                          \
  template double slowing_factor<D>(const CellChain<D>&, const ChainLimits<D>&, double); \
  template void slow_down<D>(CellChain<D>&, double);
BAHNWERK_CHAIN_SPEED(1)
BAHNWERK_CHAIN_SPEED(2)
BAHNWERK_CHAIN_SPEED(3)
#undef BAHNWERK_CHAIN_SPEED

}  // namespace bahnwerk
