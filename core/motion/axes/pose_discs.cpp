#include "core/motion/axes/pose_discs.hpp"

#include <array>
#include <utility>

#include "core/geometry/curve/arc.hpp"
#include "core/geometry/curve/rational.hpp"
#include "core/numeric/polynomial_discs.hpp"

namespace bahnwerk {
namespace {

bool still(const DiscJet& f) { return f.c[1].zero() && f.c[2].zero() && f.c[3].zero(); }

/// Converts d/du to d/ds where ds/du is constant.
void slowed(DiscJet& f, double inverse_speed) {
  double power = 1;
  for (std::size_t n = 1; n <= 3; ++n) f.c[n] = (power *= inverse_speed) * f.c[n];
}

/// Converts d/du to d/ds by 1/|h_u| as a series in u.
void slowed(DiscJet& f, const DiscJet& inverse_speed) {
  if (still(f)) return;
  const DiscJet first = derived(f) * inverse_speed, second = derived(first) * inverse_speed;
  f.c[1] = first.c[0];
  f.c[2] = 0.5 * second.c[0];
  f.c[3] = (1.0 / 6) * (second.c[1] * inverse_speed.c[0]);
}

}  // namespace

PoseDiscs::PoseDiscs(const Path& tool, std::shared_ptr<const Orientation> orientation)
    : orientation_(std::move(orientation)), quotients_(tool.size()) {
  for (std::size_t i = 0; i < tool.size(); ++i) {
    if (tool[i].curve().kind() != CurveKind::rational) continue;
    const auto& r = static_cast<const Rational&>(tool[i].curve());
    quotients_[i] = std::make_unique<const Quotient>(Quotient{{r.coordinate(0), r.coordinate(1), r.coordinate(2)},
                                                              r.rational() ? r.weight() : Polynomial{},
                                                              r.origin(),
                                                              r.pivot(),
                                                              r.reach()});
  }
}

bool PoseDiscs::enclose(const Segment& segment, std::size_t index, double u, double radius, ToolDiscs& tool) const {
  const Curve& curve = segment.curve();
  tool = {};
  if (orientation_) orientation_->enclose(index, u, radius, tool[3], tool[4]);
  if (curve.kind() == CurveKind::rational) {
    const Quotient& q = *quotients_[index];
    const double t = (u - q.pivot) / q.reach, r = std::abs(radius / q.reach);
    const auto across = bahnwerk::enclose(q.position[0], q.position[1], t, r),
               up = bahnwerk::enclose(q.position[2], q.weight, t, r);
    const DiscJet& one = up[1];
    tool[0] = across[0], tool[1] = across[1], tool[2] = up[0];
    DiscJet square;  // |h_u|²
    for (std::size_t k = 0; k < 3; ++k) {
      if (!q.weight.empty() && !q.position[k].empty()) tool[k] = tool[k] / one;
      slowed(tool[k], 1 / q.reach);
      tool[k].c[0] += q.origin[k];
      const DiscJet along = derived(tool[k]);
      square = square + along * along;
    }
    const DiscJet inverse_speed = DiscJet(1) / sqrt(square);
    if (!inverse_speed.c[2].known()) return false;
    for (DiscJet& f : tool) slowed(f, inverse_speed);
    return true;
  }
  const double inverse_speed = 1 / curve.speed(u);
  if (curve.kind() == CurveKind::arc) {
    const auto& arc = static_cast<const Arc&>(curve);
    DiscJet turn;
    turn.c[0] = Disc(arc.sweep() * u, std::abs(arc.sweep()) * radius), turn.c[1] = arc.sweep();
    const DiscJet c = cos(turn), s = sin(turn);
    const Vec climb = arc.rise() * arc.normal();
    for (std::size_t k = 0; k < 3; ++k) {
      tool[k] = DiscJet(arc.radius() * arc.e1()[k]) * c + DiscJet(arc.radius() * arc.e2()[k]) * s;
      tool[k].c[0] += arc.centre()[k] + Disc(u * climb[k], radius * std::abs(climb[k]));
      tool[k].c[1] += climb[k];
    }
  } else {
    const Jet h = curve.at(u);
    for (std::size_t k = 0; k < 3; ++k)
      tool[k].c[0] = Disc(h.value[k], radius * std::abs(h.d1[k])), tool[k].c[1] = h.d1[k];
  }
  for (DiscJet& f : tool) slowed(f, inverse_speed);
  return true;
}

}  // namespace bahnwerk
