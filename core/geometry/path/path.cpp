#include "core/geometry/path/path.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/base/errors.hpp"
#include "core/geometry/curve/curvature.hpp"
#include "core/geometry/curve/end_expansion.hpp"
#include "core/geometry/path/regular.hpp"

namespace bahnwerk {
namespace {

constexpr double shortest = 1e-12;  // mm

std::shared_ptr<const Curve> only_piece(std::shared_ptr<const Curve> curve) {
  if (curve->kind() != CurveKind::rational) return curve;
  const auto& rational = static_cast<const Rational&>(*curve);
  auto pieces = regular_pieces(rational);
  if (pieces.size() != 1) throw std::invalid_argument("a segment needs a curve that is regular inside");
  if (pieces[0].vanishing_begin() == 0 && pieces[0].vanishing_end() == 0) return curve;
  return std::make_shared<const Rational>(std::move(pieces[0]));
}

}  // namespace

Segment::Segment(std::shared_ptr<const Curve> curve, double s0, std::size_t source)
    : Segment(only_piece(std::move(curve)), s0, source, Regular{}) {}

Segment::Segment(std::shared_ptr<const Curve> curve, double s0, std::size_t source, Regular)
    : curve_(std::move(curve)), arc_length_(*curve_), s0_(s0), s1_(s0 + arc_length_.length()), source_(source) {
  const double length = arc_length_.length();
  if (!(length > shortest && length < HUGE_VAL)) {
    throw InvalidInput(std::vector<InputFault>{{{}, "the curve has no length"}});
  }
  const double u0 = curve_->begin(), u1 = curve_->end();
  start_ = curve_->at(u0).value;
  straight_ = curve_->kind() == CurveKind::line;
  if (curve_->kind() == CurveKind::rational) {
    const auto& rational = static_cast<const Rational&>(*curve_);
    straight_ = rational.collinear();
    if (!straight_ && (rational.vanishing_begin() > 0 || rational.vanishing_end() > 0)) {
      expansion_ = std::make_shared<const EndExpansion>(rational);
      (rational.vanishing_begin() > 0 ? cusp_begin_ : cusp_end_) = expansion_->unbounded();
    }
    // A tangent that almost vanishes turns within nothing: no machine passes it with a speed worth having.
    const auto spike = [&](double u) { return !(norm(at_parameter(u).d2) * length <= sharpest_curvature); };
    if (!straight_ && rational.vanishing_begin() == 0) cusp_begin_ = spike(u0);
    if (!straight_ && rational.vanishing_end() == 0) cusp_end_ = spike(u1);
  }
  if (straight_) {
    const Vec way = curve_->at(u1).value - start_;
    tangent_ = way / norm(way);
  }
}

double Segment::parameter(double s) const { return s >= s1_ ? curve_->end() : arc_length_.inverse(s - s0_); }

double Segment::arc_length(double u) const { return u >= curve_->end() ? s1_ : s0_ + arc_length_.at(u); }

PathPoint Segment::at_parameter(double u) const { return at_parameter(u, curve_->at(u)); }

PathPoint Segment::at_parameter(double u, const Jet& by_parameter) const {
  Jet point = by_parameter;
  if (straight_) return {point.value, tangent_, {}, {}};
  if (expansion_ && expansion_->covers(u)) {
    expansion_->derivatives(u, point);
  } else {
    point = by_arc_length(point);
  }
  if ((cusp_begin_ && u <= curve_->begin()) || (cusp_end_ && u >= curve_->end())) point.d2 = point.d3 = {};
  return point;
}

void Segment::at_parameters(PathBatch& batch) const {
  batch.close();
  arc_length_.at(batch);
  const double first = batch.u[0], last = batch.u[batch.count - 1];
  const bool special = straight_ || (expansion_ && (expansion_->covers(first) || expansion_->covers(last))) ||
                       (cusp_begin_ && first <= curve_->begin()) || (cusp_end_ && last >= curve_->end());
  if (!special && curve_->derivatives(batch)) return by_arc_length(batch);
  batch.planar = false;
  for (std::size_t i = 0; i < batch.count; ++i) {
    const PathPoint point = at_parameter(batch.u[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      batch.d1[k].set(i, point.d1[k]);
      batch.d2[k].set(i, point.d2[k]);
      batch.d3[k].set(i, point.d3[k]);
    }
  }
}

PathPoint Segment::at(double s) const {
  if (straight_) return {start_ + std::clamp(s - s0_, 0.0, arc_length_.length()) * tangent_, tangent_, {}, {}};
  return at_parameter(parameter(s));
}

std::vector<double> Segment::panel_parameters() const {
  return straight_ && curve_->kind() != CurveKind::rational ? std::vector{curve_->begin(), curve_->end()}
                                                            : arc_length_.borders();
}

void Path::append(const std::shared_ptr<const Curve>& curve, std::size_t source) {
  std::vector<std::shared_ptr<const Curve>> pieces;
  if (curve->kind() == CurveKind::rational) {
    auto regular = regular_pieces(static_cast<const Rational&>(*curve));
    const bool whole = regular.size() == 1 && regular[0].vanishing_begin() == 0 && regular[0].vanishing_end() == 0;
    if (whole) {
      pieces.push_back(curve);
    } else {
      for (Rational& piece : regular) pieces.push_back(std::make_shared<const Rational>(std::move(piece)));
    }
  } else {
    pieces.push_back(curve);
  }
  const std::size_t before = segments_.size();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    try {
      segments_.push_back(Segment(pieces[i], length(), source, Segment::Regular{}));
    } catch (const InvalidInput&) {
      if (pieces.size() == 1 || (i + 1 == pieces.size() && segments_.size() == before)) throw;
    }
  }
}

std::size_t Path::find(double s, std::size_t hint) const {
  const std::size_t n = segments_.size();
  for (std::size_t i = hint; i < n && i < hint + 2; ++i) {
    if ((s >= segments_[i].s0() || i == 0) && (i + 1 == n || s < segments_[i + 1].s0())) return i;
  }
  const auto after = std::upper_bound(segments_.begin(), segments_.end(), s,
                                      [](double value, const Segment& segment) { return value < segment.s0(); });
  return after == segments_.begin() ? 0 : static_cast<std::size_t>(after - segments_.begin()) - 1;
}

PathPoint Path::at(double s) const { return segments_[find(s)].at(s); }

}  // namespace bahnwerk
