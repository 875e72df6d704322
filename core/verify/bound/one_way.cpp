#include "core/verify/bound/one_way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bahnwerk::verify {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// Jumps of q' up to this part of it are rounding; each adds a step of this part of the axis' acceleration, and the
// distance ends when many of them have added up.
constexpr double no_jump = 1e-9, step_of_jump = 1e-5, most_steps = 0.02;

}  // namespace

// Sweeps from the end of the distance to its beginning; with `forwards` the distances ahead, so the pass runs
// backwards.
template <int N>
void OneWay<N>::pass(const BoundGrid<N>& grid, const std::vector<double>& b, bool forwards, bool rest,
                     double cycle_time, Ends& ends) const {
  const auto& nodes = grid.nodes();
  const auto& cells = grid.cells();
  const std::size_t n = b.size() - 1;
  ends.of.resize(n), ends.list.clear();
  bool changed = true;
  std::array<End, N> now;
  std::array<int, N> sign{};  // sign of q' there, 0 as long as the axis stands still
  // The distance ends at a node. b is at most `cap` there.
  const auto end = [&](const BoundNode<N>& node, std::size_t k, double cap) {
    const double size = std::abs(node.tangent[k]) + node.rounding_error, q2 = std::abs(node.curvature[k]) * cap,
                 most = size > 0 ? q2 + size * grid.along(node, node, cap) : q2;
    now[k] = {node.position[k], 0, std::min(most * (1 + 1e-9), grid.acceleration(k))}, sign[k] = 0;
  };
  for (std::size_t k = 0; k < grid.axes(); ++k) {
    end(nodes[forwards ? n : 0], k, b[forwards ? n : 0]);
    if (rest) now[k] = {infinite, 0, 0};
  }
  for (std::size_t step = 0; step < n; ++step) {
    const std::size_t i = forwards ? n - 1 - step : step;
    const BoundNode<N>&from = nodes[i], &to = nodes[i + 1], &near = forwards ? from : to, &far = forwards ? to : from;
    const BoundCell<N>& cell = cells[i];
    // An axis that turns round at a node does so in no cell.
    if (cell.kind != BoundCell<N>::Kind::joint)
      for (std::size_t k = 0; k < grid.axes(); ++k) {
        const double sum = from.tangent[k] + to.tangent[k];
        const int way = sum > 0 ? 1 : sum < 0 ? -1 : 0;
        if (way * sign[k] < 0) end(far, k, b[forwards ? i + 1 : i]), changed = true;
        if (way != 0) sign[k] = way;
      }
    if (changed) ends.list.push_back(now);
    ends.of[i] = static_cast<std::uint32_t>(ends.list.size() - 1);
    changed = cell.kind == BoundCell<N>::Kind::joint || cell.turning != 0;
    const double cap = std::min(b[i], b[i + 1]);
    double along = -1;
    for (std::size_t k = 0; k < grid.axes(); ++k) {
      bool turns = (cell.turning >> k & 1u) != 0;
      if (cell.kind == BoundCell<N>::Kind::joint) {
        const double tangent_jump = std::abs(to.tangent[k] - from.tangent[k]);
        double change = std::abs(to.curvature[k] - from.curvature[k]) * cap;
        if (tangent_jump > 0 && along < 0) along = grid.along(from, to, cap);
        if (tangent_jump > 0) change += tangent_jump * along;
        now[k].steps += std::min(grid.jerk(k) * cycle_time, change) * (1 + 1e-9);
        if (tangent_jump > 0) now[k].steps += step_of_jump * grid.acceleration(k);
        turns = turns || tangent_jump > no_jump * std::min(std::abs(from.tangent[k]), std::abs(to.tangent[k])) ||
                now[k].steps > most_steps * grid.acceleration(k);
      }
      if (turns) end(near, k, b[forwards ? i : i + 1]);
    }
  }
}

template <int N>
void OneWay<N>::take(const BoundGrid<N>& grid, const std::vector<double>& b, bool rest_first, bool rest_last,
                     double cycle_time) {
  grid_ = &grid;
  pass(grid, b, true, rest_last, cycle_time, ahead_);
  pass(grid, b, false, rest_first, cycle_time, behind_);
}

template <int N>
void OneWay<N>::set(JerkCapPiece<N>& piece, const BoundNode<N>& from, const BoundNode<N>& to, std::size_t first,
                    std::size_t last) const {
  unsigned turning = 0;
  for (std::size_t i = first; i <= last; ++i) turning |= grid_->cells()[i].turning;
  const auto way = [](const End& end, double place) {
    const double sure = std::abs(end.at - place) - 64 * epsilon * (std::abs(end.at) + std::abs(place));
    return AxisWay{end.at < infinite ? std::max(0.0, sure) : infinite, end.steps, end.acceleration};
  };
  for (std::size_t k = 0; k < grid_->axes(); ++k) {
    piece.ahead[k] = piece.behind[k] = {};
    if ((turning >> k & 1u) != 0) continue;
    piece.ahead[k] = way(ahead_.at(last)[k], to.position[k]);
    piece.behind[k] = way(behind_.at(first)[k], from.position[k]);
  }
}

template class OneWay<2>;
template class OneWay<3>;
template class OneWay<5>;
template class OneWay<8>;

}  // namespace bahnwerk::verify
