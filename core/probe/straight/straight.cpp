#include "core/probe/straight/straight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numeric/bisection.hpp"

namespace bahnwerk::probe {
namespace {

ProbePhaseKind kind_of(const ProfilePiece& piece) {
  const double half = piece.duration / 2, a = piece.a + half * (piece.j + half * piece.snap / 2);
  return a > 0 ? ProbePhaseKind::accelerate : a < 0 ? ProbePhaseKind::brake : ProbePhaseKind::hold;
}

Profile profile_between(const ProbeProblem& problem, std::size_t from, std::size_t to, Vec& direction) {
  const Vec chord = problem.points[to] - problem.points[from];
  const double length = norm(chord);
  direction = chord / length;
  return straight_profile(length, 0, 0, limits_along(problem, direction));
}

class RowFinder {
 public:
  explicit RowFinder(const ProbeProblem& problem) : points_(problem.points) {
    // Distance of points from a line that counts as rounding of coordinates, or half of what the document allows.
    reach_ = std::max(coordinate_rounding(problem) / 4, 0.5 * std::min(problem.point_tolerance, problem.tolerance));
  }

  /// Returns whether the straight from a to b passes what is in between.
  bool passes(std::size_t a, std::size_t b) const {
    const Vec chord = points_[b] - points_[a];
    const double length = norm(chord);
    if (!(length > 0)) return false;
    double before = 0;
    for (std::size_t i = a + 1; i < b; ++i) {
      const Vec from = points_[i] - points_[a];
      const double along = dot(from, chord) / length;
      if (!(along > before) || !(along < length) || norm(cross(from, chord)) > reach_ * length) return false;
      before = along;
    }
    return true;
  }

 private:
  const std::vector<Vec>& points_;
  double reach_;
};

}  // namespace

double time_at(const Profile& profile, double distance) {
  const auto pieces = profile.pieces();
  std::size_t i = 0;
  while (i + 1 < pieces.size() && pieces[i + 1].s <= distance) ++i;
  if (pieces[i].a == 0 && pieces[i].j == 0 && pieces[i].snap == 0)
    return pieces[i].t0 + std::clamp((distance - pieces[i].s) / pieces[i].v, 0.0, pieces[i].duration);
  const Bisection when =
      bisect(0, pieces[i].duration, 0, 60, [&](double tau) { return pieces[i].at(tau).s < distance; });
  return pieces[i].t0 + (when.low + when.high) / 2;
}

ProfileLimits limits_along(const ProbeProblem& problem, Vec direction) {
  ProfileLimits limits;
  limits.velocity = problem.speed;
  for (std::size_t k = 0; k < problem.dimension(); ++k) {
    const double share = std::abs(direction[k]);
    if (!(share > 0)) continue;
    limits.acceleration = std::min(limits.acceleration, problem.axis(k).acceleration / share);
    limits.jerk = std::min(limits.jerk, problem.axis(k).jerk / share);
    limits.snap = std::min(limits.snap, problem.axis(k).snap / share);
  }
  return limits;
}

void append_straight(MotionWriter& writer, const Profile& profile, Vec direction, std::size_t point) {
  ProbePhaseKind kind = ProbePhaseKind::interval;
  double begin = writer.time();
  for (const ProfilePiece& piece : profile.pieces()) {
    if (kind_of(piece) != kind) {
      if (writer.time() > begin) writer.phase(kind, begin, writer.time(), point);
      kind = kind_of(piece), begin = writer.time();
    }
    writer.add(piece.duration, piece.v * direction, piece.a * direction, piece.j * direction, piece.snap * direction);
  }
  if (writer.time() > begin) writer.phase(kind, begin, writer.time(), point);
}

double append_rest_to_rest(MotionWriter& writer, const ProbeProblem& problem, std::size_t from, std::size_t to) {
  Vec direction;
  const Profile profile = profile_between(problem, from, to, direction);
  const double begin = writer.time();
  writer.aim(problem.points[from]);
  append_straight(writer, profile, direction, from);
  for (std::size_t i = from + 1; i < to; ++i)
    writer.pass(begin + time_at(profile, dot(problem.points[i] - problem.points[from], direction)));
  return profile.duration;
}

double rest_to_rest_duration(const ProbeProblem& problem, std::size_t from, std::size_t to) {
  Vec direction;
  return profile_between(problem, from, to, direction).duration;
}

std::vector<std::size_t> straight_rows(const ProbeProblem& problem) {
  const RowFinder finder(problem);
  const std::size_t last = problem.points.size() - 1;
  std::vector<std::size_t> end(problem.points.size(), last);
  for (std::size_t a = 0; a < last;) {
    // Doubles the row's length while it passes, then halves what is uncertain.
    std::size_t good = 1, step = 1;
    while (a + good < last && finder.passes(a, std::min(last, a + good + step))) {
      good = std::min(last - a, good + step);
      step *= 2;
    }
    for (; step > 0; step /= 2)
      if (a + good + step <= last && finder.passes(a, a + good + step)) good += step;
    for (std::size_t i = a; i < a + good; ++i) end[i] = a + good;
    a += good;
  }
  return end;
}

}  // namespace bahnwerk::probe
