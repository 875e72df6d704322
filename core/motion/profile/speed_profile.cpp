#include "core/motion/profile/speed_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/machine/limits.hpp"
#include "core/motion/profile/profile_change.hpp"

namespace bahnwerk {
namespace {

constexpr double pi = std::numbers::pi;

void add(Rise& rise, const RisePiece& piece) {
  if (!(piece.duration > 0)) return;
  rise.piece[rise.count++] = piece;
  rise.duration += piece.duration;
  rise.acceleration = std::max(rise.acceleration, piece.a);
}

Rise trapezoid(double height, double acceleration, double) {
  Rise rise;
  rise.height = height;
  add(rise, {height / acceleration, 0, acceleration, 0, 0});
  return rise;
}

Rise double_s(double height, double acceleration, double jerk) {
  if (!(jerk < unlimited)) return trapezoid(height, acceleration, jerk);
  Rise rise;
  rise.height = height;
  const SpeedChange change = SpeedChangeLaw(acceleration, jerk, unlimited).shape(height);
  const double a = change.acceleration,
               rise_gain = change.jerk_hold * a / 2;  // gain of speed while the acceleration rises
  add(rise, {change.jerk_hold, 0, 0, change.jerk, 0});
  add(rise, {change.hold, rise_gain, a, 0, 0});
  add(rise, {change.jerk_hold, height - rise_gain, a, -change.jerk, 0});
  return rise;
}

/// The wave with height 1 and duration 1, in as many cubics as a rise holds.
struct Wave {
  static constexpr std::size_t parts = 16;
  std::array<RisePiece, parts> piece{};
  Wave() {
    constexpr double t = 1.0 / parts;
    const auto speed = [](std::size_t i) { return std::pow(std::sin(pi / 2 * static_cast<double>(i) * t), 2); };
    const auto acceleration = [](std::size_t i) {  // exactly symmetric, 0 at both ends
      const std::size_t n = std::min(i, parts - i);
      return n == 0 ? 0 : pi / 2 * std::sin(pi * static_cast<double>(n) * t);
    };
    for (std::size_t i = 0; i < parts; ++i) {
      const double a0 = acceleration(i), a1 = acceleration(i + 1);
      const double dv = (speed(i + 1) - speed(i) - a0 * t) / (t * t), da = (a1 - a0) / t;
      piece[i] = {t, speed(i), a0, 6 * dv - 2 * da, (6 * da - 12 * dv) / t};
    }
  }
  double largest_jerk() const { return piece[0].j; }
};

Rise trigonometric(double height, double acceleration, double jerk) {
  static const Wave wave;
  Rise rise;
  rise.height = height;
  if (!(height > 0)) return rise;
  const double T = std::max(pi / 2 * height / acceleration, std::sqrt(wave.largest_jerk() * height / jerk));
  const double a = height / T, j = a / T, q = j / T;
  for (const RisePiece& piece : wave.piece)
    add(rise, {T * piece.duration, height * piece.v, a * piece.a, j * piece.j, q * piece.snap});
  rise.duration = T;
  return rise;
}

constexpr SpeedProfileRow rows[] = {
    //  profile                      order  rise
    {SpeedProfile::double_s, 3, double_s},
    {SpeedProfile::trapezoid, 2, trapezoid},
    {SpeedProfile::trigonometric, 3, trigonometric},
};

}  // namespace

const SpeedProfileRow& speed_profile_row(SpeedProfile profile) {
  for (const SpeedProfileRow& row : rows)
    if (row.profile == profile) return row;
  throw std::logic_error("a speed profile without a row");
}

}  // namespace bahnwerk
