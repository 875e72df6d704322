#include "core/probe/figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/probe/bezier.hpp"

namespace bahnwerk {
namespace {

using namespace probe;

/// A part of a piece between two times within it, or of its velocity: differences of positions are lost in rounding
/// where the part is short.
Bezier part(const SplineMotion& motion, std::size_t piece, double from, double to, bool velocity) {
  std::array<Vec, Bezier::max_points + 1> c{};
  std::size_t n = 1;
  const double begin = motion.begin(piece);
  for (std::size_t k = 0; k < motion.axes(); ++k) {
    Polynomial p;
    motion.polynomial(piece, k, p);
    if (velocity) p = bahnwerk::derivative(p);
    if (from > begin) p = shifted(std::move(p), from - begin, 1);
    n = std::max(n, p.size());
    for (std::size_t i = 0; i < p.size(); ++i) c[i][k] = p[i];
  }
  return bezier(c.data(), n, to - from);
}

/// ∫ |v| over the piece of `duration` by five Gauss points, halved where that does not do to 1e-10.
double length(const Bezier& v, double duration, int depth = 12) {
  constexpr std::array x{0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842, 0.953089922969332};
  constexpr std::array w{0.118463442528095, 0.239314335249683, 0.284444444444444, 0.239314335249683, 0.118463442528095};
  const auto at = [&](const Bezier& b, double u) {
    std::array<Vec, Bezier::max_points> p = b.b;
    for (std::size_t step = 1; step < b.n; ++step)
      for (std::size_t i = 0; i + step < b.n; ++i) p[i] = (1 - u) * p[i] + u * p[i + 1];
    return norm(p[0]);
  };
  const auto whole = [&](const Bezier& b) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += w[i] * at(b, x[i]);
    return sum;
  };
  Bezier left, right;
  halve(v, left, right);
  const double one = whole(v), two = (whole(left) + whole(right)) / 2;
  if (std::abs(one - two) <= 1e-10 * two || depth == 0) return two * duration;
  return length(left, duration / 2, depth - 1) + length(right, duration / 2, depth - 1);
}

/// The least |v|: no less than the distance of the control points' box from 0, no more than what is found.
void least(const Bezier& v, double resolution, double& found, int depth = 40) {
  Vec low = v.b[0], high = v.b[0];
  for (std::size_t i = 1; i < v.n; ++i)
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], v.b[i][k]), high[k] = std::max(high[k], v.b[i][k]);
  Vec nearest;
  for (std::size_t k = 0; k < 3; ++k) nearest[k] = std::clamp(0.0, low[k], high[k]);
  found = std::min({found, norm(v.b[0]), norm(v.b[v.n - 1])});
  if (norm(nearest) >= found - resolution || depth == 0) return;
  Bezier left, right;
  halve(v, left, right);
  least(left, resolution, found, depth - 1);
  least(right, resolution, found, depth - 1);
}

}  // namespace

ProbeFigures probe_figures(const ProbeProblem& problem, const ProbeMotion& plan, ProgressScope& progress) {
  const SplineMotion& motion = *plan.motion;
  ProbeFigures out;
  const double T = motion.duration(), first = plan.times[1], last = plan.times[plan.times.size() - 2];
  double inner = 0, fastest = 0, slowest = unlimited;
  std::size_t edge = 0;
  for (std::size_t i = 0; i < motion.pieces(); ++i) {
    for (double from = motion.begin(i); from < motion.end(i);) {
      while (edge + 1 < problem.edges() && plan.times[edge + 1] <= from) ++edge;
      const double to = edge + 1 < problem.edges() ? std::min(motion.end(i), plan.times[edge + 1]) : motion.end(i);
      const Bezier x = part(motion, i, from, to, false), v = part(motion, i, from, to, true);
      const double way = length(v, to - from);
      out.path_length += way;
      const Vec a = problem.points[edge], b = problem.points[edge + 1];
      out.max_deviation = peak_of(
          x, [&](Vec p) { return distance_from_edge(p, a, b); }, out.max_deviation, 1e-6);
      if (from >= first && to <= last) {
        inner += way;
        fastest = peak_of(
            v, [](Vec w) { return norm(w); }, fastest, 1e-9);
        least(v, 1e-9 * fastest, slowest);
      }
      from = to;
      progress.work(8);
    }
  }
  out.mean_speed = out.path_length / T;
  if (last > first && inner > 0) out.speed_ripple = (fastest - slowest) / (inner / (last - first));
  return out;
}

}  // namespace bahnwerk
