#include "core/probe/optimal/optimal.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/progress.hpp"
#include "core/base/progress_scope.hpp"
#include "core/numeric/bisection.hpp"
#include "core/probe/figures.hpp"
#include "core/probe/optimal/chain_motion.hpp"
#include "core/probe/optimal/passing.hpp"
#include "core/probe/optimal/point_choice.hpp"
#include "core/probe/optimal/windows.hpp"
#include "core/probe/reachable_speed.hpp"
#include "core/probe/straight/stops.hpp"
#include "core/probe/within_limits.hpp"

namespace bahnwerk {
namespace {

using Report = std::function<void(double)>;

// Room for rounding: what is planned keeps limits that are smaller by this fraction.
constexpr double rounding_room = 2e-9;

template <int D>
ChainLimits<D> limits_of(const ProbeProblem& problem, const ChosenPoints& chosen) {
  ChainLimits<D> limits;
  limits.tolerance = problem.tolerance * (1 - rounding_room);
  for (double tube : chosen.tube) limits.tube.push_back(tube * (1 - rounding_room));
  limits.speed = problem.speed * (1 - rounding_room);
  for (std::size_t k = 0; k < D; ++k) {
    const AxisLimits& axis = problem.axis(k);
    limits.derivative[0][k] = axis.acceleration * (1 - rounding_room);
    limits.derivative[1][k] = axis.jerk * (1 - rounding_room);
    limits.derivative[2][k] = axis.snap * (1 - rounding_room);
  }
  // Coordinates are relative to the first point: cells are short beside the digits of coordinates that are far from 0.
  for (const Vec& p : chosen.at) {
    std::array<double, D> at;
    for (std::size_t k = 0; k < D; ++k) at[k] = p[k] - problem.points.front()[k];
    limits.points.push_back(at);
  }
  limits.along = chosen.along;
  for (const std::array<Vec, 3>& derivatives : chosen.curve) {
    auto& curve = limits.curve.emplace_back();
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t k = 0; k < D; ++k) curve[r][k] = derivatives[r][k];
  }
  for (std::size_t i = 0; i < chosen.at.size(); ++i) {
    // A ball that is tiny beside its edges and the tube gives nothing but work.
    double around = problem.tolerance;
    if (i > 0) around = std::min(around, norm(chosen.at[i] - chosen.at[i - 1]));
    if (i + 1 < chosen.at.size()) around = std::min(around, norm(chosen.at[i + 1] - chosen.at[i]));
    const double radius = chosen.ball[i];
    limits.ball.push_back(radius > 1e-4 * around ? std::min(radius, 0.9 * limits.tolerance) : 0);
  }
  return limits;
}

/// Returns the motion of pieces, four of each cell, without the times of points.
ProbeMotion motion_of(std::vector<SplineMotion::Piece> pieces, const Vec& end) {
  ProbeMotion out;
  out.end = end;
  // Every piece begins at the very place at which rounding leaves the one before it.
  double begin = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double duration = pieces[i].end - begin;
    out.durations.push_back(duration);
    out.joints.push_back(i % CellBasis::pieces + 1 < CellBasis::pieces ? PieceJoint::carried : PieceJoint::landing);
    begin = pieces[i].end;
    if (i + 1 == pieces.size()) break;
    for (std::size_t k = 0; k < pieces[i].axes.size(); ++k)
      pieces[i + 1].axes[k][0] = evaluate(pieces[i].axes[k], duration);
  }
  out.motion = std::make_shared<SplineMotion>(std::move(pieces));
  return out;
}

/// Sets the times of all points of a motion that passes the points `chosen` at `times`. Returns the edges between
/// chosen points where another one is missed.
std::vector<std::size_t> set_times(const ProbeProblem& problem, const std::vector<std::size_t>& chosen,
                                   std::vector<double> times, ProbeMotion& motion) {
  times.back() = motion.duration();
  Passing passing = pass_points(problem, *motion.motion, chosen, times);
  motion.times = std::move(passing.times);
  for (std::size_t e = 0; e < problem.edges(); ++e)
    motion.phases.push_back({ProbePhaseKind::interval, motion.times[e], motion.times[e + 1], e});
  return std::move(passing.open);
}

