#include "core/cam/optimal/rest_to_rest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace bahnwerk::cam {
namespace {

constexpr double within = 4e-10;  // part of a limit by which a peak may be above it
constexpr double ramp = 1e-3;     // fraction of a stroke's duration for what jumps in the bound

/// Durations of the parts of constant jerk (four times), acceleration (twice) and velocity.
struct Parts {
  double jerk = 0, acceleration = 0, velocity = 0;
  double duration() const { return 4 * jerk + 2 * acceleration + velocity; }
};

/// The shortest motion over a stroke > 0 from rest to rest; limits may be infinite.
Parts shortest(double stroke, const DriveLimits& limit) {
  const double ramping = std::isfinite(limit.jerk) ? limit.acceleration / limit.jerk : 0;  // time to full acceleration
  const auto accelerate = [&](double velocity) {
    Parts out;
    if (std::isinf(limit.jerk)) {
      out.acceleration = velocity / limit.acceleration;
    } else if (velocity < limit.acceleration * ramping) {
      out.jerk = std::sqrt(velocity / limit.jerk);
    } else {
      out.jerk = ramping;
      out.acceleration = velocity / limit.acceleration - ramping;
    }
    return out;
  };
  if (std::isfinite(limit.velocity)) {
    Parts out = accelerate(limit.velocity);
    const double left = stroke - limit.velocity * (2 * out.jerk + out.acceleration);
    if (left >= 0) {
      out.velocity = left / limit.velocity;
      return out;
    }
  }
  if (std::isinf(limit.acceleration) || stroke < 2 * limit.acceleration * ramping * ramping)
    return {std::cbrt(stroke / (2 * limit.jerk)), 0, 0};
  return accelerate(limit.acceleration * (std::sqrt(ramping * ramping + 4 * stroke / limit.acceleration) - ramping) /
                    2);
}

/// The limits with ramps in the place of jumps.
DriveLimits with_ramps(DriveLimits limit, double duration) {
  if (std::isfinite(limit.jerk)) return limit;
  if (std::isinf(limit.acceleration)) limit.acceleration = limit.velocity / (ramp * duration);
  limit.jerk = limit.acceleration / (ramp * duration);
  return limit;
}

bool rests(const MotionLawProblem& problem, std::size_t p) {
  const MotionPoint& point = problem.points[p];
  if (!point.at.fixed() || !point.value(0).fixed() || problem.continuity(p) > 2) return false;
  const int highest = std::isfinite(problem.drive->jerk) ? 2 : 1;
  for (int r = 1; r <= 2; ++r)
    if (!(point.value(r).fixed() ? point.value(r).min == 0 : r > highest && point.value(r).free())) return false;
  return true;
}

/// Returns the largest part of its limit that a derivative of a cubic takes anywhere, less 1.
double excess(const std::array<double, 4>& b, double duration, const DriveLimits& limit) {
  const double first[] = {3 * (b[1] - b[0]) / duration, 3 * (b[2] - b[1]) / duration, 3 * (b[3] - b[2]) / duration};
  const double second[] = {2 * (first[1] - first[0]) / duration, 2 * (first[2] - first[1]) / duration};
  const double third = (second[1] - second[0]) / duration;
  return std::max({std::abs(first[0]) / limit.velocity, std::abs(first[2]) / limit.velocity,
                   std::abs(second[0]) / limit.acceleration, std::abs(second[1]) / limit.acceleration,
                   std::abs(third) / limit.jerk}) -
         1;
}

/// Moves the inner coefficients of a short piece by a few of their last digits where rounding takes its derivatives
/// above the limits; its ends stay.
void round_inward(std::array<double, 4>& b, double duration, const DriveLimits& limit) {
  constexpr int most = 3;
  const auto moved = [](double value, int digits) {
    for (int k = 0; k < std::abs(digits); ++k) value = std::nextafter(value, digits > 0 ? HUGE_VAL : -HUGE_VAL);
    return value;
  };
  double least = excess(b, duration, limit);
  const std::array<double, 4> given = b;
  for (int reach = 1; reach <= most && least > within; ++reach)
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j) {
        const std::array<double, 4> other{given[0], moved(given[1], i), moved(given[2], j), given[3]};
        if (const double now = excess(other, duration, limit); now < least) least = now, b = other;
      }
}

class Builder {
 public:
  Builder(const MotionLawProblem& problem, std::vector<Parts> parts) : problem_(problem), parts_(std::move(parts)) {}

  CamLaw at(double duration) {
    breaks_.clear(), pieces_.clear();
    MotionLawProblem timed = problem_;
    timed.cycle_duration = duration;
    std::vector<double> at;
    for (const MotionPoint& point : problem_.points) at.push_back(point.at.min);
    const std::vector<double> times = section_times(timed, at);
    for (std::size_t s = 0; s < problem_.sections(); ++s) section(s, times[s], times[s + 1]);
    breaks_.push_back(times.back());
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      if (std::vector<double>& b = pieces_[i].bernstein; b.size() == 4) {
        std::array<double, 4> cubic{b[0], b[1], b[2], b[3]};
        round_inward(cubic, breaks_[i + 1] - breaks_[i], *problem_.drive);
        b.assign(cubic.begin(), cubic.end());
      }
    return {breaks_, pieces_, problem_.periodic, problem_.travel};
  }

