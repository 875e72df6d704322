#include "core/probe/optimal/passing.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/numeric/bisection.hpp"
#include "core/probe/bezier.hpp"

namespace bahnwerk {
namespace {

using namespace probe;

class PointFinder {
 public:
  PointFinder(const ProbeProblem& problem, const SplineMotion& motion)
      : problem_(problem),
        motion_(motion),
        rounding_(coordinate_rounding(problem)),
        first_(problem.points.size() + 1, problem.given.size()) {
    for (std::size_t i = problem.given.size(); i-- > 0;) first_[problem.point_of[i]] = i;
  }

  /// Returns the time in [from, to] at which the motion is nearest to the middle of what the point stands for: before
  /// it the motion comes nearer.
  double nearest(std::size_t point, double from, double to) {
    Vec low = problem_.given[first_[point]], high = low;
    for (std::size_t i = first_[point]; i < first_[point + 1]; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        low[k] = std::min(low[k], problem_.given[i][k]), high[k] = std::max(high[k], problem_.given[i][k]);
    const Vec at = (low + high) / 2;
    const Bisection when = bisect(from, to, 0, steps, [&](double t) {
      const State now = state(t);
      return dot(now.x - at, now.v) < 0;
    });
    return (when.low + when.high) / 2;
  }
  /// Returns the first time in [from, t] from which on the point is passed, where it is passed at t.
  double entered(std::size_t point, double from, double t) {
    return passed(point, from) ? from : bisect(from, t, 0, steps, [&](double at) { return !passed(point, at); }).high;
  }
  /// Returns the last time in [t, to] up to which the point is passed, where it is passed at t.
  double left(std::size_t point, double t, double to) {
    return passed(point, to) ? to : bisect(t, to, 0, steps, [&](double at) { return passed(point, at); }).low;
  }

  bool passed(std::size_t point, double t) {
    const Vec x = state(t).x;
    for (std::size_t i = first_[point]; i < first_[point + 1]; ++i)
      if (!(norm(problem_.given[i] - x) <= reach() + rounding_)) return false;
    return true;
  }

  /// Returns whether the motion stays in the tube of the edge from its time `from` to its time `to`.
  bool in_tube(std::size_t edge, double from, double to) {
    const Vec a = problem_.points[edge], b = problem_.points[edge + 1];
    const double most = problem_.tolerance + rounding_;
    locate(from);
    for (std::size_t i = piece_; i < motion_.pieces() && motion_.begin(i) < to; ++i) {
      const double begin = std::max(from, motion_.begin(i)), end = std::min(to, motion_.end(i));
      if (!(begin < end)) continue;
      std::array<Vec, Bezier::max_points> c{};
      std::size_t n = 1;
      for (std::size_t k = 0; k < motion_.axes(); ++k) {
        Polynomial p;
        motion_.polynomial(i, k, p);
        if (begin > motion_.begin(i)) p = shifted(std::move(p), begin - motion_.begin(i), 1);
        n = std::max(n, p.size());
        for (std::size_t d = 0; d < p.size(); ++d) c[d][k] = p[d];
      }
      const double peak = peak_of(
          bezier(c.data(), n, end - begin), [&](Vec x) { return distance_from_edge(x, a, b); }, most);
      if (peak > most) return false;
    }
    return true;
  }

 private:
  static constexpr int steps = 60;
  struct State {
    Vec x, v;
  };
  State state(double t) {
    locate(t);
    const MotionState s = motion_.in_piece(piece_, t);
    State out;
    for (std::size_t k = 0; k < motion_.axes(); ++k) out.x[k] = s[0][k], out.v[k] = s[1][k];
    return out;
  }
  void locate(double t) {
    while (piece_ > 0 && motion_.begin(piece_) > t) --piece_;
    while (piece_ + 1 < motion_.pieces() && motion_.end(piece_) <= t) ++piece_;
  }
  double reach() const { return 0.9995 * problem_.point_tolerance; }

  const ProbeProblem& problem_;
  const SplineMotion& motion_;
  double rounding_;
  std::vector<std::size_t> first_;  // the first given point of each point
  std::size_t piece_ = 0;
};

}  // namespace

Passing pass_points(const ProbeProblem& problem, const SplineMotion& motion, const std::vector<std::size_t>& chosen,
                    const std::vector<double>& times) {
  const std::vector<Vec>& points = problem.points;
  const std::size_t n = points.size(), edges = chosen.size() - 1;
  PointFinder finder(problem, motion);
  // Each point is passed from `earliest` to `latest`.
  std::vector<double> earliest(n, 0.0), latest(n, motion.duration());
  std::vector<char> open(edges, 0);
  Passing out;
  out.times.assign(n, 0.0);
  for (std::size_t c = 0, i = 0; c < edges; ++c) {
    // Points may be out of order by as much as the tolerances about two of them overlap.
    const auto far = [&](std::size_t a, std::size_t b) {
      return norm(points[chosen[a]] - points[chosen[b]]) > 2 * problem.point_tolerance;
    };
    std::size_t from = c, to = c + 1;
    if (chosen[to] > chosen[from] + 1) {
      while (from > 0 && !far(from, c)) --from;
      while (to < edges && !far(c + 1, to)) ++to;
    }
    for (; i < chosen[c + 1] + (c + 1 == edges); ++i) {
      const bool known = i == chosen[c] || i == chosen[c + 1];
      double& t = out.times[i];
      t = known ? times[i == chosen[c] ? c : c + 1] : finder.nearest(i, times[c], times[c + 1]);
      // Beyond the chosen points about it the motion may turn; a point out of order may be passed there.
      if (!known && !finder.passed(i, t)) t = finder.nearest(i, times[from], times[to]);
      if (i == 0 || i + 1 == n) {
        earliest[i] = latest[i] = t;
      } else if (finder.passed(i, t)) {
        earliest[i] = finder.entered(i, times[from], t);
        latest[i] = finder.left(i, t, times[to]);
      } else {
        open[c] = 1;
      }
    }
  }
  for (std::size_t i = n - 1; i-- > 0;) latest[i] = std::min(latest[i], latest[i + 1]);
  for (std::size_t c = 0, i = 0; c < edges; ++c)
    for (; i < chosen[c + 1] + (c + 1 == edges); ++i) {
      double& t = out.times[i];
      t = std::max({std::min(t, latest[i]), earliest[i], i > 0 ? out.times[i - 1] : 0});
      if (i > 0 && i + 1 < n && !finder.passed(i, t)) open[c] = 1;
    }
  for (std::size_t c = 0; c < edges; ++c) {
    for (std::size_t e = chosen[c]; e < chosen[c + 1] && !open[c]; ++e)
      open[c] = !finder.in_tube(e, out.times[e], out.times[e + 1]);
    if (open[c]) out.open.push_back(c);
  }
  return out;
}

}  // namespace bahnwerk
