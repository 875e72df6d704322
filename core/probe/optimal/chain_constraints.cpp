#include "core/probe/optimal/chain_constraints.hpp"

#include <algorithm>

namespace bahnwerk {

template <int D>
bool ChainConstraints<D>::slacks(const CellChain<D>& chain, Slacks& out) const {
  CellValues<D> v;
  for (std::size_t c = 0; c < chain.cell.size(); ++c) {
    evaluate_cell(chain.node[c], chain.node[c + 1], chain.cell[c].duration, v);
    if (!slacks_of_cell(chain, c, v, out.cell[c])) return false;
  }
  for (std::size_t n = 0; n < chain.node.size(); ++n) {
    const ChainNode<D>& node = chain.node[n];
    if (node.point < 0 || component_given(node, 0)) continue;
    double sum = 0;
    for (int k = 0; k < D; ++k) sum += from_point(node, k) * from_point(node, k);
    out.ball[n] = 1 - sum / (ball_radius(node) * ball_radius(node));
    if (!(out.ball[n] > 0)) return false;
  }
  return true;
}

template <int D>
bool ChainConstraints<D>::slacks_of_cell(const CellChain<D>& chain, std::size_t c, const CellValues<D>& v,
                                         typename Slacks::Cell& out) const {
  double least = no_limit;
  const Capsule<D>& set = capsule_[chain.cell[c].edge];
  for (std::size_t r = 0; r < 17; ++r) {
    if (!tube_row(chain, c, r)) {
      out[r] = no_limit;
      continue;
    }
    bool cap;
    const std::array<double, D> d = offset(set, v.q[r], cap);
    double sum = 0;
    for (int k = 0; k < D; ++k) sum += d[k] * d[k];
    out[r] = 1 - sum / set.radius2;
    least = std::min(least, out[r]);
  }
  for (std::size_t r = 17; r < 30; ++r) {
    double sum = 0;
    for (int k = 0; k < D; ++k) sum += v.q[r][k] * v.q[r][k];
    out[r] = 1 - sum / (limits_.speed * limits_.speed);
    least = std::min(least, out[r]);
  }
  std::size_t at = 30;
  for (std::size_t r = 30; r < CellBasis::rows; ++r)
    for (int k = 0; k < D; ++k) {
      const double x = v.q[r][k] / derivative_limit(r, k);
      out[at++] = 1 - x;
      out[at++] = 1 + x;
      least = std::min({least, 1 - x, 1 + x});
    }
  out[at] = shortest_ > 0 ? std::log(chain.cell[c].duration / shortest_) : no_limit;
  least = std::min(least, out[at]);
  return least > 0;
}

template <int D>
double ChainConstraints<D>::logarithms(const Slacks& slack) {
  // Products of many slacks cost one logarithm.
  double product = 1, sum = 0;
  const auto add = [&](double g) {
    product *= g;
    if (product < 1e-200 || product > 1e200) {
      sum += std::log(product);
      product = 1;
    }
  };
  for (const auto& cell : slack.cell)
    for (double g : cell)
      if (g < no_limit) add(g);
  for (double g : slack.ball)
    if (g < no_limit) add(g);
  return sum + std::log(product);
}

template class ChainConstraints<1>;
template class ChainConstraints<2>;
template class ChainConstraints<3>;

}  // namespace bahnwerk
