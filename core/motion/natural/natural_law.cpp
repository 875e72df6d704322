#include "core/motion/natural/natural_law.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "core/base/errors.hpp"
#include "core/base/progress_scope.hpp"
#include "core/motion/law/law_between.hpp"
#include "core/motion/law/law_excess.hpp"

namespace bahnwerk {
namespace {

constexpr double reference_speed = 1e5;  // mm/s: faster than any machine, so that what follows only slows
constexpr int durations_tried = 400;

using State = LawState;  // the jerk is not used

/// A change of speed and acceleration from one pair to another: v(t) is the cubic that meets both at both ends.
struct Change {
  double v0 = 0, a0 = 0, v1 = 0, a1 = 0, duration = 0;

  /// The cubic v = v0 + b u + c2 u² + c3 u³ over u = t / duration.
  struct Cubic {
    double b, c2, c3;
  };
  Cubic cubic() const {
    const double dv = v1 - v0, b = a0 * duration, e = a1 * duration;
    return {b, 3 * dv - 2 * b - e, b + e - 2 * dv};
  }
  State at(double t) const {  // s from 0
    const auto [b, c2, c3] = cubic();
    const double u = t / duration;
    return {duration * u * (v0 + u * (b / 2 + u * (c2 / 3 + u * c3 / 4))), v0 + u * (b + u * (c2 + u * c3)),
            (b + u * (2 * c2 + u * 3 * c3)) / duration};
  }
  double way() const { return at(duration).s; }
  /// Returns the factor by which it exceeds limits along the path; infinite where it moves backwards.
  double excess(const Limits& limits) const {
    double most = 0;
    constexpr int samples = 32;
    const auto [b, c2, c3] = cubic();
    // Extrema of v: 3 c3 u² + 2 c2 u + b = 0.
    if (const double root = c2 * c2 - 3 * c3 * b; root > 0)
      for (const double q : {-c2 - std::sqrt(root), -c2 + std::sqrt(root)})
        for (const double u : {q / (3 * c3), b / q})
          if (u > 0 && u < 1 && !(at(u * duration).v > 0)) return unlimited;
    for (int i = 0; i <= samples; ++i) {
      const double u = static_cast<double>(i) / samples;
      const State x = at(u * duration);
      if (i > 0 && i < samples && !(x.v > 0)) return unlimited;
      const double jerk = (2 * c2 + 6 * c3 * u) / (duration * duration);
      most = std::max({most, x.v / limits.velocity, std::sqrt(std::abs(x.a) / limits.acceleration),
                       std::cbrt(std::abs(jerk) / limits.jerk)});
    }
    return most;
  }
};

/// Returns the change from the speed and acceleration of `from` to those of `to` that asks least of the machine and
/// takes no more than `room` mm, which begin `s` mm along the path; throws Infeasible.
Change change(const State& from, const State& to, double room, double s, const Limits& limits) {
  Change best;
  double least = unlimited;
  for (int i = 0; i <= durations_tried; ++i) {
    const Change tried{from.v, from.a, to.v, to.a,
                       room / reference_speed * std::pow(10.0, 4.0 * i / durations_tried - 3)};
    if (const double way = tried.way(); !(way > 0 && way <= room)) continue;
    if (const double excess = tried.excess(limits); excess < least) least = excess, best = tried;
  }
  if (least < unlimited) return best;
  char text[240];
  std::snprintf(text, sizeof text,
                "natural feed: %.6g mm from %.6g mm along the path on are too short to pass from one link to the next; "
                "another feed method does not need that",
                room, s);
  throw Infeasible(text);
}

class NaturalPlanner {
 public:
  NaturalPlanner(const PathTask& task, const NaturalOptions& options)
      : task_(task), tool_(task.path.tool()), options_(options) {
    if (options.shares.size() != tool_.size()) throw std::invalid_argument("natural feed: one share per segment");
  }

