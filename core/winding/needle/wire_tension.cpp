#include "core/winding/needle/wire_tension.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace bahnwerk::winding {
namespace {

constexpr double creeping = 10;  // mm/s

double capstan(const TensionModel& model, const Drawing& drawing) {
  return std::exp(model.friction * drawing.bend * drawing.speed / std::hypot(drawing.speed, creeping));
}
/// Returns m ẇ, N: kg mm/s² are mN.
double inertia(const TensionModel& model, const Drawing& drawing) { return model.mass * drawing.acceleration / 1000; }

}  // namespace

double tension(const TensionModel& model, double brake, const Drawing& drawing) {
  return (brake + inertia(model, drawing)) * capstan(model, drawing);
}

double compensating_brake(const TensionModel& model, const Drawing& drawing) {
  const double most = model.range > 0 ? model.range : std::numeric_limits<double>::infinity();
  return std::clamp(model.force / capstan(model, drawing) - inertia(model, drawing), 0.0, most);
}

double yield_pull(const Wire& wire, double stress) { return stress * std::numbers::pi / 4 * wire.copper * wire.copper; }
double breaking_pull(const Wire& wire, double strength) { return yield_pull(wire, strength); }

}  // namespace bahnwerk::winding
