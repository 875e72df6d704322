#include "core/verify/probe/probe_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/progress.hpp"
#include "core/verify/probe/edge_bound.hpp"
#include "core/verify/probe/edge_times.hpp"

namespace bahnwerk {
namespace {

// A move between two of the given points that leaves out those in between: all of it lies within `radius` of the
// segment.
struct Move {
  std::size_t from = 0, to = 0;  // points
  double radius = 0;             // mm
  double time = 0;               // the proven least time, s
};

struct Effort {
  double resolution;    // width of a cell relative to the shortest time in which a limit is reached
  std::size_t samples;  // largest number of samples of a move
  int coarse_passes, fine_passes;
};
Effort effort(std::size_t moves) {
  if (moves <= 4) return {0.05, 600, 16, 3};
  if (moves <= 20) return {0.1, 240, 16, 2};
  if (moves <= 70) return {0.15, 120, 12, 2};
  if (moves <= 250) return {0.25, 48, 6, 1};
  return {0.5, 24, 3, 1};
}

double reaction_time(const ProbeProblem& problem) {
  double time = std::numeric_limits<double>::max();
  for (std::size_t k = 0; k < problem.dimension(); ++k) {
    const AxisLimits& a = problem.axis(k);
    time = std::min({time, a.jerk / a.snap, std::sqrt(a.acceleration / a.snap), std::cbrt(problem.speed / a.snap)});
  }
  return time;
}

// The time in which the slowest axis changes its velocity by the speed [core/motion/profile/profile_change.hpp].
double ramp_time(const ProbeProblem& problem) {
  double time = 0;
  for (std::size_t k = 0; k < problem.dimension(); ++k) {
    const AxisLimits& a = problem.axis(k);
    const double d = problem.speed, ramp = a.jerk / a.snap;
    const double rise =
        a.acceleration >= a.jerk * ramp ? a.acceleration / a.jerk + ramp : 2 * std::sqrt(a.acceleration / a.snap);
    double change = 4 * std::cbrt(d / (2 * a.snap));
    if (d >= a.acceleration * rise)
      change = d / a.acceleration + rise;
    else if (d >= 2 * a.jerk * ramp * ramp)
      change = ramp + std::sqrt(ramp * ramp + 4 * d / a.jerk);
    time = std::max(time, change);
  }
  return time;
}

// Place of a sample of the move when it passes its ends: points that count as one lie closer than the tolerance, too.
double point_radius(const ProbeProblem& problem, std::size_t point) {
  if (point == 0 || point + 1 == problem.points.size()) return 1e-9;
  return problem.given.size() == problem.points.size() ? problem.point_tolerance : 2 * problem.point_tolerance;
}

// A motion without a tube lies on the polyline; at a corner its derivatives have two directions, so all up to the jerk
// are zero.
bool rests_at(const ProbeProblem& problem, std::size_t point) {
  if (point == 0 || point + 1 == problem.points.size()) return true;
  if (problem.tolerance > 0) return false;
  constexpr double corner = 1e-6;  // rad
  const Vec in = problem.points[point] - problem.points[point - 1],
            out = problem.points[point + 1] - problem.points[point];
  return norm(cross(in, out)) > corner * norm(in) * norm(out);
}

// Steps from 0 to `length`: from `first` on each 1.3 times the one before, up to `step`, and beyond it after `even`;
// the last one is smaller.
std::vector<double> growing_steps(double length, double first, double step, double even) {
  constexpr double growth = 1.3;
  std::vector<double> at;
  double t = 0, size = std::min(first, step);
  while (t + 1.2 * size < length) {
    t += size;
    at.push_back(t);
    size = t > even ? growth * size : std::min(step, growth * size);
  }
  at.push_back(length);
  return at;
}

template <int D>
class MoveBound {
 public:
  MoveBound(const ProbeProblem& problem, const Effort& effort)
      : problem_(problem), effort_(effort), reaction_(reaction_time(problem)), ramp_(ramp_time(problem)) {}

