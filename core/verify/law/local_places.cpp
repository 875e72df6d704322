#include "core/verify/law/local_places.hpp"

#include <algorithm>

#include "core/geometry/curve/rational.hpp"
#include "core/verify/rounding.hpp"

namespace bahnwerk::verify {
namespace {

constexpr double nearest = 64 * epsilon;  // least distance from a cusp, as a part of the segment's length

enum class Vanishing { nowhere, at_begin, at_end };

Vanishing vanishing(const Segment& segment) {
  if (segment.straight() || segment.curve().kind() != CurveKind::rational) return Vanishing::nowhere;
  const auto& curve = static_cast<const Rational&>(segment.curve());
  if (segment.cusp_begin() || curve.vanishing_begin() > 0) return Vanishing::at_begin;
  if (segment.cusp_end() || curve.vanishing_end() > 0) return Vanishing::at_end;
  return Vanishing::nowhere;
}

double way(const LawPiece& piece) {
  LawPiece alone = piece;
  alone.s = 0;
  return alone.at(alone.duration).s;
}

}  // namespace

double LocalPlaces::length(const Segment& segment) { return segment.travelled(segment.curve().end()); }

bool LocalPlaces::summed(std::size_t i) {
  if (i >= first_ && i < last_) return !places_.empty();
  const auto& pieces = in_.law.pieces();
  const std::size_t here = pieces[i].segment;
  for (first_ = i; first_ > 0 && pieces[first_ - 1].segment == here;) --first_;
  for (last_ = i + 1; last_ < pieces.size() && pieces[last_].segment == here;) ++last_;
  places_.clear();
  const Segment& on = in_.path[here];
  const Vanishing where = vanishing(on);
  if (where == Vanishing::nowhere) return false;
  const std::size_t n = last_ - first_;
  const double length = LocalPlaces::length(on);
  places_.resize(n + 1);
  nearest_begin_ = on.cusp_begin() ? nearest * length : 0;
  nearest_end_ = on.cusp_end() ? length - nearest * length : length;
  if (where == Vanishing::at_begin) {
    double sum = places_[0] = std::max(0.0, pieces[first_].s - on.s0());
    for (std::size_t k = 0; k < n; ++k) places_[k + 1] = sum += way(pieces[first_ + k]);
    if (!(pieces[last_ - 1].s_end < on.s1())) places_[n] = length;
  } else {
    double left = std::max(0.0, on.s1() - pieces[last_ - 1].s_end);
    places_[n] = length - left;
    for (std::size_t k = n; k-- > 0;) places_[k] = length - (left += way(pieces[first_ + k]));
  }
  for (double& s : places_) s = std::clamp(s, 0.0, length);
  return true;
}

}  // namespace bahnwerk::verify
