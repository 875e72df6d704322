#pragma once
/// Step lengths of a Newton step per cell. A single step length would be shortened everywhere by one tight row. Here
/// each cell has its own, and it rises only gradually from one cell to the next, because the step's linear equations
/// are violated by the difference of neighbouring step lengths.
#include <algorithm>

#include "core/motion/jerk/rows.hpp"
#include "core/numeric/interior_point/driver.hpp"
#include "core/numeric/large_pages.hpp"

namespace bahnwerk {

/// The order is that of solver.hpp: both halves of the section from its ends inwards.
struct JerkSteps {
  LargeVector<Lane2> primal,
      dual;  ///< inverse of the part of each cell's step that reaches a boundary; after fit() the part taken
  LargeVector<Lane2> node_primal, node_dual;  ///< part taken at each node, the smaller one of both its cells
  double mean_primal = 0, mean_dual = 0;

  void still(std::size_t cells) {
    primal.assign(cells, Lane2{});
    dual.assign(cells, Lane2{});
    node_primal.assign(cells + 1, Lane2{});
    node_dual.assign(cells + 1, Lane2{});
  }
  /// Chooses the parts. `reach` is the usable part of the distance to the boundary; `even` uses one part everywhere;
  /// `odd` says that the last cell of the second half repeats the last one of the first half.
  void fit(double reach, bool even, bool odd) {
    mean_primal = fit(primal, node_primal, reach, even, odd);
    mean_dual = fit(dual, node_dual, reach, even, odd);
  }

 private:
  /// Returns the largest step length next to `length`.
  static Lane2 next(Lane2 length) { return smaller(length + 0.02, 1.05 * length); }
  static double fit(LargeVector<Lane2>& part, LargeVector<Lane2>& node, double reach, bool even, bool odd) {
    const std::size_t n = part.size();
    if (even) {
      Lane2 most{};
      for (const Lane2 p : part) most = larger(most, p);
      const double taken = step_length(largest(most), reach);
      part.assign(n, all(taken));
      node.assign(n + 1, all(taken));
      return taken;
    }
    Lane2 last = all(1), sum{};
    for (Lane2& p : part) last = p = smaller(smaller(all(1), reach / p), next(last));
    // The sweep continues across the middle, where both halves meet.
    const Lane2 other = {last[1], last[0]};
    part[n - 1] = smaller(last, odd ? other : next(other));
    last = all(1);
    for (std::size_t c = n; c-- > 0;) {
      last = part[c] = smaller(part[c], next(last));
      sum += last;
    }
    for (std::size_t i = 1; i < n; ++i) node[i] = smaller(part[i - 1], part[i]);
    const double middle = odd ? node[n - 1][1] : std::min(part[n - 1][0], part[n - 1][1]);
    node[n] = all(middle);
    const double twice = odd ? part[n - 1][1] : 0;
    return (sum[0] + sum[1] - twice) / static_cast<double>(odd ? lane_count * n - 1 : lane_count * n);
  }
};

}  // namespace bahnwerk