  // The least time of moves[i], expected to be near `expected`; the others take at least their own times.
  double time(const std::vector<Move>& moves, std::size_t i, double expected, double coarser) const {
    const Move& move = moves[i];
    EdgeBoundProblem<D> p;
    p.speed = problem_.speed;
    for (std::size_t k = 0; k < D; ++k) {
      p.derivative[0][k] = problem_.axis(k).acceleration;
      p.derivative[1][k] = problem_.axis(k).jerk;
      p.derivative[2][k] = problem_.axis(k).snap;
    }
    const double even = std::min(ramp_, expected / 2);
    const double step = std::min(expected / 6, coarser * std::max(effort_.resolution * reaction_,
                                                                  4 * even / static_cast<double>(effort_.samples)));
    const std::vector<Outside> before = outside(moves, i, false, step), after = outside(moves, i, true, step);
    const bool begins = rests_at(problem_, move.from), ends = rests_at(problem_, move.to);
    for (std::size_t m = before.size(); m-- > 0;) add(p, -before[m].at, before[m].set, begins && m + 1 < before.size());
    add(p, 0, point_set(move.from), begins);
    for (double t : growing_steps(expected / 2, begins ? step * at_rest : step, step, even)) add(p, t, set(move));
    const std::vector<double> back = growing_steps(expected / 2, ends ? step * at_rest : step, step, even);
    for (std::size_t m = back.size() - 1; m-- > 0;) add(p, expected - back[m], set(move));
    add(p, expected, point_set(move.to));
    for (const Outside& o : after) add(p, expected + o.at, o.set, ends);
    for (double& g : p.grid) g /= expected;
    double h = certified_time<D>(p, edge_multipliers<D>(p, 60));
    // Where other moves' capsules hold no longer than these take at least, nothing is proven beyond.
    for (const auto* side : {&before, &after})
      for (const Outside& o : *side) h = std::min(h, o.until / o.at * expected * (1 - 1e-12));
    return h;
  }

 private:
  // Differences that reach over the begin of a rest say least where they are long: steps are shorter there.
  static constexpr double at_rest = 1.0 / 16;
  // Samples are placed as if the moves beyond took this much less, so that a time above what is expected is proven,
  // too.
  static constexpr double room = 0.95;

  // A sample beyond an end: how far from it in time, its set, and the time until which that set is certain.
  struct Outside {
    double at;
    SampleSet<D> set;
    double until;
  };

  static void add(EdgeBoundProblem<D>& p, double t, const SampleSet<D>& set, bool with_last = false) {
    p.grid.push_back(t);
    p.set.push_back(set);
    p.set.back().with_last = with_last;
  }
  static std::array<double, D> position(Vec v) {
    std::array<double, D> x;
    for (std::size_t k = 0; k < D; ++k) x[k] = v[k];
    return x;
  }
  SampleSet<D> point_set(std::size_t point) const {
    const auto x = position(problem_.points[point]);
    return {x, x, point_radius(problem_, point)};
  }
  SampleSet<D> set(const Move& move) const {
    return {position(problem_.points[move.from]), position(problem_.points[move.to]), move.radius};
  }
  // Returns the sets in which the motion is beyond an end of move i: at rest there, or in the neighbour's capsule for
  // as long as it takes at least, then in a capsule around it and the next move, and so on.
  std::vector<Outside> outside(const std::vector<Move>& moves, std::size_t i, bool after, double step) const {
    std::vector<Outside> out;
    const std::size_t end = after ? moves[i].to : moves[i].from;
    if (rests_at(problem_, end)) {
      for (int m = 1; m <= 4; ++m) out.push_back({m * step * at_rest, point_set(end), unlimited});
      return out;
    }
    double t = 0, until = 0;
    Move around = moves[i];
    around.from = around.to = end;
    around.radius = 0;
    for (std::size_t m = 1; m <= reach_; ++m) {
      const std::size_t next = after ? i + m : i - m;
      until += moves[next].time;
      const std::size_t far = after ? moves[next].to : moves[next].from;
      // The capsule from the end to the far point holds all moves between.
      double radius = 0;
      for (std::size_t p = std::min(end, far); p <= std::max(end, far); ++p)
        radius = std::max(radius, distance_from_edge(problem_.points[p], problem_.points[end], problem_.points[far]));
      double wide = 0;
      for (std::size_t k = 1; k <= m; ++k) wide = std::max(wide, moves[after ? i + k : i - k].radius);
      const SampleSet<D> set{position(problem_.points[end]), position(problem_.points[far]),
                             m == 1 ? moves[next].radius : radius * (1 + 1e-12) + wide};
      const double last = t;
      for (double s : growing_steps(room * until - t, step, std::max(step, (room * until - t) / 12), unlimited)) {
        t = last + s;
        out.push_back({t, set, until});
      }
      if (rests_at(problem_, far) || until > 2 * ramp_) break;
    }
    return out;
  }

