#include "core/redundant/joint/joint_split.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/redundant/coarse/carried_motion.hpp"
#include "core/redundant/head/following.hpp"
#include "core/redundant/joint/energy.hpp"

namespace bahnwerk {
namespace {

// Excess that counts as 0, in the chain's units, as a share of the reduction of the boxes (1e-6 of strokes and
// velocities). Intervals that were slowed must have no excess at all, so that the whole motion does not end just above
// the limit.
constexpr double followed = 2e-7;
constexpr double change =
    0.05;  // largest change of the acceleration in a cell, relative to the fine one's limit, which then matters
constexpr double jerk_change = 4e-3;  // range of the jerk times a cell's duration, relative to the fine acceleration
// Range of the jerk in a cell, relative to the fine jerk. With a range of twice the fine jerk no coarse jerk would be
// feasible for the whole cell.
constexpr double jerk_range = 1;
constexpr double rest_of_window =
    4;  // look-ahead of a window in the chain's unit of time, in addition to a stop of the axis

/// Returns the time, s, in which a coarse axis moves by one stroke; with limited jerk the time that the jerk needs for
/// it, if the acceleration is not reached.
template <std::size_t order>
double own_time(const CoarseFineAxis& axis) {
  const double time = chain_units(axis).time;
  return order == 2 ? time : std::max(time, std::cbrt(axis.stroke / axis.coarse.jerk));
}

void slow(Polynomial& p, double factor) {
  double power = 1;
  for (double& c : p) c /= power, power *= factor;
}

}  // namespace

template <std::size_t order>
bool JointSplit<order>::valid() const {
  return std::all_of(solutions.begin(), solutions.end(), [](const auto& s) { return s.exceeds.empty(); });
}

template <std::size_t order>
JointSplits<order>::JointSplits(const JointTask& task, double cell, std::function<void()> tick) : task_(task) {
  const Machine held = head_limits(task.machine);
  cell_options_.longest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < task.machine.axes.size(); ++k) {
    const bool splits = axis(k).stroke > 0;
    const Limits& fine = axis(k).fine;
    if (splits) axes_.push_back(k);
    if (splits) cell_options_.longest = std::min(cell_options_.longest, cell * own_time<order>(axis(k)));
    cell_options_.acceleration_change.push_back(splits && order == 2 ? change * fine.acceleration : unlimited);
    cell_options_.jerk_change.push_back(splits && order == 3 ? jerk_change * fine.acceleration : unlimited);
    cell_options_.jerk_range.push_back(splits && order == 3 ? jerk_range * fine.jerk : unlimited);
    cell_options_.held.push_back(held.axes[k]);
  }
  chain_options_.tick = std::move(tick);
}

template <std::size_t order>
HeadCellOptions JointSplits<order>::cells(const HeadReserve& reserve) const {
  HeadCellOptions cells = cell_options_;
  for (std::size_t k = 0; k < cells.held.size(); ++k) {
    double& held = cells.held[k].acceleration;
    held += reserve.unused_share * (std::min(held, axis(k).fine.acceleration) - held);
    held *= reserve.acceleration_share;
  }
  return cells;
}

template <std::size_t order>
double JointSplits<order>::ahead(std::size_t k) const {
  const Limits& coarse = axis(k).coarse;
  return ahead_ * (coarse.velocity / coarse.acceleration + rest_of_window * chain_units(axis(k)).time);
}

template <std::size_t order>
std::optional<std::vector<WindowedSolution<order>>> JointSplits<order>::solve(const HeadCells& cells, double stretch) {
  std::vector<WindowedSolution<order>> solutions;
  for (const std::size_t k : axes_) {
    ChainWindowOptions windows;
    windows.ahead = ahead(k) / chain_units(axis(k)).time;
    windows.followed = followed;
    const std::optional<Chain<order>> chain = following<order>(cells, k, axis(k), stretch);
    if (!chain) return std::nullopt;
    solutions.push_back(solve_in_windows(*chain, chain_options_, windows));
    iterations_ += solutions.back().iterations;
  }
  return solutions;
}

