#pragma once
/// Whether a coil can be wound: the one verdict that kinds fill_factor and winding share.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/winding/laying/access.hpp"
#include "core/winding/laying/producible.hpp"
#include "core/winding/layout/layout.hpp"
#include "core/winding/slot/slot.hpp"

namespace bahnwerk {
class Progress;
}

namespace bahnwerk::winding {

/// The wires of a coil in its slot, and in its other one where those are known.
struct LaidCoil {
  const Slot& slot;
  double radius = 0;  ///< of a wire with its enamel, mm
  const Layout& layout;
  Point tension_point;                ///< draws the wires of a layout without tension points of its own
  std::optional<Needle> needle;       ///< none: only the wire must pass the opening
  const Layout* back = nullptr;       ///< in the coil's other slot; none: nothing is said of that
  bool swivels = false;               ///< the needle, so that it reaches more than one that stands upright
  const Region* back_area = nullptr;  ///< usable area of the other slot; none: that of `slot`
};

struct Windable {
  /// What does not pass opening or slot; `back` of those in the coil's other slot.
  struct Blocked : Obstruction {
    bool back = false;
  };
  std::size_t wires = 0;  ///< of the whole layout
  std::vector<Blocked> blocked;
  Producible producible;

  /// How many wires, from the first one on, wire and needle bring to their places, and the pile holds.
  std::size_t most() const;
  /// Whether the first `wires` of the layout can be wound.
  bool can_be_wound(std::size_t count) const { return count <= most(); }
  /// What stands in the way of the first `count` wires, and which of them slip.
  std::vector<Blocked> blocked_among(std::size_t count) const;
  Producible producible_among(std::size_t count) const;
};

/// The wires' pile by producible(), wire and needle at the opening by opening_obstructions(), the needle's way to every
/// place by first_out_of_reach(); beside a rotor's coil the needle has all the usable area between the poles. Cost:
/// that of producible(), up to the first wire that slips.
Windable windable(const LaidCoil& coil, const ProducibleOptions& options, Progress& progress);

}  // namespace bahnwerk::winding
