#include "core/verify/bound/jerk_ways.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bahnwerk::verify {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double least_limit = 1e-3;                    // of A_k: it leaves the solver some room
constexpr double v_margin = 1 + 1e-5, give = 1 + 1e-9;  // as in jerk_cap

}  // namespace

template <int N>
void JerkWays<N>::add(const DualPiece<N>& piece, const Row& ahead_of_it, const Row& behind_it, double speed_there) {
  speed = std::max(speed, speed_there);
  for (std::size_t k = 0; k < N; ++k) {
    const double sum = piece.begin[k] + piece.end[k];
    const int way = sum > 0 ? 1 : sum < 0 ? -1 : 0;
    const bool turns = way * direction[k] < 0;
    ahead[k] = turns ? infinite : std::max(ahead[k], ahead_of_it[k]);
    behind[k] = turns ? infinite : std::max(behind[k], behind_it[k]);
    size[k] = std::max(size[k], std::abs(sum) / 2);
    if (way != 0) direction[k] = way;
  }
}

template <int N>
RelaxationLimit<N> jerk_limit(const JerkWays<N>& before, const JerkWays<N>& after, const BoundGrid<N>& grid) {
  RelaxationLimit<N> limit;
  const double speed = std::max(before.speed, after.speed);
  for (std::size_t k = 0; k < grid.axes(); ++k) {
    const double most = grid.acceleration(k), jerk = 2 * grid.jerk(k) * v_margin;
    limit.fixed[k] = {most, most};
    const int direction = before.direction[k] != 0 ? before.direction[k] : after.direction[k];
    if (direction == 0 || direction * after.direction[k] < 0 || !(jerk < infinite)) continue;
    const double likely = std::sqrt(jerk * std::max(before.size[k], after.size[k]) * speed);
    const auto take = [&](std::size_t side, double beyond) {
      if (!(likely + beyond < most)) return;
      limit.fixed[k][side] = std::max(beyond * give, least_limit * most);
      limit.root[k][side] = std::sqrt(jerk);
    };
    take(direction > 0 ? 0 : 1, std::max(before.behind[k], after.behind[k]));
    take(direction > 0 ? 1 : 0, std::max(before.ahead[k], after.ahead[k]));
  }
  return limit;
}

template struct JerkWays<2>;
template struct JerkWays<3>;
template struct JerkWays<5>;
template struct JerkWays<8>;
template RelaxationLimit<2> jerk_limit(const JerkWays<2>&, const JerkWays<2>&, const BoundGrid<2>&);
template RelaxationLimit<3> jerk_limit(const JerkWays<3>&, const JerkWays<3>&, const BoundGrid<3>&);
template RelaxationLimit<5> jerk_limit(const JerkWays<5>&, const JerkWays<5>&, const BoundGrid<5>&);
template RelaxationLimit<8> jerk_limit(const JerkWays<8>&, const JerkWays<8>&, const BoundGrid<8>&);

}  // namespace bahnwerk::verify