template <std::size_t order>
std::shared_ptr<const PathMotion> JointSplits<order>::head_of(const JointSplit<order>& split) const {
  if (split.stretch == 1) return split.head;
  return std::make_shared<const PathMotion>(task_.path, split.head->law().slowed(split.stretch));
}

template <std::size_t order>
std::shared_ptr<const Motion> JointSplits<order>::coarse_of(const JointSplit<order>& split,
                                                            std::shared_ptr<const PathMotion> head) const {
  const std::size_t all = task_.machine.axes.size();
  std::vector<SplineMotion::Piece> pieces = split.closed.empty() ? pieces_of(split, head->duration()) : split.closed;
  if (!split.closed.empty() && split.slowed > 1) {
    const std::vector<LawPiece>::size_type n = head->law().pieces().size();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      pieces[i].end = i + 1 < n ? head->law().pieces()[i + 1].t0 : head->duration();
      for (Polynomial& p : pieces[i].axes) slow(p, split.slowed);
    }
  }
  auto spline = std::make_shared<const SplineMotion>(std::move(pieces));
  if (axes_.size() == all || !split.closed.empty()) return spline;
  std::vector<bool> carried(all, true);
  for (const std::size_t k : axes_) carried[k] = false;
  return std::make_shared<const CarriedMotion>(std::move(head), std::move(spline), std::move(carried));
}

template <std::size_t order>
std::vector<SplineMotion::Piece> JointSplits<order>::pieces_of(const JointSplit<order>& split, double duration) const {
  const HeadCells& cells = split.cells;
  std::vector<SplineMotion::Piece> coarse(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    coarse[c].end = c + 1 < cells.size() ? cells.times[c + 1] * split.stretch : duration;
    coarse[c].axes.assign(task_.machine.axes.size(), Polynomial{0});
  }
  for (std::size_t j = 0; j < axes_.size(); ++j) {
    const ChainUnits u = chain_units(axis(axes_[j]));
    const WindowedSolution<order>& solution = split.solutions[j];
    const ChainState<order>& first = solution.states.front();
    // Coefficients over time: x, v, for order 3 a/2; the last one belongs to the control.
    Polynomial p{first[0] * u.length, first[1] * u.velocity()};
    if constexpr (order == 3) p.push_back(0.5 * first[2] * u.acceleration());
    p.push_back(0);
    slow(p, split.slowed);
    const double control = (order == 2 ? u.acceleration() / 2 : u.jerk() / 6) / std::pow(split.slowed, order);
    // Each piece begins exactly where the one before ends; the solution's own states contain the rounding of the
    // solver's first guesses.
    double begin = 0;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      p[order] = solution.controls[c] * control;
      coarse[c].axes[axes_[j]] = p;
      p = shifted(std::move(p), coarse[c].end - begin, 1);
      begin = coarse[c].end;
    }
  }
  return coarse;
}

template <std::size_t order>
Trade JointSplits<order>::trade(double stretch, const JointSplit<order>& split) const {
  const std::size_t all = task_.machine.axes.size();
  Trade t{stretch, split.head->duration() * split.stretch, std::vector<double>(all)};
  if (split.solutions.size() < all) {  // some axes are those of the head
    t.energy = acceleration_energy(*coarse_of(split, head_of(split)));
    return t;
  }
  for (std::size_t j = 0; j < axes_.size(); ++j) {
    const ChainUnits u = chain_units(axis(axes_[j]));
    t.energy[axes_[j]] =
        split.solutions[j].energy * u.acceleration() * u.acceleration() * u.time / std::pow(split.slowed, 3);
  }
  return t;
}

template <std::size_t order>
double JointSplits<order>::energy(const JointSplit<order>& split) const {
  double sum = 0;
  for (const double e : trade(split.stretch, split).energy) sum += e;
  return sum;
}

template struct JointSplit<2>;
template struct JointSplit<3>;
template class JointSplits<2>;
template class JointSplits<3>;

}  // namespace bahnwerk
