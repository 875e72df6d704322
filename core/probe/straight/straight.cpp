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

Limits limits_along(const ProbeProblem& problem, Vec direction) {
  Limits limits;
  limits.velocity = problem.speed;
  for (std::size_t k = 0; k < problem.dimension(); ++k)
    if (const double share = std::abs(direction[k]); share > 0) limits.lower_to(problem.axis(k), share);
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

}  // namespace bahnwerk::probe
