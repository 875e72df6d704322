#include "core/redundant/chain/clusters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bahnwerk {
namespace {

template <std::size_t order>
double excess_at(const Chain<order>& chain, const ChainSolution<order>& s, std::size_t node) {
  double excess = 0;
  for (std::size_t k = 0; k < order; ++k)
    if (chain.counts(node, k))
      excess = std::max({excess, s.states[node][k] - chain.states[node][k].highest,
                         chain.states[node][k].lowest - s.states[node][k]});
  return excess;
}

/// Returns the weighted excess of the states on an interval.
template <std::size_t order>
double weighed_excess(const Chain<order>& chain, const ChainSolution<order>& s, std::size_t first, std::size_t last) {
  double sum = 0;
  for (std::size_t i = first; i <= last; ++i)
    for (std::size_t k = 0; k < order; ++k) {
      if (!chain.counts(i, k)) continue;
      const double over = s.states[i][k] - chain.states[i][k].highest,
                   under = chain.states[i][k].lowest - s.states[i][k];
      if (over > 0) sum += over * std::max(s.multipliers[i][k], 0.0);
      if (under > 0) sum -= under * std::min(s.multipliers[i][k], 0.0);
    }
  return sum;
}

template <std::size_t order>
double size(const ChainState<order>& x) {
  double most = 0;
  for (const double v : x) most = std::max(most, std::abs(v));
  return most;
}

}  // namespace

template <std::size_t order>
std::vector<Cluster<order>> clusters(const Chain<order>& chain, const ChainSolution<order>& solution,
                                     double tolerance) {
  const std::size_t n = chain.cells();
  Certificate<order> all{0, n, solution.multipliers, solution.at_end, 0};
  std::vector<ChainState<order>> costates;
  infeasibility(chain, all, &costates);
  std::vector<double> sizes(n + 1);
  for (std::size_t i = 0; i <= n; ++i) sizes[i] = size<order>(costates[i]);

  std::vector<Cluster<order>> found;
  for (std::size_t i = 0; i <= n; ++i) {
    if (!(excess_at(chain, solution, i) > tolerance)) continue;
    Cluster<order> best;
    best.certificate.value = -std::numeric_limits<double>::infinity();
    for (const double share : {1e-2, 1e-3, 1e-4, 1e-5}) {
      std::size_t first = i, last = i;
      double peak = sizes[i];
      while (first > 0 && sizes[first] > share * peak) peak = std::max(peak, sizes[--first]);
      while (last < n && (last < i + 2 || sizes[last] > share * peak)) peak = std::max(peak, sizes[++last]);
      if (best.last == 0) {
        best.first = first;
        best.last = last;
      }
      Certificate<order> c{first,
                           last,
                           {solution.multipliers.begin() + static_cast<std::ptrdiff_t>(first),
                            solution.multipliers.begin() + static_cast<std::ptrdiff_t>(last) + 1},
                           solution.at_end,
                           0};
      c.value = infeasibility(chain, c);
      const bool enough = c.value > 0.9 * weighed_excess(chain, solution, first, last);
      if (c.value > best.certificate.value || best.certificate.multipliers.empty()) best.certificate = std::move(c);
      if (enough) break;
    }
    const std::size_t first = best.certificate.first, last = best.certificate.last;
    best.need = std::max(best.certificate.value, weighed_excess(chain, solution, first, last));
    best.gain.resize(last - first);
    for (std::size_t c = first; c < last; ++c) {
      const ChainState<order>&l = costates[c + 1], &x = solution.states[c + 1];
      double rate = l[order - 1] * solution.controls[c];
      for (std::size_t k = 0; k + 1 < order; ++k) rate += l[k] * x[k + 1];
      best.gain[c - first] = -rate;
    }
    found.push_back(std::move(best));
    i = std::max(i, last);
  }
  return found;
}

template std::vector<Cluster<2>> clusters(const Chain<2>&, const ChainSolution<2>&, double);
template std::vector<Cluster<3>> clusters(const Chain<3>&, const ChainSolution<3>&, double);

}  // namespace bahnwerk
