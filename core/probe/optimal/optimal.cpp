#include "core/probe/optimal/optimal.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/progress.hpp"
#include "core/base/progress_scope.hpp"
#include "core/numeric/bisection.hpp"
#include "core/probe/figures.hpp"
#include "core/probe/optimal/chain_motion.hpp"
#include "core/probe/optimal/windows.hpp"
#include "core/probe/reachable_speed.hpp"
#include "core/probe/within_limits.hpp"

namespace bahnwerk {
namespace {

using Report = std::function<void(double)>;

// Room for rounding: what is planned keeps limits that are smaller by this fraction.
constexpr double rounding_room = 2e-9;

template <int D>
ChainLimits<D> limits_of(const ProbeProblem& problem) {
  ChainLimits<D> limits;
  limits.tolerance = problem.tolerance * (1 - rounding_room);
  limits.speed = problem.speed * (1 - rounding_room);
  for (std::size_t k = 0; k < D; ++k) {
    const AxisLimits& axis = problem.axis(k);
    limits.derivative[0][k] = axis.acceleration * (1 - rounding_room);
    limits.derivative[1][k] = axis.jerk * (1 - rounding_room);
    limits.derivative[2][k] = axis.snap * (1 - rounding_room);
  }
  // Coordinates are relative to the first point: cells are short beside the digits of coordinates that are far from 0.
  for (const Vec& p : problem.points) {
    std::array<double, D> at;
    for (std::size_t k = 0; k < D; ++k) at[k] = p[k] - problem.points.front()[k];
    limits.points.push_back(at);
  }
  // Points that stand for several given ones have less of the tolerance left.
  std::vector<double> taken(problem.points.size(), 0.0);
  for (std::size_t i = 0; i < problem.given.size(); ++i) {
    const std::size_t p = problem.point_of[i];
    taken[p] = std::max(taken[p], norm(problem.given[i] - problem.points[p]));
  }
  for (std::size_t i = 0; i < taken.size(); ++i) {
    // A ball that is tiny beside its edges and the tube gives nothing but work.
    double around = problem.tolerance;
    if (i > 0) around = std::min(around, norm(problem.points[i] - problem.points[i - 1]));
    if (i + 1 < taken.size()) around = std::min(around, norm(problem.points[i + 1] - problem.points[i]));
    const double radius = 0.999 * (problem.point_tolerance - taken[i]);
    limits.ball.push_back(radius > 1e-4 * around ? std::min(radius, 0.9 * limits.tolerance) : 0);
  }
  return limits;
}

ProbeMotion motion_of(std::vector<SplineMotion::Piece> pieces, std::vector<double> times, const Vec& end) {
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
  times.back() = out.motion->duration();
  for (std::size_t e = 0; e + 1 < times.size(); ++e)
    out.phases.push_back({ProbePhaseKind::interval, times[e], times[e + 1], e});
  out.times = std::move(times);
  return out;
}

template <int D>
ProbeMotion in_tube(const ProbeProblem& problem, const Report& report) {
  const CellChain<D> chain = plan_chain(limits_of<D>(problem), problem.edges(), report);
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
  return motion_of(std::move(pieces), std::move(times), problem.points.back());
}

// The last point up to which the polyline from `from` stays on one line, there and back included.
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

// Plans without a tube: rest at every corner, and along the line between, where the head may turn back without a rest.
ProbeMotion on_polyline(const ProbeProblem& problem, const Report& report) {
  const std::vector<Vec>& points = problem.points;
  const std::size_t dimension = problem.dimension();
  std::vector<SplineMotion::Piece> pieces;
  std::vector<double> times{0};
  for (std::size_t from = 0; from + 1 < points.size();) {
    const std::size_t to = line_end(points, from);
    Vec way{};
    for (std::size_t i = from + 1; i <= to; ++i)
      if (norm(points[i] - points[from]) > norm(way)) way = points[i] - points[from];
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
    for (std::size_t i = from; i <= to; ++i) {
      limits.points.push_back({dot(points[i] - points[from], u)});
      limits.ball.push_back(0);
    }
    const double share = static_cast<double>(to - from) / static_cast<double>(points.size() - 1);
    const double before = static_cast<double>(from) / static_cast<double>(points.size() - 1);
    const CellChain<1> chain = plan_chain(limits, problem.edges(), [&](double f) { report(before + share * f); });
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
    from = to;
  }
  return motion_of(std::move(pieces), std::move(times), problem.points.back());
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
// that scale exactly. The limits' room for rounding is wider than what they are rounded by.
ProbeMotion shortest(const ProbeProblem& problem, const Report& report, ProgressScope& scope) {
  constexpr double no_tube = 1e-9;  // mm
  double length = 0;
  for (std::size_t i = 0; i < problem.edges(); ++i) length += norm(problem.points[i + 1] - problem.points[i]);
  const double speed = std::min(problem.speed, probe::unreachable_speed(problem));
  const double unit = length / speed / static_cast<double>(problem.edges());  // s
  ProbeProblem timeless = problem;
  timeless.speed = length / static_cast<double>(problem.edges());
  for (AxisLimits& axis : timeless.machine.axes) {
    axis.acceleration = rounded_to_36_bits(axis.acceleration * unit * unit);
    axis.jerk = rounded_to_36_bits(axis.jerk * unit * unit * unit);
    axis.snap = rounded_to_36_bits(axis.snap * unit * unit * unit * unit);
  }
  ProbeMotion motion = timeless.tolerance <= no_tube ? on_polyline(timeless, report)
                       : timeless.dimension() == 2   ? in_tube<2>(timeless, report)
                                                     : in_tube<3>(timeless, report);
  motion = slowed(motion, unit);
  return probe::within_limits(problem, std::move(motion), scope);
}

// The shortest motion for a lower speed goes at that speed wherever it can, so the lowest speed that leaves time enough
// has the least ripple, about. It is found by bisection; the motion that ripples least of all is returned.
ProbeMotion least_ripple(const ProbeProblem& problem, const std::vector<ProbeMotion>& starts,
                         const ProbeMotion& quickest, const Report& report, ProgressScope& scope) {
  constexpr int steps = 8;
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
  for (const ProbeMotion& start : starts) offer(start);
  ProbeProblem slower = problem;
  int step = 0;
  const auto too_slow = [&](double speed) {
    if (!(least > 0)) return false;
    slower.speed = speed;
    const ProbeMotion motion = shortest(
        slower, [&](double f) { report((step + f) / steps); }, scope);
    ++step;
    offer(motion);
    return motion.duration() > most;
  };
  const double lowest = 0.02 * problem.speed, guess = problem.speed / problem.stretch;
  if (too_slow(guess))
    bisect(guess, problem.speed, 0, steps - 1, too_slow);
  else
    bisect(lowest, guess, 0, steps - 1, too_slow);
  return best;
}

}  // namespace

ProbeMotion plan_optimal(const ProbeProblem& problem, const std::vector<ProbeMotion>& starts, Progress& progress) {
  const bool ripple = problem.objective == ProbeObjective::ripple;
  const double share = ripple ? 0.2 : 1;
  ProgressScope scope(progress, "optimal", share, share);
  ProbeMotion best = shortest(
      problem, [&](double f) { progress.report("optimal", share * f, {}); }, scope);
  for (const ProbeMotion& start : starts)
    if (!(best.duration() < start.duration())) best = start;
  if (!ripple) return best;
  return least_ripple(
      problem, starts, best, [&](double f) { progress.report("optimal", share + (1 - share) * f, {}); }, scope);
}

}  // namespace bahnwerk