 private:
  void section(std::size_t s, double begin, double end) {
    const double from = problem_.points[s].value(0).min, to = problem_.end_position(s).min;
    if (from == to) {
      breaks_.push_back(begin);
      pieces_.push_back({s, {from, to}});
      return;
    }
    const double stretch = (end - begin) / parts_[s].duration();
    const double jerk_time = stretch * parts_[s].jerk, acceleration_time = stretch * parts_[s].acceleration;
    const double cruise = stretch * parts_[s].velocity;
    // The jerk from the stroke: half of it is passed in the middle.
    const double t = jerk_time, u = acceleration_time;
    const double jerk = (to - from) / (t * (t + u) * (2 * t + u + cruise));
    double time = 0, position = 0, velocity = 0, acceleration = 0;
    std::vector<std::pair<double, std::vector<double>>> half;  // begin, coefficients less `from`
    for (const auto& [duration, j] : {std::pair{t, jerk}, {u, 0.0}, {t, -jerk}}) {
      if (!(duration > 0)) continue;
      const double d = duration;
      const double next = position + d * (velocity + d * (acceleration / 2 + d * j / 6));
      half.push_back(
          {time,
           {position, position + d * velocity / 3, position + d * (2 * velocity / 3 + d * acceleration / 6), next}});
      position = next;
      velocity += d * (acceleration + d * j / 2);
      acceleration += d * j;
      time += d;
    }
    for (const auto& [at, b] : half) {
      breaks_.push_back(begin + at);
      pieces_.push_back({s, {from + b[0], from + b[1], from + b[2], from + b[3]}});
    }
    if (cruise > 0) {
      breaks_.push_back(begin + time);
      pieces_.push_back({s, {from + position, to - position}});
    }
    for (std::size_t i = half.size(); i-- > 0;) {  // the first half turned around
      const double until = i + 1 < half.size() ? half[i + 1].first : time;
      const auto& b = half[i].second;
      breaks_.push_back(end - until);
      pieces_.push_back({s, {to - b[3], to - b[2], to - b[1], to - b[0]}});
    }
  }

  const MotionLawProblem& problem_;
  std::vector<Parts> parts_;
  std::vector<double> breaks_;
  std::vector<LawPiece> pieces_;
};

/// By how much two ways to form a derivative from coefficients may differ: differences of neighbours are exact.
double rounding(const CamLaw& law, int order) {
  double out = 0;
  for (std::size_t i = 0; i < law.pieces(); ++i) {
    const auto& b = law.piece(i).bernstein;
    double now = 0;
    for (std::size_t k = 0; k + 1 < b.size(); ++k) now = std::max(now, std::abs(b[k + 1] - b[k]));
    now *= 3 * std::numeric_limits<double>::epsilon() / law.piece_duration(i);
    if (b.size() == 2 && order > 1) continue;
    for (int k = 1; k < order; ++k) now *= 2 * static_cast<double>(3 - k) / law.piece_duration(i);
    out = std::max(out, now);
  }
  return out;
}

bool keeps_sections(const MotionLawProblem& problem, const CamLaw& law) {
  for (std::size_t s = 0; s < problem.sections(); ++s)
    for (int r = 0; r < limited_orders; ++r) {
      const Range limit = problem.points[s].section[static_cast<std::size_t>(r)];
      if (limit.free()) continue;
      const LawExtremes extremes = law.section_extremes(r, s);
      const double slack = 1e-12 * law.peak(r).value;
      if (extremes.lowest.value < limit.min - slack || extremes.highest.value > limit.max + slack) return false;
    }
  return true;
}

}  // namespace

std::optional<RestToRest> rest_to_rest(const MotionLawProblem& problem) {
  if (!problem.vibration.empty()) return std::nullopt;
  for (std::size_t p = 0; p < problem.points.size(); ++p)
    if (!rests(problem, p) || problem.points[p].law) return std::nullopt;
  RestToRest out;
  std::vector<Parts> parts(problem.sections());
  for (std::size_t s = 0; s < problem.sections(); ++s) {
    const std::size_t e = problem.end_point(s);
    const double stroke = std::abs(problem.end_position(s).min - problem.points[s].value(0).min);
    if (stroke == 0) continue;
    const double angle = problem.points[e].at.min - problem.points[s].at.min + (e <= s ? problem.length : 0);
    const double least = shortest(stroke, *problem.drive).duration();
    parts[s] = shortest(stroke, with_ramps(*problem.drive, least));
    out.bound = std::max(out.bound, least * problem.length / angle);
    out.duration = std::max(out.duration, parts[s].duration() * problem.length / angle);
  }
  Builder builder(problem, std::move(parts));
  const double limit[] = {0, problem.drive->velocity, problem.drive->acceleration, problem.drive->jerk};
  for (int i = 0; i < 20; ++i) {  // rounding of positions may exceed a limit
    out.law = builder.at(out.duration);
    double exceeded = 0;
    for (int r = 1; r < limited_orders; ++r) {
      const double most = out.law.peak(r).value + rounding(out.law, r);
      exceeded = std::max(exceeded, std::pow(most / (limit[r] * (1 + 2 * within)), 1.0 / r));
    }
    if (exceeded <= 1) break;
    out.duration *= 1 + 1.2 * (exceeded - 1);
  }
  if (!keeps_sections(problem, out.law)) return std::nullopt;
  return out;
}

}  // namespace bahnwerk::cam
