#pragma once
/// Figures of a layout: fill factors, overlaps, turns, resistance.
#include <cstddef>
#include <optional>
#include <span>

#include "core/geometry/region/point.hpp"
#include "core/winding/wire.hpp"

namespace bahnwerk::winding {

/// Return fill factors: copper in the slot as punched [Herrmann (2.2)], and wires in the usable area (2.3); areas in
/// mm².
double electrical_fill(std::size_t count, const Wire& wire, double slot_area);
double mechanical_fill(std::size_t count, const Wire& wire, double room_area);

/// Returns the area that two circles of one radius share, mm²: two segments [Herrmann (4.9), (4.10); the printed form
/// is one].
double shared_area(double radius, double distance);

struct Overlaps {
  double deepest = 0;  ///< 2 r − least distance, mm; 0 if no wires overlap
  double area = 0;     ///< sum over all pairs [Herrmann (4.11)], mm²
};
Overlaps overlaps(std::span<const Point> wires, double radius);  ///< O(n log n)

/// A coil of z_s turns of z_p parallel wires takes z_s · z_p places [Herrmann (4.21)].
struct Turns {
  std::size_t serial = 0, parallel = 0;
  std::size_t wires = 0;  ///< places used, 0 if the coil does not fit
  double loss = 0;        ///< share of empty places; 0 if the coil does not fit
  bool fits = false;      ///< whether the layout holds the coil: at least one turn with all of its wires
};
/// Returns the turns that `count` places take. A number that is not given becomes as large as they allow; with neither,
/// one wire in parallel.
Turns turns(std::size_t count, std::optional<std::size_t> serial, std::optional<std::size_t> parallel);

/// Returns Ω per metre of a conductor of `parallel` wires at `temperature` °C [Herrmann (2.1)]: annealed copper, 1/58 Ω
/// mm²/m at 20 °C and 0.393 % more per kelvin (IEC 60028).
double resistance_per_metre(const Wire& wire, std::size_t parallel, double temperature);

}  // namespace bahnwerk::winding
