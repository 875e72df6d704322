#include "core/motion/interpolation/stepper.hpp"

#include <algorithm>
#include <cmath>

#include "core/machine/limits.hpp"
#include "core/motion/interpolation/quartic_step.hpp"

namespace bahnwerk {
namespace {

// Relative to a segment's mean parametric speed: a shorter tangent has no usable direction.
constexpr double least_speed = 1e-6;
// The quartic's series omits the third order: a step that takes more of its curve's parameter than this is divided into
// parts, at most this many.
constexpr double whole_step = 1.0 / 64;
constexpr double most_parts = 32;

}  // namespace

PathPlace Stepper::exact(std::size_t segment, double s) const {
  segment = path_.find(s, segment);
  return {segment, path_[segment].parameter(s), s};
}

double Stepper::aimed(const PathPlace& from, const LawState& law, double next) const {
  const double behind = law.s - from.s;
  switch (interpolator_) {
    case Interpolator::taylor1:
      return behind + law.v * cycle_time_;
    case Interpolator::taylor2:
      return behind + cycle_time_ * (law.v + law.a * cycle_time_ / 2);
    default:
      return next - from.s;
  }
}

double Stepper::step(const QuotientJet& at, double length, double run, double most) const {
  if (interpolator_ == Interpolator::quartic) return quartic_step(at, length, most).value_or(unlimited);
  const Vec d1 = at.d1();
  const double square = dot(d1, d1), first = length / std::sqrt(square);
  if (interpolator_ == Interpolator::taylor1) return first;
  return first - run * run * dot(d1, at.d2()) / (2 * square * square);
}

PathPlace Stepper::next(const PathPlace& from, const LawState& law, double next) const {
  if (interpolator_ == Interpolator::exact) return exact(from.segment, next);
  double length = aimed(from, law, next);
  // (3.112) squares the speed alone, neither what the acceleration adds to the length nor what is corrected.
  double run = law.v * cycle_time_;
  const double least_part = length / most_parts;
  PathPlace at = from;
  while (length > 0) {
    const Segment& segment = path_[at.segment];
    const Curve& curve = segment.curve();
    if (const double most = curve.end() - at.u; most > 0) {
      const QuotientJet jet = series_.at(at.segment, at.u);
      const double mean = segment.length() / (curve.end() - curve.begin());
      const auto exactly = [&] {
        return exact(at.segment, std::min(segment.arc_length(at.u) + length, path_.length()));
      };
      if (!(norm(jet.z1) > least_speed * mean * jet.n0)) return exactly();
      double part = length;
      if (interpolator_ == Interpolator::quartic)
        part = std::min(length, std::max(least_part, whole_step * (curve.end() - curve.begin()) * norm(jet.d1())));
      const double step = this->step(jet, part, run, most);
      if (step <= 0) return at;
      if (step <= most) {
        at.u += step;
        if (part < length) {
          length -= part;
          continue;
        }
        at.s = segment.arc_length(at.u);
        return at;
      }
      const double chord = norm(curve.at(curve.end()).value - curve.at(at.u).value);
      if (step == unlimited && chord > part) return exactly();
      run = length -= chord;
    }
    if (at.segment + 1 == path_.size()) return end();
    ++at.segment;
    at.u = path_[at.segment].curve().begin();
    at.s = path_[at.segment].s0();
  }
  return at;
}

}  // namespace bahnwerk
