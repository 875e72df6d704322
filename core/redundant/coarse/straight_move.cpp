#include "core/redundant/coarse/straight_move.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/profile/profile.hpp"

namespace bahnwerk {
namespace {

constexpr double coarse_share =
    1 - 1e-5;  // used share of the coarse axes' limits; the rest exceeds the reduction of their boxes
constexpr int halvings = 60;
constexpr double rounding = 1e-12;   // relative rounding of a feed
constexpr double least_feed = 1e-3;  // least feed, relative to the peak speed without a cruise

}  // namespace

std::optional<StraightMove> straight_move(const AxisPath& path, const CoarseFineMachine& machine, const Machine& head,
                                          double feed, std::size_t first, std::size_t last) {
  if (last != first + 1 || !path.linear(first)) return std::nullopt;
  const Segment& segment = path[first];
  const AxisJet jet = path.at(first, segment.s0());
  StraightMove move{
      segment.s0(), segment.s1() - segment.s0(), first, {feed, unlimited, unlimited}, {feed, unlimited, unlimited},
      unlimited};
  const auto slower = [](double& value, double limit, double rate) { value = std::min(value, limit / rate); };
  double jerk = unlimited;
  for (std::size_t k = 0; k < machine.axes.size(); ++k) {
    const double rate = std::abs(jet.d1[k]);
    if (rate == 0) continue;
    const Limits& coarse = machine.axes[k].coarse;
    slower(move.fastest.feed, head.axes[k].velocity, rate);
    slower(move.fastest.rise, head.axes[k].acceleration, rate);
    slower(jerk, head.axes[k].jerk, rate);
    slower(move.slowest.feed, coarse_share * coarse.velocity, rate);
    slower(move.slowest.rise, coarse_share * coarse.acceleration, rate);
    if (coarse.jerk < unlimited)
      move.jerk_per_acceleration =
          std::min(move.jerk_per_acceleration, coarse_share * coarse.jerk / coarse.acceleration);
  }
  move.fastest.fall = move.fastest.rise;
  move.slowest.feed = std::min(move.slowest.feed, move.fastest.feed);
  move.slowest.rise = move.slowest.fall = std::min(move.slowest.rise, move.fastest.rise);
  move.jerk_per_acceleration = std::min(move.jerk_per_acceleration, jerk / move.fastest.rise);
  if (!(move.fastest.rise < unlimited)) return std::nullopt;
  return move;
}

double duration_of(const StraightMove& move, const Pace& pace) {
  const double per_square = 0.5 / pace.rise + 0.5 / pace.fall;  // length of rise and fall over speed²
  const double v = std::min({pace.feed, move.fastest.feed, std::sqrt(move.length / per_square)});
  return 2 * per_square * v + std::max(move.length - per_square * v * v, 0.0) / v;
}

Pace lasting(const StraightMove& move, Pace pace, double duration) {
  const double peak = std::min(std::sqrt(2 * move.length / (1 / pace.rise + 1 / pace.fall)), move.fastest.feed);
  double low = least_feed * peak, high = peak;
  pace.feed = high;
  if (duration_of(move, pace) >= duration) return pace;
  for (int i = 0; i < halvings && high - low > rounding * high; ++i) {
    pace.feed = 0.5 * (low + high);
    (duration_of(move, pace) > duration ? low : high) = pace.feed;
  }
  pace.feed = high;
  return pace;
}

void append_move(TimeLaw& law, const StraightMove& move, const Pace& pace) {
  const auto limits = [&](double speed, double acceleration) {
    const double jerk = move.jerk_per_acceleration < unlimited ? acceleration * move.jerk_per_acceleration : unlimited;
    return Limits{speed, acceleration, jerk, unlimited};
  };
  const auto way = [&](double speed) {
    return direct_distance(0, speed, limits(speed, pace.rise)) + direct_distance(speed, 0, limits(speed, pace.fall));
  };
  // The speed of a move without cruise stays below √(2 L A), the more so with limited jerk.
  double speed = std::min(pace.feed, std::sqrt(2 * move.length * std::max(pace.rise, pace.fall)));
  if (way(speed) > move.length) {
    double low = 0, high = speed;
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (low + high);
      (way(middle) <= move.length ? low : high) = middle;
    }
    speed = low;
  }
  const double braking = direct_distance(speed, 0, limits(speed, pace.fall));
  append(law, straight_profile(move.length - braking, 0, speed, limits(speed, pace.rise)), move.begin, move.segment);
  append(law, straight_profile(braking, speed, 0, limits(speed, pace.fall)), move.begin + move.length - braking,
         move.segment);
}

}  // namespace bahnwerk
