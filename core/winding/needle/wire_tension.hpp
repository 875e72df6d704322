#pragma once
/// The tension of the wire at its place, and the force of the brake that maintains it.
///
/// The brake pulls with its set-force B. Wire, rollers and dancer between brake and needle move at the speed w at which
/// the wire is drawn off; their mass, reduced to the wire, is m_eff: a roller's moment of inertia over the square of
/// its radius, J/r², plus the wire's own mass. At the needle's mouth the wire slides through the bend α (Euler and
/// Eytelwein). So
///
///   F_w = (B + m_eff ẇ) e^{μ α w/√(w² + w_0²)},   w_0 = 10 mm/s.
///
/// Where the wire is taken back (w < 0) friction helps the brake. Friction may act either way on a wire at rest: below
/// w_0 it counts in part, so that the set-force does not jump. The dancer takes the wire back at the brake's force. The
/// wire counts as inextensible. [Herrmann 4.4] names the effects, drawing speed and inertia of the wire's path, and
/// demands set-forces that are computed offline; it gives no formula.
#include <limits>

#include "core/winding/wire.hpp"

namespace bahnwerk::winding {

struct TensionModel {
  double force = 30;                                           ///< F, wanted tension of the wire at its place, N
  double mass = 0;                                             ///< m_eff, kg
  double friction = 0;                                         ///< μ, at the needle's mouth
  double range = 0;                                            ///< the brake's largest force, N; 0: unlimited
  double permitted = std::numeric_limits<double>::infinity();  ///< largest tension that the wire allows, N
};

/// State of the wire as it is drawn off.
struct Drawing {
  double speed = 0;         ///< w, mm/s
  double acceleration = 0;  ///< ẇ, mm/s²
  double bend = 0;          ///< α, rad
};

/// Returns F_w, N; below 0 the wire would be slack.
double tension(const TensionModel& model, double brake, const Drawing& drawing);
/// Returns the B that makes F_w = F, within 0 … range, N.
double compensating_brake(const TensionModel& model, const Drawing& drawing);

/// Returns the pull at which soft-annealed copper of that diameter yields: `stress` N/mm² times its section. Winding
/// wire has a proof stress R_p0.2 of some 100 to 120 N/mm²; IEC 60317-0-1 specifies the elongation at fracture only.
double yield_pull(const Wire& wire, double stress = 120);
/// Strength for the pull at which the wire breaks, N/mm² of its section. Soft-annealed copper has 200 to 250 N/mm².
inline constexpr double copper_strength = 200;
double breaking_pull(const Wire& wire, double strength = copper_strength);

}  // namespace bahnwerk::winding
