#include "core/verify/law_checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/verify/worst.hpp"

namespace bahnwerk::verify {
namespace {

constexpr double rest_tolerance = 1e-9;    // of the peak speed
constexpr double cover_tolerance = 1e-9;   // of the path length
constexpr double order_tolerance = 1e-12;  // of the path length: rounding of s(t) at the ends of pieces
constexpr std::size_t most_feeds = 32;     // checks written per document; beyond that the most strained ones

// Smallest and largest v of a piece with their moments: the ends and where a = 0.
struct SpeedRange {
  double low, high, low_at, high_at;
};
SpeedRange speed_range(const LawPiece& p) {
  SpeedRange r{p.v, p.v, p.t0, p.t0};
  auto offer = [&](double tau) {
    const double v = p.at(tau).v;
    if (!(v >= r.low)) r.low = v, r.low_at = p.t0 + tau;
    if (!(v <= r.high)) r.high = v, r.high_at = p.t0 + tau;
  };
  if (!p.constant_acceleration())
    for (const double tau : turning_points(p))
      if (tau > 0 && tau < p.duration) offer(tau);
  offer(p.duration);
  return r;
}

std::string feed_name(double feed) {
  char text[64];
  std::snprintf(text, sizeof text, "path velocity (feed %.10g)", feed);
  return text;
}

class LawChecker {
 public:
  explicit LawChecker(const JudgeInput& in) : in_(in), path_(in.contour.path), joints_(joints(path_)) {}

  std::vector<Check> run(Pulse& pulse) {
    const auto& pieces = in_.law.pieces();
    const std::vector<double> feeds = in_.contour.feeds();
    distinct_ = feeds;
    std::sort(distinct_.begin(), distinct_.end());
    distinct_.erase(std::unique(distinct_.begin(), distinct_.end()), distinct_.end());
    while (!distinct_.empty() && !(distinct_.back() < unlimited)) distinct_.pop_back();
    feed_peaks_.resize(distinct_.size());

    for (const LawPiece& p : pieces) {
      pulse.work(1);
      const SpeedRange v = speed_range(p);
      peak_.raise(v.high, v.high_at);
      if (in_.check_jerk) path_peaks(p);
      backward_.raise(-v.low, v.low_at);
      if (p.segment >= path_.size() || !(p.duration >= 0)) {
        outside_.raise(INFINITY, p.t0);
        continue;
      }
      if (feeds[p.segment] < unlimited) {
        const auto at = std::lower_bound(distinct_.begin(), distinct_.end(), feeds[p.segment]) - distinct_.begin();
        feed_peaks_[static_cast<std::size_t>(at)].raise(v.high, v.high_at);
      }
      const Segment& segment = path_[p.segment];
      outside_.raise(std::max(segment.s0() - p.s, p.s_end - segment.s1()), p.t0);
      outside_.raise(p.s - p.s_end, p.t0);
      position_gap_.raise(std::abs(p.at(p.duration).s - p.s_end), p.t0 + p.duration);
    }
    for (std::size_t i = 1; i < pieces.size(); ++i) pass(pieces[i - 1], pieces[i]);
    if (!pieces.empty()) {
      const LawPiece &first = pieces.front(), &last = pieces.back();
      start_.raise(std::abs(first.v), 0);
      acceleration_gap_.raise(std::abs(first.a), 0);
      acceleration_gap_.raise(std::abs(last.at(last.duration).a), in_.law.duration());
      end_.raise(std::abs(last.at(last.duration).v), in_.law.duration());
      uncovered_.raise(std::abs(first.s), 0);
      uncovered_.raise(std::abs(path_.length() - last.s_end), in_.law.duration());
    } else {
      uncovered_.raise(path_.length(), 0);
    }
    return report();
  }

 private:
  // Acceleration and jerk along the path: a is a parabola, j even.
  void path_peaks(const LawPiece& p) {
    for (const double tau : {0.0, turning_points(p)[2], p.duration}) {
      if (!(tau >= 0 && tau <= p.duration)) continue;
      const LawState x = p.at(tau);
      path_acceleration_.raise(std::abs(x.a), p.t0 + tau);
      path_jerk_.raise(std::abs(x.j), p.t0 + tau);
    }
  }

  // From one piece to the next: continuity, and what holds at the joints of the path that lie between.
  void pass(const LawPiece& before, const LawPiece& after) {
    const double t = after.t0, v0 = before.at(before.duration).v, v1 = after.v;
    velocity_gap_.raise(std::abs(v1 - v0), t);
    const double a0 = before.at(before.duration).a, a1 = after.a;
    acceleration_gap_.raise(std::abs(a1 - a0), t);
    position_gap_.raise(std::abs(after.s - before.s_end), t);
    time_gap_.raise(std::abs(after.t0 - (before.t0 + before.duration)), t);
    if (before.segment >= path_.size() || after.segment >= path_.size() || before.segment == after.segment) return;
    if (after.segment != before.segment + 1) {
      outside_.raise(INFINITY, t);
      return;
    }
    double v = std::max(std::abs(v0), std::abs(v1));
    if (std::isnan(v0)) v = v0;
    const Segment &left = path_[before.segment], &right = path_[after.segment];
    if (left.cusp_end() || right.cusp_begin()) has_cusp_ = true, cusp_.raise(v, t);
    const Vec there = right.at_parameter(right.curve().begin()).value;
    joint_gap_.raise(norm(left.at_parameter(left.curve().end()).value - there), t);
    distance_.raise(norm(left.at(before.s_end).value - there), t);
    distance_.raise(norm(right.at(after.s).value - there), t);
    const Joint& joint = joints_[before.segment];
    if (joint.angle > in_.corner_angle) {
      corner_.raise(v, t);
      acceleration_gap_.raise(std::max(std::abs(a0), std::abs(a1)), t);
      return;  // at rest no velocity step remains
    }
    if (in_.check_jerk) pass_joint(left, right, v, a0, a1, t);
    for (std::size_t k = 0; k < in_.machine.axes.size() && k < 3; ++k) {
      const double limit = in_.machine.axes[k].acceleration * in_.machine.cycle_time,
                   step = std::abs(joint.step[k]) * v;
      if (step_limit_ == 0 || !(step * step_limit_ <= step_.value * limit)) {
        step_limit_ = limit;
        step_.value = 0;
        step_.raise(step, t);
      }
    }
  }

