#include "core/verify/law/law_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/verify/rounding.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk::verify {
namespace {

constexpr std::size_t max_feeds = 32;  // checks written per document; beyond that the most strained ones

// A piece with values that are used more than once.
struct Passed {
  const LawPiece* piece;
  LawState end;
  PieceRounding rounding;
  explicit Passed(const LawPiece& p) : piece(&p), end(p.at(p.duration)), rounding(rounding_of(p)) {}
};

// Smallest and largest v of a piece with their moments: the ends and where a = 0.
struct SpeedRange {
  double low, high, low_at, high_at;
};
SpeedRange speed_range(const Passed& passed) {
  const LawPiece& p = *passed.piece;
  SpeedRange r{p.v, p.v, p.t0, p.t0};
  auto offer = [&](double v, double tau) {
    if (!(v >= r.low)) r.low = v, r.low_at = p.t0 + tau;
    if (!(v <= r.high)) r.high = v, r.high_at = p.t0 + tau;
  };
  const double T = p.duration, change = T * (std::abs(p.j) + T * std::abs(p.snap));
  if (!p.constant_acceleration() && !(std::abs(p.a) > change))  // otherwise a keeps its sign
    for (const double tau : turning_points(p))
      if (tau > 0 && tau < p.duration) offer(p.at(tau).v, tau);
  offer(passed.end.v, p.duration);
  return r;
}

class LawChecker {
 public:
  LawChecker(const VerifierInput& in, ProgressScope& progress)
      : in_(in), path_(in.path.tool()), joints_(joints(path_, &progress)) {}

  std::vector<Check> run(ProgressScope& progress) {
    const auto& pieces = in_.law.pieces();
    const std::vector<double>& feeds = in_.feeds;
    distinct_ = feeds;
    std::sort(distinct_.begin(), distinct_.end());
    distinct_.erase(std::unique(distinct_.begin(), distinct_.end()), distinct_.end());
    while (!distinct_.empty() && !(distinct_.back() < unlimited)) distinct_.pop_back();
    feed_peaks_.resize(distinct_.size());

    std::size_t feed_of = path_.size(), feed_at = 0;
    std::optional<Passed> before;
    for (const LawPiece& p : pieces) {
      progress.work(1);
      const Passed here(p);
      const SpeedRange v = speed_range(here);
      path_peaks_[0].raise(v.high, v.high_at);
      if (in_.order == 3 || in_.along.acceleration < unlimited) path_peaks(p);
      const PieceRounding& r = here.rounding;
      backward_.raise(std::isnan(v.low) ? v.low : std::max(0.0, -v.low), r.speed, v.low_at);
      if (before) pass(*before, here);
      before = here;
      if (p.segment >= path_.size() || !(p.duration >= 0)) {
        outside_.raise(INFINITY, 0, p.t0);
        continue;
      }
      if (p.segment != feed_of) {
        feed_of = p.segment;
        feed_at = static_cast<std::size_t>(std::lower_bound(distinct_.begin(), distinct_.end(), feeds[feed_of]) -
                                           distinct_.begin());
      }
      if (feeds[feed_of] < unlimited) feed_peaks_[feed_at].raise(v.high, v.high_at);
      const Segment& segment = path_[p.segment];
      const double most = std::max({0.0, segment.s0() - p.s, p.s_end - segment.s1(), p.s - p.s_end});
      outside_.raise(std::isfinite(p.s + p.s_end) ? most : INFINITY, rounding * segment.s1(), p.t0);
      position_gap_.raise(std::abs(here.end.s - p.s_end), r.position, p.t0 + p.duration);
    }
    outside_.raise(skipping_.value, skipping_.limit, skipping_.at);
    position_gap_.raise(apart_.value, apart_.limit, apart_.at);
    if (!pieces.empty()) {
      const LawPiece &first = pieces.front(), &last = pieces.back();
      const PieceRounding r0 = rounding_of(first), r1 = rounding_of(last);
      start_.raise(std::abs(first.v), r0.speed, 0);
      acceleration_gap_.raise(std::abs(first.a), r0.acceleration, 0);
      const double end = in_.law.duration();
      const LawState x = last.at(last.duration);
      acceleration_gap_.raise(std::abs(x.a), r1.acceleration, end);
      end_.raise(std::abs(x.v), r1.speed, end);
      uncovered_.raise(std::abs(first.s), rounding * path_.length(), 0);
      uncovered_.raise(std::abs(path_.length() - last.s_end), rounding * path_.length(), end);
    } else {
      uncovered_.raise(path_.length(), 0, 0);
    }
    return report();
  }

