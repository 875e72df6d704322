#include "core/redundant/head/following.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {
namespace {

constexpr double excess_allowed = 1e-6;  // relative excess of a limit that counts as rounding of the head's planner
constexpr double kept =
    1 - 1e-6;  // share of strokes and velocities that boxes use; the rest exceeds the solver's residual

/// Returns the range of the coarse axis, whose own limit is `coarse`, such that the fine axis keeps its limit `fine`
/// while the head's value lies in `head`; none if the head exceeds both limits.
std::optional<Range> left(double coarse, double fine, const Range& head) {
  Range r{std::max(-coarse, head.highest - fine), std::min(coarse, head.lowest + fine)};
  if (r.lowest > r.highest) {
    if (r.lowest - r.highest > excess_allowed * (coarse + fine)) return std::nullopt;
    r.lowest = r.highest = std::clamp(r.middle(), -coarse, coarse);
  }
  return r;
}

}  // namespace

ChainUnits chain_units(const CoarseFineAxis& axis) {
  return {axis.stroke, std::sqrt(axis.stroke / axis.coarse.acceleration)};
}

template <std::size_t order>
std::optional<Chain<order>> following(const HeadCells& head, std::size_t axis, const CoarseFineAxis& limits,
                                      double stretch) {
  const ChainUnits units = chain_units(limits);
  const std::vector<HeadNode>& nodes = head.nodes[axis];
  const std::vector<HeadCell>& cells = head.cells[axis];
  const std::size_t n = head.size();
  const double s1 = 1 / stretch, s2 = s1 * s1, s3 = s2 * s1;
  const auto slowed = [](const Range& r, double by) { return Range{r.lowest * by, r.highest * by}; };
  const auto scaled = [](const Range& r, double unit) { return Range{r.lowest / unit, r.highest / unit}; };

  Chain<order> chain;
  chain.steps.resize(n);
  chain.controls.resize(n);
  chain.states.resize(n + 1);
  for (std::size_t c = 0; c < n; ++c) {
    chain.steps[c] = (head.times[c + 1] - head.times[c]) * stretch / units.time;
    const std::optional<Range> box =
        order == 2 ? left(limits.coarse.acceleration, limits.fine.acceleration, slowed(cells[c].acceleration, s2))
                   : left(limits.coarse.jerk, limits.fine.jerk, slowed(cells[c].jerk, s3));
    if (!box) return std::nullopt;
    chain.controls[c] = scaled(*box, order == 2 ? units.acceleration() : units.jerk());
  }
  for (std::size_t i = 0; i <= n; ++i) {
    // Reductions of the boxes that the cells on both sides require.
    double position = 0, own_position = 0, velocity = 0, own_velocity = 0, acceleration = 0;
    for (std::size_t c = i > 0 ? i - 1 : 0; c < std::min(i + 1, n); ++c) {
      const double h = (head.times[c + 1] - head.times[c]) * stretch;
      position = std::max(position, limits.fine.acceleration * h * h / 8);
      own_position = std::max(own_position, limits.coarse.acceleration * h * h / 8);
      velocity = std::max(velocity, 0.25 * h * cells[c].acceleration.width() * s2);
      if (order == 3)
        own_velocity = std::max(own_velocity, std::min(limits.coarse.jerk * h / 8, limits.coarse.acceleration / 4) * h);
      acceleration = std::max(acceleration, 0.25 * h * cells[c].jerk.width() * s3);
    }
    const auto both = [](double after, double jump) {
      return Range{std::min(after, after - jump), std::max(after, after - jump)};
    };
    const double x = nodes[i].x;
    const Range v = slowed(both(nodes[i].v, nodes[i].v_jump), s1), a = slowed(both(nodes[i].a, nodes[i].a_jump), s2);
    const double reach = std::max(kept * limits.stroke - position, 0.5 * limits.stroke);
    Range box{std::max(x - reach, limits.coarse.lowest), std::min(x + reach, limits.coarse.highest)};
    const double inside = std::clamp(0.5 * (box.highest - box.lowest), 0.0, own_position);
    if (limits.coarse.lowest > x - reach) box.lowest += inside;
    if (limits.coarse.highest < x + reach) box.highest -= inside;
    chain.states[i][0] = scaled(box, units.length);
    const double own = kept * limits.coarse.velocity - own_velocity,
                 fine = kept * limits.fine.velocity - own_velocity - velocity;
    chain.states[i][1] = scaled({std::max(-own, v.highest - fine), std::min(own, v.lowest + fine)}, units.velocity());
    if constexpr (order == 3)
      chain.states[i][2] =
          scaled({std::max(-limits.coarse.acceleration, a.highest - limits.fine.acceleration + acceleration),
                  std::min(limits.coarse.acceleration, a.lowest + limits.fine.acceleration - acceleration)},
                 units.acceleration());
  }
  return chain;
}

template std::optional<Chain<2>> following(const HeadCells&, std::size_t, const CoarseFineAxis&, double);
template std::optional<Chain<3>> following(const HeadCells&, std::size_t, const CoarseFineAxis&, double);

}  // namespace bahnwerk