  const ProbeProblem& problem_;
  Effort effort_;
  double reaction_, ramp_;
  static constexpr std::size_t reach_ = 3;  // moves on either side
};

// Moves over `stride` edges each; with the times of `parts`, those over half as many, if any.
std::vector<Move> moves_of(const ProbeProblem& problem, std::size_t stride, const std::vector<Move>& parts) {
  std::vector<Move> moves;
  const std::size_t last = problem.points.size() - 1;
  for (std::size_t from = 0; from < last; from += stride) {
    Move m{from, std::min(last, from + stride), 0, 0};
    for (std::size_t i = from + 1; i < m.to; ++i)
      m.radius = std::max(m.radius, distance_from_edge(problem.points[i], problem.points[from], problem.points[m.to]));
    m.radius = m.radius * (1 + 1e-12) + problem.tolerance + 1e-12;
    const double shorter = point_radius(problem, m.from) + point_radius(problem, m.to);
    m.time = least_time(problem, problem.points[m.to] - problem.points[m.from],
                        {rests_at(problem, m.from), rests_at(problem, m.to)}, shorter);
    double sum = 0;
    for (std::size_t i = 2 * moves.size(); i < std::min(parts.size(), 2 * moves.size() + 2); ++i) sum += parts[i].time;
    m.time = std::max(m.time, sum * (1 - 1e-15));
    moves.push_back(m);
  }
  return moves;
}

// Raises the moves' times. What a move's neighbours prove lengthens the time in which their capsules hold, which proves
// more of the move: coarse samples until that comes to an end, then finer ones.
template <int D>
void improve(const ProbeProblem& problem, std::vector<Move>& moves, const Effort& effort, Progress progress,
             double done, double share) {
  const MoveBound<D> bound(problem, effort);
  const std::size_t n = moves.size();
  // Moves that leave points out prove more only where the polyline is nearly as straight as they are.
  std::vector<char> wanted(n, 1);
  for (std::size_t i = 0; i < n; ++i) {
    const double chord = norm(problem.points[moves[i].to] - problem.points[moves[i].from]);
    double length = 0;
    for (std::size_t p = moves[i].from; p < moves[i].to; ++p) length += norm(problem.points[p + 1] - problem.points[p]);
    wanted[i] = moves[i].time > 0 && chord > 0.95 * length;
  }
  std::vector<char> active = wanted;
  const int passes = effort.coarse_passes + effort.fine_passes;
  for (int pass = 0; pass < passes; ++pass) {
    const int finer = pass - effort.coarse_passes;  // ≥ 0: the fine ones
    if (finer >= 0) active = wanted;
    const double coarser = finer < 0 ? 4 : std::pow(2.0, effort.fine_passes - 1 - finer);
    const double above = finer < 0 ? 1.5 : finer == 0 ? 1.15 : 1.04;
    const std::vector<Move> last = moves;
    std::vector<char> next(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
      progress.report("bound", done + share * (pass + static_cast<double>(i) / static_cast<double>(n)) / passes);
      if (!active[i] || !wanted[i]) continue;
      const double found = bound.time(last, i, above * last[i].time, coarser);
      if (found > 1.05 * last[i].time)
        for (std::size_t m = i > 0 ? i - 1 : 0; m < std::min(n, i + 2); ++m) next[m] = 1;
      moves[i].time = std::max(moves[i].time, found);
    }
    active = next;
  }
}

template <int D>
double sum_of_moves(const ProbeProblem& problem, Progress progress, std::size_t most_improved) {
  // With more edges, only the last levels are improved, whose moves are long beside the ramps.
  const std::size_t few = std::min<std::size_t>(most_improved, 160);
  const double enough = 6 * ramp_time(problem);
  std::vector<Move> moves;
  double sum = 0, done = 0;
  for (std::size_t stride = 1;; stride *= 2) {
    moves = moves_of(problem, stride, moves);
    if (problem.edges() <= most_improved || moves.size() <= few)
      improve<D>(problem, moves, effort(moves.size()), progress, done, (1 - done) / 2);
    done += (1 - done) / 2;
    sum = 0;
    for (const Move& m : moves) sum += m.time;
    if (moves.size() == 1 || sum > enough * static_cast<double>(moves.size())) break;
  }
  return sum * (1 - 1e-12);
}

}  // namespace

Bound probe_bound(const ProbeProblem& problem, Progress progress, std::size_t most_improved) {
  Bound bound;
  bound.value = problem.dimension() == 2 ? sum_of_moves<2>(problem, progress, most_improved)
                                         : sum_of_moves<3>(problem, progress, most_improved);
  bound.basis = "least times between points, proven by multipliers";
  return bound;
}

}  // namespace bahnwerk