 private:
  // Acceleration, jerk and snap along the path: a is a parabola, j even, the snap constant.
  void path_peaks(const LawPiece& p) {
    path_peaks_[3].raise(std::abs(p.snap), p.t0);
    for (const double tau : {0.0, turning_points(p)[2], p.duration}) {
      if (!(tau >= 0 && tau <= p.duration)) continue;
      const LawState x = p.at(tau);
      path_peaks_[1].raise(std::abs(x.a), p.t0 + tau);
      path_peaks_[2].raise(std::abs(x.j), p.t0 + tau);
    }
  }

  // Checks the transition between two pieces: continuity, and the conditions at the joints of the path between them.
  void pass(const Passed& left_piece, const Passed& right_piece) {
    const LawPiece &before = *left_piece.piece, &after = *right_piece.piece;
    const double t = after.t0, v0 = left_piece.end.v, v1 = after.v;
    const PieceRounding &r0 = left_piece.rounding, &r1 = right_piece.rounding;
    velocity_gap_.raise(std::abs(v1 - v0), r0.speed + r1.speed, t);
    const double a0 = left_piece.end.a, a1 = after.a;
    if (in_.order == 3) acceleration_gap_.raise(std::abs(a1 - a0), r0.acceleration + r1.acceleration, t);
    apart_.raise(std::abs(after.s - before.s_end), r0.position + r1.position, t);
    time_gap_.raise(std::abs(after.t0 - (before.t0 + before.duration)), rounding * std::abs(t), t);
    if (before.segment >= path_.size() || after.segment >= path_.size() || before.segment == after.segment) return;
    if (after.segment != before.segment + 1) {
      skipping_.raise(INFINITY, 0, t);
      return;
    }
    double v = std::max(std::abs(v0), std::abs(v1));
    if (std::isnan(v0)) v = v0;
    const Segment &left = path_[before.segment], &right = path_[after.segment];
    if (left.cusp_end() || right.cusp_begin()) has_cusp_ = true, cusp_.raise(v, r0.speed + r1.speed, t);
    const Vec there = right.at_parameter(right.curve().begin()).value;
    const double apart = in_.position_tolerance + rounding * norm(there);
    joint_gap_.raise(norm(left.at_parameter(left.curve().end()).value - there), apart, t);
    distance_.raise(norm(left.at(before.s_end).value - there), apart, t);
    distance_.raise(norm(right.at(after.s).value - there), apart, t);
    const Joint& joint = joints_[before.segment];
    if (joint.angle > in_.corner_angle || in_.rests[after.segment]) {
      corner_.raise(v, r0.speed + r1.speed, t);
      acceleration_gap_.raise(std::max(std::abs(a0), std::abs(a1)), r0.acceleration + r1.acceleration, t);
      return;  // no velocity step remains at rest
    }
    pass_joint(after.segment, joint, v, {a0, a1}, t);
  }

  // Checks the jumps of the axes' velocities and accelerations where their derivatives along the path jump; `a` are the
  // accelerations along the path before and after.
  void pass_joint(std::size_t after, const Joint& joint, double v, std::array<double, 2> a, double t) {
    const std::size_t before = after - 1;
    const bool look = in_.order == 3 || !in_.path.cartesian();
    AxisJet l, r;
    if (look) {
      l = in_.path.at_parameter(before, path_[before].curve().end());
      r = in_.path.at_parameter(after, path_[after].curve().begin());
    }
    for (std::size_t k = 0; k < in_.path.axes(); ++k) {
      const AxisLimits& axis = in_.machine.axes[k];
      const double turn = in_.path.cartesian() ? joint.step[k] : r.d1[k] - l.d1[k];
      if (const double limit = axis.acceleration * in_.machine.cycle_time; limit < unlimited)
        raise(step_, std::abs(turn) * v, limit, t, k);
      if (const double limit = axis.jerk * in_.machine.cycle_time; in_.order == 3 && limit < unlimited)
        raise(jump_, std::abs((r.d2[k] - l.d2[k]) * v * v + r.d1[k] * a[1] - l.d1[k] * a[0]), limit, t, k);
    }
  }

