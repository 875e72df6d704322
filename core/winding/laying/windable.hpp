#pragma once
/// Decides whether a coil can be wound; kinds fill_factor and winding share this verdict.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/progress.hpp"
#include "core/winding/laying/access.hpp"
#include "core/winding/laying/producible.hpp"
#include "core/winding/layout/layout.hpp"
#include "core/winding/slot/slot.hpp"

namespace bahnwerk::winding {

/// The wires of a coil in its slot, and in its other slot if those are known.
struct LaidCoil {
  const Slot& slot;
  double radius = 0;  ///< mm, radius of a wire with its enamel
  const Layout& layout;
  Point tension_point;                ///< draws the wires of a layout without tension points
  std::optional<Needle> needle;       ///< needle that has to pass the opening; none: only the wire has to
  const Layout* back = nullptr;       ///< layout in the coil's other slot; null: no verdict on that slot
  const Region* back_area = nullptr;  ///< usable area of the other slot; null: that of `slot`
};

struct Windable {
  /// An obstruction; `back` means the coil's other slot.
  struct Blocked : Obstruction {
    bool back = false;
  };
  std::size_t wires = 0;  ///< number in the whole layout
  std::vector<Blocked> blocked;
  Producible producible;

  /// Returns how many wires, from the first one on, wire and needle can bring to their places in a stable pile.
  std::size_t most() const;
  /// Tells whether the first `count` wires of the layout can be wound.
  bool can_be_wound(std::size_t count) const { return count <= most(); }
  /// Returns the obstructions of the first `count` wires, slipping wires included.
  std::vector<Blocked> blocked_among(std::size_t count) const;
  Producible producible_among(std::size_t count) const;
};

/// Decides the pile by producible(), wire and needle at the opening by opening_obstructions(), an upright needle's
/// channel to every place by first_out_of_reach(). One that swivels is taken to reach every place, and beside a rotor's
/// coil the needle has the whole usable area between the poles.
/// Cost: that of producible(), up to the first wire that slips.
Windable windable(const LaidCoil& coil, const ProducibleOptions& options, Progress progress);

}  // namespace bahnwerk::winding
