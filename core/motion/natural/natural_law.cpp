#include "core/motion/natural/natural_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "core/base/errors.hpp"
#include "core/base/progress_scope.hpp"

namespace bahnwerk {
namespace {

constexpr double reference_speed = 1e5;  // mm/s: faster than any machine, so that what follows only slows
constexpr int durations_tried = 400;

/// Where the motion is, and how fast: mm along the path.
struct State {
  double s = 0, v = 0, a = 0;
};

/// s(t) = Σ c t^i from one state to another.
class Quintic {
 public:
  Quintic(const State& from, const State& to, double duration) : duration_(duration) {
    const double t = duration, t2 = t * t, way = to.s - from.s - from.v * t - from.a * t2 / 2,
                 speed = (to.v - from.v - from.a * t) * t, bend = (to.a - from.a) * t2;
    c_ = {from.s,
          from.v,
          from.a / 2,
          (10 * way - 4 * speed + bend / 2) / (t * t2),
          (-15 * way + 7 * speed - bend) / (t2 * t2),
          (6 * way - 3 * speed + bend / 2) / (t2 * t2 * t)};
  }
  State at(double t) const {
    State x;
    for (std::size_t i = 6; i-- > 0;) x.a = x.a * t + 2 * x.v, x.v = x.v * t + x.s, x.s = x.s * t + c_[i];
    return x;
  }
  double duration() const { return duration_; }
  /// The largest |a| of 64 places; infinite where the motion stands still or goes back at one of them.
  double acceleration() const {
    double most = 0;
    for (int i = 0; i <= 64; ++i) {
      const State x = at(duration_ * i / 64);
      if (i > 0 && i < 64 && !(x.v > 0)) return unlimited;
      most = std::max(most, std::abs(x.a));
    }
    return most;
  }

 private:
  double duration_;
  std::array<double, 6> c_;
};

/// The quintic of the least acceleration; throws Infeasible.
Quintic quintic(const State& from, const State& to) {
  const double way = to.s - from.s, mean = std::max({(from.v + to.v) / 2, reference_speed / 100});
  Quintic best(from, to, way / mean);
  double least = unlimited;
  for (int i = 0; i <= durations_tried; ++i) {
    const Quintic tried(from, to, way / mean * std::pow(10.0, 2.0 * i / durations_tried - 1));
    const double most = tried.acceleration();
    if (most < least) least = most, best = tried;
  }
  if (least < unlimited) return best;
  char text[240];
  std::snprintf(text, sizeof text,
                "natural feed: the %.6g mm from %.6g mm along the path on are too short to pass from one link to the "
                "next; another feed method does not need that",
                way, from.s);
  throw Infeasible(text);
}

class NaturalPlanner {
 public:
  NaturalPlanner(const PathTask& task, const NaturalOptions& options)
      : task_(task), tool_(task.path.tool()), options_(options) {
    if (options.shares.size() != tool_.size()) throw std::invalid_argument("natural feed: one share per segment");
  }

  TimeLaw run(ProgressScope& scope) {
    State state;
    for (std::size_t i = 0; i < tool_.size();) {
      const std::size_t end = options_.shares[i] > 0 ? link_end(i) : between_end(i);
      if (options_.shares[i] > 0) {
        state = pass_link(i, end);
      } else {
        const bool rests = end == tool_.size() || task_.rests[end];
        State to{tool_[end - 1].s1(), 0, 0};
        if (!rests) to = at_link_begin(end), to.s = tool_[end - 1].s1();
        pass_between(i, end, quintic(state, to));
        state = to;
      }
      i = end;
      scope.work(options_.steps);
      scope.done(static_cast<double>(i) / static_cast<double>(tool_.size()));
    }
    law_.slow(excess());
    return std::move(law_);
  }

 private:
  std::size_t link_end(std::size_t i) const {
    double sum = 0;
    while (i < tool_.size() && options_.shares[i] > 0 && sum < 1 - 1e-9) sum += options_.shares[i++];
    if (!(std::abs(sum - 1) < 1e-9)) throw std::invalid_argument("natural feed: the shares of a link are not 1");
    return i;
  }
  std::size_t between_end(std::size_t i) const {
    do ++i;
    while (i < tool_.size() && options_.shares[i] == 0 && !task_.rests[i]);
    return i;
  }
  /// Seconds per unit of the link's parameter.
  double link_duration(std::size_t begin, std::size_t end) const {
    return (tool_[end - 1].s1() - tool_[begin].s0()) / reference_speed;
  }
  State state(std::size_t segment, double u, double duration) const {
    const Curve& curve = tool_[segment].curve();
    const Jet jet = curve.at(u);
    const double rate = (curve.end() - curve.begin()) / (options_.shares[segment] * duration), speed = norm(jet.d1);
    return {tool_[segment].arc_length(u), speed * rate, dot(jet.d1, jet.d2) / speed * rate * rate};
  }
  State at_link_begin(std::size_t i) const { return state(i, tool_[i].curve().begin(), link_duration(i, link_end(i))); }

