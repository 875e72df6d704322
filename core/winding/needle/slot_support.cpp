#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/winding/needle/support_points.hpp"

namespace bahnwerk::winding {
namespace {

double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

}  // namespace

// The needle's axis runs through the point C where the tangents of the bend meet. C = P + (l + t) u, t = ρ tan(α/2), so
// that only the number t has to be found; for a given C the direction is closed: that of C seen from the axis or from
// the pivot, limited so that the axis makes at most the angle λ with the azimuth of the tip C − t d:
// |C| sin γ = |M| sin λ and |C| cos γ = |M| cos λ + t give γ = λ − asin(t/|C| sin λ) for the angle γ at C.
SupportPoint slot_support(Space place, Space along, double bend_radius, double free_length, Space pivot,
                          std::optional<double> pivot_limit) {
  SupportPoint found;
  double tangent = bend_radius;
  for (int i = 0; i < 200; ++i) {
    const Space c = place + (free_length + tangent) * along;
    const double at = azimuth(c), from_axis = std::hypot(c.x, c.y);
    if (!(from_axis > tangent)) throw Infeasible("the needle's tip would lie beyond the part's axis");
    double gamma = 0;
    if (pivot_limit) {
      const Space through = c - pivot;
      if (dot(through, radial(azimuth(pivot))) > 0) {
        const double most = *pivot_limit - std::asin(tangent / from_axis * std::sin(*pivot_limit));
        gamma = std::clamp(wrapped(azimuth(through) - at), -most, most);
      }
    }
    found.pose.phi = at + gamma;
    const TipOffset tip = tip_offset(along, radial(found.pose.phi), bend_radius, free_length);
    found.pose.tip = place + tip.offset;
    found.exit_angle = tip.exit_angle;
    const double next = bend_radius * std::tan(tip.exit_angle / 2);
    if (std::abs(next - tangent) <= 1e-14 * (1 + tangent)) {
      found.pivot_shift = wrapped(found.pose.phi - azimuth(found.pose.tip));
      // What is left of a needle that points straight outwards is round-off.
      if (!pivot_limit || gamma == 0) found.pivot_shift = 0;
      return found;
    }
    // Half a step: where the pivot is near, a whole one may swing from side to side.
    tangent = i < 20 ? next : (tangent + next) / 2;
  }
  throw Infeasible("no direction of the needle brings the wire to its place");
}

}  // namespace bahnwerk::winding
