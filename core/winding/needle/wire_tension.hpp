#pragma once
/// The tension of the wire where it comes to lie, and the force of the brake that keeps it.
///
/// The brake pulls with its set-force B. Wire, rollers and dancer between brake and needle are moved at the speed w at
/// which the wire is drawn off; they weigh, reduced to the wire, m_eff: a roller's moment of inertia over the square of
/// its radius, J/r², plus the wire's own mass. At the needle's mouth the wire slides through the bend α (Euler and
/// Eytelwein). So
///
///   F_w = (B + m_eff ẇ) e^{μ α w/√(w² + w_0²)},   w_0 = 10 mm/s.
///
/// Where the wire is taken back (w < 0) friction helps the brake. A wire that stands may be held either way: below w_0
/// friction counts in part, so that the set-force does not jump. Taking back is the dancer's work: the brake's force
/// holds then, too. The wire counts as inextensible. [Herrmann 4.4] names the effects, drawing speed and inertia of the
/// wire's way, and asks for set-forces that are computed offline; it gives no formula.
#include <limits>

#include "core/winding/wire.hpp"

namespace bahnwerk::winding {

struct TensionModel {
  double force = 30;    ///< F, that the wire shall have where it comes to lie, N
  double mass = 0;      ///< m_eff, kg
  double friction = 0;  ///< μ, at the needle's mouth
  double range = 0;     ///< the brake's largest force, N; 0: as large as asked for
  double permitted = std::numeric_limits<double>::infinity();  ///< that the wire bears, N
};

/// How the wire is drawn off at a moment.
struct Drawing {
  double speed = 0;         ///< w, mm/s
  double acceleration = 0;  ///< ẇ, mm/s²
  double bend = 0;          ///< α, rad
};

/// F_w, N; below 0 the wire would be slack.
double tension(const TensionModel& model, double brake, const Drawing& drawing);
/// B that makes F_w = F, within 0 … range, N.
double compensating_brake(const TensionModel& model, const Drawing& drawing);

/// The pull at which soft-annealed copper of that diameter yields: `stress` N/mm² times its section. Winding wire has a
/// proof stress R_p0.2 of some 100 to 120 N/mm²; what IEC 60317-0-1 demands is the elongation at fracture.
double yield_pull(const Wire& wire, double stress = 120);
/// The pull at which it breaks: `strength` N/mm² times its section. Soft-annealed copper has 200 to 250 N/mm².
inline constexpr double copper_strength = 200;
double breaking_pull(const Wire& wire, double strength = copper_strength);

}  // namespace bahnwerk::winding
