#pragma once
/// Which part of a Newton step each cell takes (core/numeric/gradual.hpp).
#include <algorithm>

#include "core/motion/jerk/rows.hpp"
#include "core/numeric/gradual.hpp"
#include "core/numeric/large_pages.hpp"

namespace bahnwerk {

/// In the order of solver.hpp: both halves of the section from its ends inwards.
struct JerkSteps {
  LargeVector<Twin> primal, dual;  ///< per cell: first 1/(the part that reaches a wall), after fit() the part taken
  LargeVector<Twin> node_primal, node_dual;  ///< per node: the smaller part of both its cells
  double mean_primal = 0, mean_dual = 0;

  void still(std::size_t cells) {
    primal.assign(cells, Twin{});
    dual.assign(cells, Twin{});
    node_primal.assign(cells + 1, Twin{});
    node_dual.assign(cells + 1, Twin{});
  }
  /// `reach` is the part of the way to the wall that may be taken; `even` the same part everywhere. `odd`: the last
  /// cell of the second half is the first half's last one once more.
  void fit(double reach, bool even, bool odd) {
    mean_primal = fit(primal, node_primal, reach, even, odd);
    mean_dual = fit(dual, node_dual, reach, even, odd);
  }

 private:
  static double fit(LargeVector<Twin>& part, LargeVector<Twin>& node, double reach, bool even, bool odd) {
    const std::size_t n = part.size();
    if (even) {
      Twin most = all(reach);
      for (const Twin p : part) most = larger(most, p);
      const double taken = reach / largest(most);
      part.assign(n, all(taken));
      node.assign(n + 1, all(taken));
      return taken;
    }
    Twin last = all(1), sum{};
    for (Twin& p : part) last = p = smaller(smaller(all(1), reach / p), next_part(last));
    // On across the middle, where either half meets the other one.
    const Twin other = {last[1], last[0]};
    part[n - 1] = smaller(last, odd ? other : next_part(other));
    last = all(1);
    for (std::size_t c = n; c-- > 0;) {
      last = part[c] = smaller(part[c], next_part(last));
      sum += last;
    }
    for (std::size_t i = 1; i < n; ++i) node[i] = smaller(part[i - 1], part[i]);
    const double middle = odd ? node[n - 1][1] : std::min(part[n - 1][0], part[n - 1][1]);
    node[n] = all(middle);
    const double twice = odd ? part[n - 1][1] : 0;
    return (sum[0] + sum[1] - twice) / static_cast<double>(odd ? twin * n - 1 : twin * n);
  }
};

}  // namespace bahnwerk