  TimeLaw run(ProgressScope& stage_progress) {
    State state;
    for (std::size_t i = 0; i < tool_.size();) {
      const std::size_t end = options_.shares[i] > 0 ? link_end(i) : between_end(i);
      if (options_.shares[i] > 0) {
        state = pass_link(i, end);
      } else {
        State to{tool_[end - 1].s1(), 0, 0};
        if (!stops(end)) to = at_link_begin(end), to.s = tool_[end - 1].s1();
        pass_between(i, end, state, to);
        state = to;
      }
      i = end;
      stage_progress.work(options_.steps);
      stage_progress.done(static_cast<double>(i) / static_cast<double>(tool_.size()));
    }
    // From a reference speed everything is slowed, or accelerated, until a limit is reached.
    law_.slow(std::max(law_excess(task_, law_, options_.path, stage_progress), 1e-6));
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

  /// Changes to the mean speed of all links, holds it, and changes to the speed of the next link.
  void pass_between(std::size_t begin, std::size_t end, const State& from, const State& to) {
    const Limits limits = along(begin, end);
    const double room = (to.s - from.s) / 2;
    const State even{0, reference_speed, 0};
    const Change rise = change(from, even, room, from.s, limits), fall = change(even, to, room, to.s - room, limits);
    const double falls = to.s - fall.way();
    State here = from;
    std::size_t i = begin;
    const auto go = [&](const Change& part, double s0, const State& last) {
      double t = 0;
      const double step = part.duration / static_cast<double>(options_.steps);
      for (std::size_t n = 1; n <= options_.steps;) {
        State next = part.at(static_cast<double>(n) * step);
        double until = static_cast<double>(n) * step;
        next.s += s0;
        if (n == options_.steps) next = last;
        // A piece of the law ends where its segment does.
        const bool cut = i + 1 < end && next.s > tool_[i].s1();
        if (cut) {
          until = time_at(part, tool_[i].s1() - s0, t, until);
          next = part.at(until);
          next.s = tool_[i].s1();
        }
        if (until > t && next.s > here.s) append(i, here, next, until - t), here = next, t = until;
        if (cut) {
          ++i;
        } else {
          ++n;
        }
      }
    };
    const auto cruise = [&](double s) {
      if (!(s > here.s)) return;
      const std::size_t parts = tool_[i].straight() ? 1 : options_.steps;  // places at which limits are evaluated
      const double s0 = here.s;
      for (std::size_t n = 1; n <= parts; ++n) {
        const double share = static_cast<double>(n) / static_cast<double>(parts);
        const State next{n == parts ? s : s0 + share * (s - s0), reference_speed, 0};
        if (!(next.s > here.s)) continue;
        append(i, here, next, (next.s - here.s) / reference_speed);
        here = next;
      }
    };
    go(rise, from.s, {from.s + rise.way(), reference_speed, 0});
    while (i + 1 < end && tool_[i].s1() < falls) cruise(tool_[i].s1()), ++i;
    cruise(falls);
    go(fall, falls, to);
  }
  /// Returns the time, between two times, at which the change has covered this distance.
  static double time_at(const Change& part, double way, double low, double high) {
    for (int n = 0; n < 100 && high - low > 1e-15 * part.duration; ++n) {
      const double middle = low + (high - low) / 2;
      (part.at(middle).s < way ? low : high) = middle;
    }
    return high;
  }
  /// Returns the machine's limits along the path between two links.
  Limits along(std::size_t begin, std::size_t end) const {
    Limits least = options_.path;
    for (std::size_t i = begin; i < end; ++i)
      for (const double u : {tool_[i].curve().begin(), tool_[i].curve().end()}) {
        const AxisJet q = task_.path.at_parameter(i, u);
        for (std::size_t k = 0; k < task_.path.axes(); ++k)
          least.lower_to(task_.machine.axes[k], std::max(std::abs(q.d1[k]), 1e-9));
      }
    return least;
  }
  bool stops(std::size_t end) const { return end == tool_.size() || task_.rests[end]; }

  void append(std::size_t segment, const State& from, const State& to, double duration) {
    append_between(law_, segment, from, to, duration);
  }

  const PathTask& task_;
  const Path& tool_;
  const NaturalOptions& options_;
  TimeLaw law_;
};

}  // namespace

TimeLaw plan_natural(const PathTask& task, const NaturalOptions& options, Progress progress) {
  ProgressScope stage_progress(progress, "natural feed");
  stage_progress.report();
  TimeLaw law = NaturalPlanner(task, options).run(stage_progress);
  stage_progress.done(1);
  stage_progress.report();
  return law;
}

}  // namespace bahnwerk
