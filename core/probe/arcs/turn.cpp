#include "core/probe/arcs/turn.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bahnwerk::probe {
namespace {

/// Differences of unit vectors that rounding explains.
Vec change_between(Vec in, Vec out) {
  const Vec change = out - in;
  return norm(change) > 4 * std::numeric_limits<double>::epsilon() ? change : Vec{};
}

SpeedChangeLaw law_of(const ProbeProblem& problem, Vec change) {
  double a = unlimited, j = unlimited, s = unlimited;
  for (std::size_t k = 0; k < problem.dimension(); ++k) {
    const double share = std::abs(change[k]);
    if (!(share > 0)) continue;
    a = std::min(a, problem.axis(k).acceleration / share);
    j = std::min(j, problem.axis(k).jerk / share);
    s = std::min(s, problem.axis(k).snap / share);
  }
  return {a, j, s};
}

}  // namespace

Turn::Turn(const ProbeProblem& problem, Vec in, Vec out)
    : in_(in), out_(out), change_(change_between(in, out)), law_(law_of(problem, change_)) {}

std::size_t Turn::rise(double speed, std::array<Phase, 4>& phases) const {
  if (!(speed > 0) || change_ == Vec{}) return 0;
  const SpeedChange c = law_.shape(speed);
  const double snap = c.jerk / c.ramp, bend = c.ramp * c.jerk / 2;
  std::size_t n = 0;
  double gain = 0, way = 0;
  const auto add = [&](double t, double a, double j, double s) {
    if (!(t > 0)) return;
    phases[n++] = {t, gain, a, j, s, way};
    way += t * (gain + t * (a / 2 + t * (j / 6 + t * s / 24)));
    gain += t * (a + t * (j / 2 + t * s / 6));
  };
  add(c.ramp, 0, 0, snap);
  add(c.jerk_hold, bend, c.jerk, 0);
  add(c.ramp, c.acceleration - bend, c.jerk, -snap);
  add(c.hold / 2, c.acceleration, 0, 0);
  return n;
}

TurnSize Turn::size(double speed) const {
  std::array<Phase, 4> phases;
  const std::size_t n = rise(speed, phases);
  TurnSize size;
  if (n == 0) return size;
  for (std::size_t i = 0; i < n; ++i) size.duration += 2 * phases[i].duration;
  const Phase& p = phases[n - 1];
  const double t = p.duration;
  size.moment = p.way + t * (p.gain + t * (p.a / 2 + t * (p.j / 6 + t * p.snap / 24)));
  size.length = speed * size.duration / 2;
  return size;
}

double Turn::deviation(double speed, const Edges& edges, double enough) const {
  std::array<Phase, 4> phases;
  const std::size_t n = rise(speed, phases);
  if (n == 0) return enough;
  const TurnSize whole = size(speed);
  const Vec apex = this->apex(edges.point, whole);
  double most = enough;
  for (const bool first : {true, false}) {
    // The second half is the first one backwards in time, from the exit with −d_out to the point: −d_in + d_out is the
    // same change.
    const Vec direction = first ? in_ : -out_, change = change_;
    const Vec begin = apex - whole.length * direction;
    double t = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Phase& p = phases[i];
      const std::array piece{begin + (speed * t) * direction + p.way * change, speed * direction + p.gain * change,
                             (p.a / 2) * change, (p.j / 6) * change, (p.snap / 24) * change};
      const auto distance = [&](Vec x) {
        return first ? distance_from_edge(x, edges.before, edges.point) / edges.tube
                     : distance_from_edge(x, edges.point, edges.after) / edges.tube;
      };
      most = peak_of(bezier(piece.data(), piece.size(), p.duration), distance, most, 1e-6);
      t += p.duration;
    }
  }
  return most;
}

void Turn::append(MotionWriter& writer, double speed, Vec point, std::size_t number) const {
  std::array<Phase, 4> phases;
  const std::size_t n = rise(speed, phases);
  const double begin = writer.time();
  if (n > 0) {
    const TurnSize whole = size(speed);
    writer.aim(apex(point, whole) - whole.length * in_);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Phase& p = phases[i];
    writer.add(p.duration, speed * in_ + p.gain * change_, p.a * change_, p.j * change_, p.snap * change_);
  }
  writer.pass(writer.time());
  for (std::size_t i = n; i-- > 0;) {
    const Phase& p = phases[i];
    const double t = p.duration, left = p.gain + t * (p.a + t * (p.j / 2 + t * p.snap / 6));
    // Run backwards: the change that is left, its first derivative as it is, its second one reversed.
    writer.add(t, speed * out_ - left * change_, (p.a + t * (p.j + t * p.snap / 2)) * change_,
               -(p.j + t * p.snap) * change_, p.snap * change_);
  }
  if (writer.time() > begin) writer.phase(ProbePhaseKind::turn, begin, writer.time(), number);
}

}  // namespace bahnwerk::probe
