#include "core/redundant/chain/certificate.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {
namespace {

/// Returns the least value of g·x for x in a range.
double least(double g, const Range& r) { return g > 0 ? g * r.lowest : g < 0 ? g * r.highest : 0; }

}  // namespace

template <std::size_t order>
double infeasibility(const Chain<order>& chain, const Certificate<order>& certificate,
                     std::vector<ChainState<order>>* costates) {
  const std::size_t first = certificate.first, last = certificate.last;
  if (costates) costates->resize(last - first + 1);
  ChainState<order> costate{};
  double value = 0;
  const auto arrive = [&](std::size_t node) {
    for (std::size_t k = 0; k < order; ++k) {
      const double z = certificate.multipliers[node - first][k];
      if (!chain.counts(node, k) || z == 0) continue;
      costate[k] += z;
      value -= z > 0 ? z * chain.states[node][k].highest : z * chain.states[node][k].lowest;
    }
    if (costates) (*costates)[node - first] = costate;
  };
  if (last == chain.cells() && chain.ends_at_rest)
    for (std::size_t k = 1; k < order; ++k) costate[k] = certificate.at_end[k];
  arrive(last);
  for (std::size_t c = last; c-- > first;) {
    value += least(by_control<order>(costate, chain.steps[c]), chain.controls[c]);
    costate = pulled_back<order>(costate, chain.steps[c]);
    arrive(c);
  }
  for (std::size_t k = 0; k < order; ++k)
    if (first == 0 && chain.begin)
      value += costate[k] * (*chain.begin)[k];
    else if (chain.counts(first, k))
      value += least(costate[k], chain.states[first][k]);
  return value;
}

template double infeasibility(const Chain<2>&, const Certificate<2>&, std::vector<ChainState<2>>*);
template double infeasibility(const Chain<3>&, const Certificate<3>&, std::vector<ChainState<3>>*);

}  // namespace bahnwerk