template <int D>
ProbeMotion in_tube(const ProbeProblem& problem, const Report& report) {
  constexpr int rounds = 8;  // with one point more between two; then all between two are chosen
  PointChoice choice(problem, [&] { report(0); });
  for (int round = 0;; ++round) {
    const ChosenPoints chosen = choice.chosen();
    const double done = 1 - std::exp2(-round);
    const CellChain<D> chain = plan_chain(limits_of<D>(problem, chosen), chosen.index.size() - 1,
                                          [&](double f) { report(done + (1 - done) / 2 * f); });
    std::vector<SplineMotion::Piece> pieces;
    std::vector<double> times{0};
    append_pieces(
        chain,
        [&](const std::array<Polynomial, D>& x) {
          std::vector<Polynomial> axes(x.begin(), x.end());
          for (std::size_t k = 0; k < D; ++k) axes[k][0] += problem.points.front()[k];
          return axes;
        },
        pieces, times);
    ProbeMotion motion = motion_of(std::move(pieces), problem.points.back());
    const std::vector<std::size_t> open = set_times(problem, chosen.index, std::move(times), motion);
    if (open.empty() || !choice.split(open, motion.times, round >= rounds)) return motion;
  }
}

/// Returns whether the head turns back at point i of a line.
bool turns_back(const std::vector<Vec>& points, std::size_t i) {
  return dot(points[i] - points[i - 1], points[i + 1] - points[i]) < 0;
}

/// Returns the last point up to which the polyline from `from` stays on one line, there and back included.
std::size_t line_end(const std::vector<Vec>& points, std::size_t from) {
  constexpr double off = 1e-10;         // mm
  std::size_t to = from + 1, far = to;  // the line goes through the point that is furthest away
  while (to + 1 < points.size()) {
    const std::size_t next = norm(points[to + 1] - points[from]) > norm(points[far] - points[from]) ? to + 1 : far;
    const Vec way = points[next] - points[from];
    const Vec u = way / norm(way);
    bool straight = true;
    for (std::size_t i = from + 1; i <= to + 1 && straight; ++i) {
      const Vec d = points[i] - points[from];
      straight = norm(d - dot(d, u) * u) <= off;
    }
    if (!straight) break;
    far = next;
    ++to;
  }
  return to;
}

/// Plans from rest to rest along lines, each from one of the points `ends` to the next one; on a line the head turns
/// back at the points `turns` without a rest. Returns the edges between these where a point is missed.
std::vector<std::size_t> along_lines(const ProbeProblem& problem, const std::vector<std::size_t>& ends,
                                     const std::vector<std::size_t>& turns, const Report& report, ProbeMotion& motion) {
  const std::vector<Vec>& points = problem.points;
  const std::size_t dimension = problem.dimension();
  std::vector<SplineMotion::Piece> pieces;
  std::vector<double> times{0};
  std::size_t turn = 0;
  for (std::size_t line = 0; line + 1 < ends.size(); ++line) {
    const std::size_t from = ends[line], to = ends[line + 1], first = turn;
    Vec way{};
    for (; turns[turn] < to; ++turn)
      if (norm(points[turns[turn + 1]] - points[from]) > norm(way)) way = points[turns[turn + 1]] - points[from];
    const Vec u = way / norm(way);
    ChainLimits<1> limits;
    limits.speed = problem.speed * (1 - rounding_room);
    for (auto& l : limits.derivative) l[0] = unlimited;
    for (std::size_t k = 0; k < dimension; ++k) {
      if (u[k] == 0) continue;
      const double share = std::abs(u[k]) / (1 - rounding_room);
      limits.derivative[0][0] = std::min(limits.derivative[0][0], problem.axis(k).acceleration / share);
      limits.derivative[1][0] = std::min(limits.derivative[1][0], problem.axis(k).jerk / share);
      limits.derivative[2][0] = std::min(limits.derivative[2][0], problem.axis(k).snap / share);
    }
    for (std::size_t i = first; i <= turn; ++i) {
      limits.points.push_back({dot(points[turns[i]] - points[from], u)});
      limits.ball.push_back(0);
    }
    const double edges = static_cast<double>(turns.size() - 1), share = static_cast<double>(turn - first) / edges,
                 before = static_cast<double>(first) / edges;
    const CellChain<1> chain = plan_chain(limits, turns.size() - 1, [&](double f) { report(before + share * f); });
    append_pieces(
        chain,
        [&](const std::array<Polynomial, 1>& s) {
          std::vector<Polynomial> axes;
          for (std::size_t k = 0; k < dimension; ++k) {
            Polynomial p = s[0];
            for (double& c : p) c *= u[k];
            p[0] += points[from][k];
            axes.push_back(std::move(p));
          }
          return axes;
        },
        pieces, times);
  }
  motion = motion_of(std::move(pieces), points.back());
  return set_times(problem, turns, std::move(times), motion);
}

/// Plans without a tube: rest at every corner, and along the line between, where the head may turn back without a rest.
ProbeMotion on_polyline(const ProbeProblem& problem, const Report& report) {
  const std::size_t last = problem.edges();
  std::vector<std::size_t> ends{0}, turns{0};
  while (ends.back() < last) {
    const std::size_t to = line_end(problem.points, ends.back());
    for (std::size_t i = ends.back() + 1; i < to; ++i)
      if (turns_back(problem.points, i)) turns.push_back(i);
    ends.push_back(to);
    turns.push_back(to);
  }
  ProbeMotion motion;
  along_lines(problem, ends, turns, report, motion);
  return motion;
}