  struct StrainedAxis {
    Strained worst;
    std::size_t axis = 0;
  };
  static void raise(StrainedAxis& most, double candidate, double limit, double t, std::size_t axis) {
    const Strained before = most.worst;
    most.worst.raise(candidate, limit, t);
    if (most.worst.value != before.value || most.worst.limit != before.limit) most.axis = axis;
  }
  std::string unit(const StrainedAxis& most) const {
    return in_.machine.axes.empty() ? "mm" : in_.machine.axes[most.axis].unit;
  }

  std::vector<Check> report() const {
    constexpr CheckGroup geometry = CheckGroup::geometry, continuous = CheckGroup::continuity;
    std::vector<Check> list;
    std::vector<Check> feeds;
    for (std::size_t i = 0; i < distinct_.size(); ++i)
      feeds.push_back(make_check({quantity::feed, 1}, distinct_[i], feed_peaks_[i]));
    if (feeds.size() > max_feeds) {
      std::stable_sort(feeds.begin(), feeds.end(), [](const Check& a, const Check& b) {
        if (a.passed != b.passed) return b.passed;
        return a.passed && a.value * b.limit > b.value * a.limit;
      });
      feeds.resize(max_feeds);
    }
    for (Check& c : feeds) list.push_back(std::move(c));
    for (int order = 1; order <= (in_.order == 3 ? Limits::highest_order : 2); ++order)
      if (const double limit = in_.along.of(order); limit < unlimited)
        list.push_back(make_check({quantity::path, order}, limit, path_peaks_[static_cast<std::size_t>(order - 1)]));
    if (!joints_.empty()) {
      list.push_back(make_limit_check({quantity::joint_step, 1, unit(step_)}, step_.worst));
      if (jump_.worst.limit > 0) list.push_back(make_limit_check({quantity::joint_step, 2, unit(jump_)}, jump_.worst));
      list.push_back(make_check({{"corner rest", continuous}, 1}, corner_));
    }
    if (has_cusp_) list.push_back(make_check({{"cusp rest", continuous}, 1}, cusp_));
    list.push_back(make_check({quantity::start_rest, 1}, start_));
    list.push_back(make_check({quantity::end_rest, 1}, end_));
    list.push_back(make_check({quantity::continuity, 1}, velocity_gap_));
    if (in_.order == 3) list.push_back(make_check({quantity::continuity, 2}, acceleration_gap_));
    Strained position = position_gap_;
    position.raise(joint_gap_.value, joint_gap_.limit, joint_gap_.at);
    list.push_back(make_check({quantity::continuity, 0}, position));
    list.push_back(make_check({{"continuity of time", continuous}, 0, "s"}, time_gap_));
    list.push_back(make_check({{"pieces within segments", geometry}, 0}, outside_));
    list.push_back(make_check({{"forward motion", continuous}, 1}, backward_));
    list.push_back(make_check({{"path covered", geometry}, 0}, uncovered_));
    list.push_back(make_check({{"distance from contour", geometry}, 0}, distance_));
    return list;
  }

  const VerifierInput& in_;
  const Path& path_;
  std::vector<Joint> joints_;
  std::vector<double> distinct_;
  std::vector<Worst> feed_peaks_;
  bool has_cusp_ = false;
  std::array<Worst, Limits::highest_order> path_peaks_;  // along the path, from velocity on
  StrainedAxis step_, jump_;
  Strained backward_, outside_, position_gap_, joint_gap_, velocity_gap_, acceleration_gap_, time_gap_, corner_, cusp_,
      start_, end_, uncovered_, distance_;
  Strained skipping_, apart_;  // gaps from piece to piece: counted with outside_ and position_gap_
};

}  // namespace

std::vector<Check> law_checks(const VerifierInput& input, ProgressScope& progress) {
  return LawChecker(input, progress).run(progress);
}

}  // namespace bahnwerk::verify