  // What the axes' accelerations jump by where curvature does.
  void pass_joint(const Segment& left, const Segment& right, double v, double a0, double a1, double t) {
    const PathPoint l = left.at_parameter(left.curve().end()), r = right.at_parameter(right.curve().begin());
    for (std::size_t k = 0; k < in_.machine.axes.size() && k < 3; ++k) {
      const double limit = in_.machine.axes[k].jerk * in_.machine.cycle_time;
      if (!(limit < unlimited)) continue;
      const double step = std::abs((r.d2[k] - l.d2[k]) * v * v + r.d1[k] * a1 - l.d1[k] * a0);
      if (jump_limit_ == 0 || !(step * jump_limit_ <= jump_.value * limit)) {
        jump_limit_ = limit;
        jump_.value = 0;
        jump_.raise(step, t);
      }
    }
  }

  std::vector<Check> report() const {
    std::vector<Check> list;
    std::vector<Check> feeds;
    for (std::size_t i = 0; i < distinct_.size(); ++i)
      feeds.push_back(make_check(feed_name(distinct_[i]), "mm/s", distinct_[i], feed_peaks_[i]));
    if (feeds.size() > most_feeds) {
      std::stable_sort(feeds.begin(), feeds.end(), [](const Check& a, const Check& b) {
        if (a.passed != b.passed) return b.passed;
        return a.passed && a.value * b.limit > b.value * a.limit;
      });
      feeds.resize(most_feeds);
    }
    for (Check& c : feeds) list.push_back(std::move(c));
    if (in_.path.velocity < unlimited) list.push_back(make_check("path velocity", "mm/s", in_.path.velocity, peak_));
    if (in_.check_jerk && in_.path.acceleration < unlimited)
      list.push_back(make_check("path acceleration", "mm/s²", in_.path.acceleration, path_acceleration_));
    if (in_.check_jerk && in_.path.jerk < unlimited)
      list.push_back(make_check("path jerk", "mm/s³", in_.path.jerk, path_jerk_));
    const double rest = rest_tolerance * peak_.value, length = path_.length();
    if (!joints_.empty()) {
      list.push_back(make_check("velocity step at joints", "mm/s", step_limit_, step_));
      if (jump_limit_ > 0) list.push_back(make_check("acceleration step at joints", "mm/s²", jump_limit_, jump_));
      list.push_back(make_check("corner rest", "mm/s", rest, corner_));
    }
    if (has_cusp_) list.push_back(make_check("cusp rest", "mm/s", rest, cusp_));
    list.push_back(make_check("start at rest", "mm/s", rest, start_));
    list.push_back(make_check("end at rest", "mm/s", rest, end_));
    list.push_back(make_check("continuity of velocity", "mm/s", rest, velocity_gap_));
    const double law_limit = order_tolerance * length, joint_limit = in_.position_tolerance;
    if (in_.check_jerk)
      list.push_back(make_check("continuity of acceleration", "mm/s²", rest_tolerance * path_acceleration_.value,
                                acceleration_gap_));
    const bool law_worse = !(position_gap_.value * joint_limit < joint_gap_.value * law_limit);
    list.push_back(make_check("continuity of position", "mm", law_worse ? law_limit : joint_limit,
                              law_worse ? position_gap_ : joint_gap_));
    list.push_back(make_check("continuity of time", "s", order_tolerance * in_.law.duration(), time_gap_));
    list.push_back(make_check("pieces within segments", "mm", order_tolerance * length, outside_));
    list.push_back(make_check("forward motion", "mm/s", rest, backward_));
    list.push_back(make_check("path covered", "mm", cover_tolerance * length, uncovered_));
    list.push_back(make_check("distance from contour", "mm", in_.position_tolerance, distance_));
    return list;
  }

  const JudgeInput& in_;
  const Path& path_;
  std::vector<Joint> joints_;
  std::vector<double> distinct_;
  std::vector<Worst> feed_peaks_;
  double step_limit_ = 0, jump_limit_ = 0;
  bool has_cusp_ = false;
  Worst peak_, backward_, outside_, position_gap_, joint_gap_, velocity_gap_, time_gap_, step_, corner_, cusp_, start_,
      end_, uncovered_, distance_, path_acceleration_, path_jerk_, acceleration_gap_, jump_;
};

}  // namespace

std::vector<Check> law_checks(const JudgeInput& input, Pulse& pulse) { return LawChecker(input).run(pulse); }

}  // namespace bahnwerk::verify