/// Plans the straight from the first point to the last one; returns whether it passes all others. It is planned if that
/// is not ruled out.
bool on_straight(const ProbeProblem& problem, const Report& report, ProbeMotion& motion) {
  const Vec from = problem.points.front(), to = problem.points.back();
  if (!(norm(to - from) > problem.point_tolerance)) return false;
  for (const Vec& p : problem.given)
    if (distance_from_edge(p, from, to) > problem.point_tolerance + coordinate_rounding(problem)) return false;
  return along_lines(problem, {0, problem.edges()}, {0, problem.edges()}, report, motion).empty();
}

// Rounds to 36 bits, 7e-12 of x at most: numbers that differ by a few roundings become one, but for one pair in some
// ten thousand.
double rounded_to_36_bits(double x) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  return std::ldexp(std::round(std::ldexp(fraction, 36)), exponent - 36);
}

// Plans in units of the time that an edge takes at full speed on average, with limits that rounding of this unit leaves
// as they are: problems that differ by the scale of time are one and the same problem, and their durations differ by
// that scale exactly. The limits' margin for rounding is wider than what they are rounded by.
ProbeMotion shortest(const ProbeProblem& problem, const Report& report, ProgressScope& scope) {
  constexpr double no_tube = 1e-9;  // mm
  const double length = probe::polyline_length(problem);
  const double speed = std::min(problem.speed, probe::unreachable_speed(problem));
  const double unit = length / speed / static_cast<double>(problem.edges());  // s
  ProbeProblem timeless = problem;
  timeless.speed = length / static_cast<double>(problem.edges());
  for (AxisLimits& axis : timeless.machine.axes) {
    axis.acceleration = rounded_to_36_bits(axis.acceleration * unit * unit);
    axis.jerk = rounded_to_36_bits(axis.jerk * unit * unit * unit);
    axis.snap = rounded_to_36_bits(axis.snap * unit * unit * unit * unit);
  }
  ProbeMotion motion;
  if (timeless.tolerance <= no_tube)
    motion = on_polyline(timeless, report);
  else if (!on_straight(timeless, report, motion))
    motion = timeless.dimension() == 2 ? in_tube<2>(timeless, report) : in_tube<3>(timeless, report);
  motion = slowed(motion, unit);
  return probe::within_limits(problem, std::move(motion), scope);
}

/// The shortest motion for a lower speed goes at that speed wherever it can, so lower speeds leave less ripple, about,
/// until turns become too short for the cells. Speeds are halved as far as the time admits, so that more time adds
/// speeds to try; then the lowest speed that leaves time enough is found by bisection. The motion that ripples least of
/// all is returned.
ProbeMotion least_ripple(const ProbeProblem& problem, const ProbeMotion& quickest, const Report& report,
                         ProgressScope& scope) {
  constexpr int halvings = 6, steps = 7;
  const double most = problem.stretch * quickest.duration();
  ProbeMotion best = quickest;
  double least = probe_figures(problem, best, scope).speed_ripple;
  const auto offer = [&](const ProbeMotion& motion) {
    if (motion.duration() > most) return;
    const double ripple = probe_figures(problem, motion, scope).speed_ripple;
    if (!(ripple < least)) return;
    least = ripple;
    best = motion;
  };
  ProbeProblem slower = problem;
  int step = 0;
  const auto too_slow = [&](double speed) {
    if (!(least > 0)) return false;
    slower.speed = speed;
    const ProbeMotion motion = shortest(
        slower, [&](double f) { report((step + f) / (halvings + steps)); }, scope);
    ++step;
    offer(motion);
    return motion.duration() > most;
  };
  double speed = problem.speed / 2;
  while (least > 0 && step < halvings && !too_slow(speed)) speed /= 2;
  bisect(speed, 2 * speed, 0, steps, too_slow);
  return best;
}

}  // namespace

ProbeMotion plan_optimal(const ProbeProblem& problem, Progress progress) {
  const bool ripple = problem.objective == ProbeObjective::ripple;
  const double share = ripple ? 0.2 : 1;
  ProgressScope scope(progress.part(share, share), "optimal");
  ProbeMotion best = shortest(
      problem, [&](double f) { progress.report("optimal", share * f, {}); }, scope);
  ProbeMotion stops = plan_stops(problem, scope);
  if (!(best.duration() < stops.duration())) best = std::move(stops);
  if (!ripple) return best;
  return least_ripple(
      problem, best, [&](double f) { progress.report("optimal", share + (1 - share) * f, {}); }, scope);
}

}  // namespace bahnwerk
