#include "core/probe/probe_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/probe/landing.hpp"

namespace bahnwerk {
namespace {

std::array<double, 4> planned_begin(const Polynomial& p) {
  const auto c = [&](std::size_t i) { return i < p.size() ? p[i] : 0; };
  return {c(0), c(1), 2 * c(2), 6 * c(3)};
}

/// The landing piece of an axis that lasts longest, and what is to be added to the place at which it ends.
struct PlaceShift {
  std::size_t piece = 0;
  double duration = 0, shift = 0;
};

/// Piece after piece, each from where rounding of the one before it leads. Over many pieces nothing adds up: landing
/// pieces end with the derivatives with which the next one was planned to begin, and before an exact or a settling
/// piece at its place, too; what a settling piece leaves open there shifts the exact pieces behind it. Returns where
/// the last piece ends; `longest` takes the longest landing piece.
double carry(std::vector<SplineMotion::Piece>& pieces, const std::vector<PieceJoint>& joints, std::size_t axis,
             const PlaceShift& change, PlaceShift& longest) {
  std::array<double, 4> reached{};
  double begin = 0;
  // The distance of exact pieces from where they were planned: they begin where the settling piece before them ends. It
  // is taken up by the next landing.
  double offset = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    Polynomial& p = pieces[i].axes[axis];
    const double duration = pieces[i].end - begin;
    begin = pieces[i].end;
    if (joints[i] == PieceJoint::exact) {
      if (i > 0 && joints[i - 1] == PieceJoint::settling) offset = reached[0] - p[0];
      p[0] += offset;
      reached = state_at(p, duration);
      continue;
    }
    if (i > 0 && joints[i - 1] == PieceJoint::exact) p[0] += offset;
    offset = 0;
    if (i > 0 && joints[i - 1] != PieceJoint::carried &&
        std::all_of(p.begin() + 1, p.end(), [](double c) { return c == 0; })) {
      // The axis stands still: what rounding left of the movement before would become smaller from piece to piece,
      // until its last digits are lost.
      if (joints[i - 1] != PieceJoint::exact) p[0] = reached[0];
      reached = {p[0]};
      continue;
    }
    p.resize(8, 0.0);
    if (i > 0 && joints[i - 1] != PieceJoint::exact)
      p[0] = reached[0], p[1] = reached[1], p[2] = reached[2] / 2, p[3] = reached[3] / 6;
    if (joints[i] == PieceJoint::landing || joints[i] == PieceJoint::settling) {
      const bool last = i + 1 == pieces.size();
      const bool shifted = change.shift != 0 && i == change.piece;
      const bool exact = !last && joints[i] == PieceJoint::landing &&
                         (joints[i + 1] == PieceJoint::exact || joints[i + 1] == PieceJoint::settling);
      std::array<double, 4> target{};
      if (!last) target = planned_begin(pieces[i + 1].axes[axis]);
      if (shifted) target[0] = state_at(p, duration)[0] + change.shift;
      if (joints[i] == PieceJoint::landing && !exact && duration > longest.duration) longest = {i, duration, 0};
      for (int round = 0; round < 2; ++round) {  // the second one takes up how the first one was rounded
        const std::array<double, 4> now = state_at(p, duration);
        std::array<double, 4> missing{};
        for (std::size_t d = 0; d < 4; ++d) missing[d] = target[d] - now[d];
        if (exact || shifted) {
          const auto rest = probe::landing<double>(missing[0], missing[1], missing[2], missing[3], duration);
          for (std::size_t k = 0; k < rest.size(); ++k) p[4 + k] += rest[k];
        } else {
          const auto rest = probe::landing<double>(missing[1], missing[2], missing[3], duration);
          for (std::size_t k = 0; k < rest.size(); ++k) p[4 + k] += rest[k];
        }
      }
    }
    while (p.size() > 1 && p.back() == 0) p.pop_back();
    reached = state_at(p, duration);
  }
  return reached[0];
}

/// carry(), so that the axis ends at `end`, if there is one, to a few roundings.
void carry_to(std::vector<SplineMotion::Piece>& pieces, const std::vector<PieceJoint>& joints, std::size_t axis,
              const std::optional<Vec>& end) {
  constexpr double close_enough = 1e-10;  // mm
  PlaceShift longest;
  if (!end) {
    carry(pieces, joints, axis, {}, longest);
    return;
  }
  std::vector<Polynomial> planned;
  planned.reserve(pieces.size());
  for (const SplineMotion::Piece& piece : pieces) planned.push_back(piece.axes[axis]);
  double missing = (*end)[axis] - carry(pieces, joints, axis, {}, longest), shift = 0;
  for (int round = 0; round < 2 && std::abs(missing) > close_enough && longest.duration > 0; ++round) {
    for (std::size_t i = 0; i < pieces.size(); ++i) pieces[i].axes[axis] = planned[i];
    shift += missing;
    PlaceShift change = longest;
    change.shift = shift;
    missing = (*end)[axis] - carry(pieces, joints, axis, change, longest);
  }
}

}  // namespace

void drop_vanishing(Polynomial& p) {
  constexpr double vanishing = 1e-200;
  for (double& c : p)
    if (std::abs(c) < vanishing) c = 0;
}

std::array<double, 4> state_at(const Polynomial& p, double t) {
  double d[4] = {};
  for (std::size_t i = p.size(); i-- > 0;) {
    for (std::size_t n = 3; n > 0; --n) d[n] = d[n] * t + d[n - 1];
    d[0] = d[0] * t + p[i];
  }
  return {d[0], d[1], 2 * d[2], 6 * d[3]};
}

ProbeMotion slowed(const ProbeMotion& motion, double factor) {
  return slowed(motion, factor, factor * motion.duration());
}

ProbeMotion slowed(const ProbeMotion& motion, double factor, double duration, ProgressScope* progress) {
  const SplineMotion& spline = *motion.motion;
  std::vector<SplineMotion::Piece> pieces(spline.pieces());
  ProbeMotion out;
  TimeSum time;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double planned = motion.durations.empty() ? spline.end(i) - spline.begin(i) : motion.durations[i];
    out.durations.push_back(factor * planned);
    time.add(factor * planned);
    pieces[i].end = i + 1 < pieces.size() ? time.value() : duration;
    pieces[i].axes.resize(spline.axes());
    if (progress) progress->work(4);
    for (std::size_t k = 0; k < spline.axes(); ++k) {
      Polynomial& p = pieces[i].axes[k];
      spline.polynomial(i, k, p);
      double power = 1;
      for (double& c : p) c /= power, power *= factor;
      drop_vanishing(p);
    }
  }
  out.joints = motion.joints;
  if (!out.joints.empty())
    for (std::size_t k = 0; k < spline.axes(); ++k) carry_to(pieces, out.joints, k, motion.end);
  out.end = motion.end;
  for (const double t : motion.times) out.times.push_back(std::min(duration, factor * t));
  if (!out.times.empty()) out.times.back() = duration;
  for (ProbePhase phase : motion.phases) {
    phase.begin = std::min(duration, factor * phase.begin);
    phase.end = std::min(duration, factor * phase.end);
    out.phases.push_back(phase);
  }
  out.motion = std::make_shared<const SplineMotion>(std::move(pieces));
  return out;
}

}  // namespace bahnwerk
