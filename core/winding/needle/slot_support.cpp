#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/winding/needle/support_points.hpp"

namespace bahnwerk::winding {
namespace {

double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

}  // namespace

// The needle's axis passes through the point C where the tangents of the bend meet, C = P + (l + t) u with t = ρ
// tan(α/2), so only the number t is unknown. For a given C the direction has a closed form: it is that of C seen from
// the axis or from the pivot, limited so that the axis makes at most the angle λ with the azimuth of the tip C − t d.
// |C| sin γ = |M| sin λ and |C| cos γ = |M| cos λ + t give γ = λ − asin(t/|C| sin λ) for the angle γ at C. The
// direction is continuous in t, and since it is horizontal cos α is at least minus the horizontal part of u: between 0
// and the t of that angle there is a solution.
Expected<SupportPoint, NoSupport> slot_support(Vec3 place, Vec3 along, double bend_radius, double free_length,
                                               Vec3 pivot, std::optional<double> pivot_limit) {
  constexpr double least_depth = 1;
  const Vec3 out = radial(azimuth(pivot));
  SupportPoint found;
  double gamma = 0;
  /// Computes the support point for this t, and its value of ρ tan(α/2).
  const auto tangent_of = [&](double tangent) -> Expected<double, NoSupport> {
    const Vec3 c = place + (free_length + tangent) * along;
    const double at = azimuth(c), from_axis = std::hypot(c.x, c.y);
    if (!(from_axis > tangent)) return NoSupport::beyond_axis;
    gamma = 0;
    if (pivot_limit) {
      const Vec3 through = c - pivot;
      const double most = *pivot_limit - std::asin(tangent / from_axis * std::sin(*pivot_limit)),
                   aim = azimuth(pivot) + std::atan2(cross(out, through).z, std::max(dot(out, through), least_depth));
      gamma = std::clamp(wrapped(aim - at), -most, most);
    }
    found.pose.phi = at + gamma;
    const std::optional<TipOffset> tip = tip_offset(along, radial(found.pose.phi), bend_radius, free_length);
    if (!tip) return NoSupport::backwards;
    found.pose.tip = place + tip->offset;
    found.exit_angle = tip->exit_angle;
    return bend_radius * std::tan(tip->exit_angle / 2);
  };
  const double flat = std::hypot(along.x, along.y);
  double low = 0, high = bend_radius * std::tan(std::acos(std::max(-1.0, -flat)) / 2);
  for (int i = 0; i < 100 && high - low > 1e-15 * (1 + high); ++i) {
    const double middle = (low + high) / 2;
    const Expected<double, NoSupport> tangent = tangent_of(middle);
    if (!tangent) return tangent.reason();
    (*tangent > middle ? low : high) = middle;
  }
  if (const auto tangent = tangent_of((low + high) / 2); !tangent) return tangent.reason();
  // The pivot shift of a needle that points straight outwards is round-off.
  found.pivot_shift = gamma == 0 ? 0 : wrapped(found.pose.phi - azimuth(found.pose.tip));
  return found;
}

}  // namespace bahnwerk::winding
