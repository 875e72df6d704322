#pragma once
/// Which part of a Newton step each cell takes. One tight row would hold up a long run everywhere; so parts differ
/// along the run, but only gradually: where they differ, the step's linear equations hold no longer, by as much as they
/// differ from cell to cell.
#include <algorithm>

#include "core/numeric/large_pages.hpp"

namespace bahnwerk {

struct JerkSteps {
  LargeVector<double> primal, dual;  ///< per cell: first 1/(the part that reaches a wall), after fit() the part taken
  LargeVector<double> node_primal, node_dual;  ///< per node: the smaller part of both its cells
  double mean_primal = 0, mean_dual = 0;

  void still(std::size_t cells) {
    primal.assign(cells, 0);
    dual.assign(cells, 0);
    node_primal.assign(cells + 1, 0);
    node_dual.assign(cells + 1, 0);
  }
  /// `reach` is the part of the way to the wall that may be taken; `even` the same part everywhere.
  void fit(double reach, bool even) {
    mean_primal = fit(primal, node_primal, reach, even);
    mean_dual = fit(dual, node_dual, reach, even);
  }

 private:
  static constexpr double slope = 0.02, growth = 1.05;  // most that parts rise by from cell to cell
  static double fit(LargeVector<double>& part, LargeVector<double>& node, double reach, bool even) {
    const std::size_t n = part.size();
    if (even) {
      double most = reach;
      for (const double p : part) most = std::max(most, p);
      part.assign(n, reach / most);
      node.assign(n + 1, reach / most);
      return reach / most;
    }
    double last = 1, sum = 0;
    for (double& p : part) last = p = std::min(std::min(1.0, reach / p), std::min(last + slope, last * growth));
    last = 1;
    for (std::size_t c = n; c-- > 0;) {
      last = part[c] = std::min(part[c], std::min(last + slope, last * growth));
      sum += last;
    }
    for (std::size_t i = 1; i < n; ++i) node[i] = std::min(part[i - 1], part[i]);
    return sum / static_cast<double>(n);
  }
};

}  // namespace bahnwerk
