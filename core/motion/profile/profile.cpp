#include "core/motion/profile/profile.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <sstream>
#include <vector>

#include "core/base/errors.hpp"
#include "core/motion/profile/profile_change.hpp"
#include "core/motion/profile/profile_pieces.hpp"

namespace bahnwerk {
namespace {

/// Parameters of the two changes of a move.
struct Task {
  SpeedChangeLaw law;
  double low, high;  // lower and higher one of the end speeds
  double gap() const { return high - low; }
  double direct() const { return (low + high) / 2 * law.duration(gap()); }
  /// Returns the distance when the profile dips to rest.
  double through_rest() const { return (low * law.duration(low) + high * law.duration(high)) / 2; }
  double least() const { return std::min(direct(), through_rest()); }
};

struct Value {
  double value, slope;
};

/// Returns the root of a continuous f in [low, high] with f(low), f(high) of opposite signs; f is increasing (direction
/// 1) or falls through zero (−1). It uses Newton's method from `high`, with bisection whenever the bracket would be
/// left: on convex f it converges from that side without bisection. Boost's newton_raphson_iterate is as fast, but
/// throws where rounding gives both ends one sign, and takes its direction from the slope, which leads away from a root
/// beyond a change of slope.
template <class F>
double root(F&& f, double low, double high, double direction) {
  double x = high, last = high - low;
  for (int i = 0; i < 200; ++i) {
    const auto [value, slope] = f(x);
    if (value == 0) return x;
    (direction * value > 0 ? high : low) = x;
    double next = x - value / slope;
    if (!(next > low && next < high) || (i > 8 && std::abs(next - x) > last / 2)) next = low + (high - low) / 2;
    last = std::abs(next - x);
    x = next;
    if (last <= 2.3e-16 * x || !(high - low > 4.5e-16 * high)) break;
  }
  return x;
}

/// Returns how far w is above both end speeds, for a move of `length` ≥ direct(); at most `most`. The unknown is the
/// time T of the smaller change, in which distances are smooth down to zero and piecewise convex.
double top(const Task& task, double length, double most) {
  const double spare = length - task.direct(), sum = task.low + task.high;
  if (!(spare > 0)) return 0;
  const SpeedChangeLaw& law = task.law;
  if (law.jumps()) {  // w² = (v0² + v1²)/2 + A L
    const double A = law.height_slope(0);
    const double w = std::sqrt((task.low * task.low + task.high * task.high) / 2 + A * length);
    return std::min(most, A * spare / (w + task.high));
  }
  auto distance = [&](double T) -> Value {
    const double d = law.height(T), d_slope = law.height_slope(T);
    const double value = (task.high + d / 2) * T, slope = task.high + d / 2 + T * d_slope / 2;
    if (task.gap() == 0) return {2 * value - length, 2 * slope};
    const double large = task.gap() + d, t = law.duration(large), mean = (sum + d) / 2;
    return {value + mean * t - length, slope + d_slope * (t / 2 + mean * law.slope(large))};
  };
  const double T_most = most < unlimited ? law.duration(most) : unlimited;
  if (most < unlimited && distance(T_most).value <= 0) return most;
  // The smaller change has at most the spare distance (d + 2 high) T/2, or half of it if both are alike.
  const double share = task.gap() == 0 ? spare / 2 : spare;
  const double T_high = std::min({T_most, share / task.high, law.duration_below(2 * share)});
  return law.height(root(distance, 0, T_high, 1));
}

/// Returns how far w is below both end speeds, for a move of least() ≤ length < direct(): the smallest such dip.
double dip(const Task& task, double length) {
  const SpeedChangeLaw& law = task.law;
  const double middle = (task.low + task.high) / 2;
  auto distance = [&](double T) -> Value {
    const double d = law.height(T), d_slope = law.height_slope(T), large = task.gap() + d, t = law.duration(large);
    return {(task.low - d / 2) * T + (middle - d / 2) * t - length,
            task.low - d / 2 - T * d_slope / 2 + d_slope * (-t / 2 + (middle - d / 2) * law.slope(large))};
  };
  // The function is piecewise concave: the first interval that ends below `length` contains the root, and only one.
  std::array<double, 3> end{law.full_height() - task.gap(), law.full_height(), task.low};
  double from = 0;
  for (const double d : end) {
    if (!(d > 0 && d <= task.low)) continue;
    const double to = law.duration(d);
    if (d == task.low || distance(to).value <= 0) return std::min(task.low, law.height(root(distance, from, to, -1)));
    from = to;
  }
  return task.low;
}

void require(std::vector<InputFault>& faults, bool ok, std::initializer_list<const char*> place, const char* message) {
  if (!ok) faults.push_back({{place.begin(), place.end()}, message});
}

void check(double distance, double start_speed, double end_speed, const Limits& limits) {
  std::vector<InputFault> faults;
  require(faults, distance >= 0 && distance < unlimited, {"distance"}, "must be finite and not negative");
  require(faults, start_speed >= 0 && start_speed < unlimited, {"start_speed"}, "must be finite and not negative");
  require(faults, end_speed >= 0 && end_speed < unlimited, {"end_speed"}, "must be finite and not negative");
  for (int order = 1; order <= Limits::highest_order; ++order)
    require(faults, limits.of(order) > 0, {"limits", derivative_name(order)}, "must be positive");
  if (faults.empty()) {
    require(faults, start_speed <= limits.velocity, {"start_speed"}, "is above the speed limit");
    require(faults, end_speed <= limits.velocity, {"end_speed"}, "is above the speed limit");
    require(faults, std::min({limits.acceleration, limits.jerk, limits.snap}) < unlimited, {"limits"},
            "acceleration, jerk or snap must be limited");
  }
  if (!faults.empty()) throw InvalidInput(std::move(faults));
}

Task task_of(double start_speed, double end_speed, const Limits& limits) {
  return {{limits.acceleration, limits.jerk, limits.snap},
          std::min(start_speed, end_speed),
          std::max(start_speed, end_speed)};
}

[[noreturn]] void too_short(double distance, double start_speed, double end_speed, double least) {
  std::ostringstream text;
  text.precision(12);
  text << "the speed cannot change from " << start_speed << " to " << end_speed << " mm/s within " << distance
       << " mm: at least " << least << " mm are needed";
  throw Infeasible(text.str());
}

}  // namespace

Profile straight_profile(double distance, double start_speed, double end_speed, const Limits& limits) {
  check(distance, start_speed, end_speed, limits);
  const Task task = task_of(start_speed, end_speed, limits);
  Profile profile;
  profile.distance = distance;
  profile.start_speed = start_speed;
  profile.end_speed = end_speed;
  double small = 0, large = 0;  // heights of the changes next to the higher and to the lower end speed, or the reverse
  const double direct = task.direct();
  const bool above = distance >= direct * (1 - 1e-12);
  if (above) {
    const double most = limits.velocity - task.high;
    small = top(task, distance, most);
    profile.turning_speed = small < most ? std::min(limits.velocity, task.high + small) : limits.velocity;
  } else {
    if (const double least = task.least(); !(distance >= least * (1 - 1e-12)))
      too_short(distance, start_speed, end_speed, least);
    small = dip(task, distance);
    profile.turning_speed = std::max(0.0, task.low - small);
  }
  large = task.gap() + small;
  // The change at the lower speed is the larger one above both ends, the change at the higher speed in a dip.
  const bool first_large = (start_speed < end_speed) == above;
  const SpeedChange one = task.law.shape(large), other = task.law.shape(small);
  lay_pieces(profile, first_large ? one : other, first_large ? other : one, limits);
  if (!std::isfinite(profile.duration))
    throw InvalidInput(std::vector<InputFault>{{{}, "distance, speeds and limits are too far apart to compute with"}});
  return profile;
}

double direct_distance(double start_speed, double end_speed, const Limits& limits) {
  check(0, start_speed, end_speed, limits);
  return task_of(start_speed, end_speed, limits).direct();
}

double min_distance(double start_speed, double end_speed, const Limits& limits) {
  check(0, start_speed, end_speed, limits);
  return task_of(start_speed, end_speed, limits).least();
}

ProfileState Profile::sample(double t) const {
  if (!(t < duration)) return {distance, end_speed, 0, 0, 0};
  std::size_t i = 0;
  while (i + 1 < count && t >= piece[i + 1].t0) ++i;
  ProfileState state = piece[i].at(std::clamp(t - piece[i].t0, 0.0, piece[i].duration));
  state.v = std::max(state.v, 0.0);  // rounding where it reaches rest
  return state;
}

void append(TimeLaw& law, const Profile& profile, double begin, std::size_t segment) {
  const auto pieces = profile.pieces();
  law.reserve(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const ProfilePiece& p = pieces[i];
    const double end = i + 1 < pieces.size() ? pieces[i + 1].s : profile.distance;
    law.append({0, p.duration, begin + p.s, begin + end, p.v, p.a, p.j, segment, p.snap});
  }
}

}  // namespace bahnwerk