  State pass_link(std::size_t begin, std::size_t end) {
    const double duration = link_duration(begin, end);
    State here = at_link_begin(begin);
    here.s = tool_[begin].s0();
    for (std::size_t i = begin; i < end; ++i) {
      const double u0 = tool_[i].curve().begin(), u1 = tool_[i].curve().end(), share = options_.shares[i];
      for (std::size_t n = 1; n <= options_.steps; ++n) {
        const double part = static_cast<double>(n) / static_cast<double>(options_.steps);
        State next = state(i, u0 + part * (u1 - u0), duration);
        if (n == options_.steps) next.s = tool_[i].s1();
        append(i, here, next, share * duration / static_cast<double>(options_.steps));
        here = next;
      }
    }
    return here;
  }

  void pass_between(std::size_t begin, std::size_t end, const Quintic& motion) {
    double t = 0;
    State here = motion.at(0);
    for (std::size_t i = begin; i < end; ++i) {
      double until = motion.duration();
      if (i + 1 < end) {
        double low = t;
        while (until - low > 1e-15 * motion.duration()) {
          const double middle = low + (until - low) / 2;
          if (!(middle > low && middle < until)) break;
          (motion.at(middle).s < tool_[i].s1() ? low : until) = middle;
        }
      }
      const double start = t;
      for (std::size_t n = 1; n <= options_.steps; ++n) {
        const double at = start + (until - start) * static_cast<double>(n) / static_cast<double>(options_.steps);
        State next = motion.at(at);
        if (n == options_.steps) next.s = tool_[i].s1();
        if (n == options_.steps && i + 1 == end && stops(end)) next.v = next.a = 0;
        append(i, here, next, at - t);
        here = next, t = at;
      }
    }
  }
  bool stops(std::size_t end) const { return end == tool_.size() || task_.rests[end]; }

  /// A quartic from state to state: speed and acceleration fix its jerk and snap for any duration, the way its
  /// duration, which is close to `duration`.
  void append(std::size_t segment, const State& from, const State& to, double duration) {
    const auto piece_of = [&](double t) {
      const double dv = (to.v - from.v - from.a * t) / (t * t), da = (to.a - from.a) / t;
      LawPiece piece;
      piece.s = from.s, piece.v = from.v, piece.a = from.a;
      piece.j = 6 * dv - 2 * da, piece.q = (6 * da - 12 * dv) / t;
      return piece;
    };
    double t = duration;
    LawPiece piece = piece_of(t);
    for (int i = 0; i < 50; ++i) {
      // ds/dT of the quartic that always meets both speeds: about their mean.
      const double off = piece.at(t).s - to.s, slope = (from.v + to.v) / 2 + t * (from.a - to.a) / 6;
      const double next = t - off / slope;
      if (!(next > 0.5 * duration && next < 2 * duration)) break;
      const bool there = std::abs(next - t) <= 4e-16 * t;
      t = next;
      piece = piece_of(t);
      if (there) break;
    }
    LawPiece& made = law_.next();
    const double t0 = made.t0;
    made = piece;
    made.t0 = t0, made.duration = t, made.s_end = to.s, made.segment = segment;
  }

  /// By what factor everything has to last longer.
  double excess() const {
    double most = 0;
    const auto exceed = [&](const Limits& limits, double v, double a, double j) {
      most = std::max({most, std::abs(v) / limits.velocity, std::sqrt(std::abs(a) / limits.acceleration),
                       std::cbrt(std::abs(j) / limits.jerk)});
    };
    for (const LawPiece& piece : law_.pieces())
      for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const LawState x = piece.at(part * piece.duration);
        exceed(options_.path, x.v, x.a, x.j);
        const AxisJet q = task_.path.at(piece.segment, std::clamp(x.s, piece.s, piece.s_end));
        for (std::size_t k = 0; k < task_.path.axes(); ++k)
          exceed(task_.machine.axes[k], q.d1[k] * x.v, q.d2[k] * x.v * x.v + q.d1[k] * x.a,
                 q.d3[k] * x.v * x.v * x.v + 3 * q.d2[k] * x.v * x.a + q.d1[k] * x.j);
      }
    return std::max(most, 1e-6);
  }

  const PathTask& task_;
  const Path& tool_;
  const NaturalOptions& options_;
  TimeLaw law_;
};

}  // namespace

TimeLaw plan_natural(const PathTask& task, const NaturalOptions& options, Progress& progress, double from, double to) {
  ProgressScope scope(progress, "natural feed", from, to);
  scope.report();
  TimeLaw law = NaturalPlanner(task, options).run(scope);
  scope.done(1);
  scope.report();
  return law;
}

}  // namespace bahnwerk
