#include "core/winding/needle/wire_pull.hpp"

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/errors.hpp"

namespace bahnwerk::winding {
namespace {
constexpr double largest_radius = 1e5;  // mm: no machine's size
}  // namespace

double bending_moment(const Wire& wire, double yield_stress) {
  return yield_stress * wire.copper * wire.copper * wire.copper / 6;
}

double bend_radius(const Pull& pull) {
  std::vector<InputFault> faults;
  const auto check = [&](const char* member, double value, bool zero) {
    if (std::isfinite(value) && (value > 0 || (zero && value == 0))) return;
    faults.push_back({{"pull", member}, zero ? "is not a number of 0 or more" : "is not a number above 0"});
  };
  check("force", pull.force, false);
  check("bend_radius", pull.bend_radius, true);
  check("bending_moment", pull.bending_moment, true);
  check("free_length", pull.free_length, true);
  if (!faults.empty()) throw InvalidInput(faults);
  const double radius = std::max(pull.bend_radius, pull.bending_moment / pull.force);
  if (!(radius <= largest_radius))
    throw InvalidInput(
        {{{"pull", "force"},
          "is too little: the wire would bend in a circle of " + std::to_string(radius) + " mm at least"}});
  return radius;
}

std::optional<TipOffset> tip_offset(Vec3 along, Vec3 needle, double bend_radius, double free_length) {
  // Sine and cosine give an accurate angle also where the wire leaves straight ahead or backwards.
  const double angle = std::atan2(norm(cross(along, needle)), -dot(along, needle));
  if (angle > std::numbers::pi - 1e-3) return std::nullopt;
  const double tangent = bend_radius * std::tan(angle / 2);
  return TipOffset{(free_length + tangent) * along - tangent * needle, angle};
}

}  // namespace bahnwerk::winding
