#pragma once
/// The part to be wound and the places of its coils: frames of the laying regions for any slot, span and winding
/// direction [Herrmann (4.22), (4.23), Tables 4.3 and 4.4]. Lengths mm, angles rad.
///
/// Slots are numbered counterclockwise seen from above. Slot n of a stator has its middle at n · 2π/slots. Slot n of a
/// rotor lies between pole n − 1 and pole n, and pole n has its middle at n · 2π/poles: a coil over the slots [n, n +
/// 1] lies about pole n.
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#include "core/winding/laying/laying_regions.hpp"

namespace bahnwerk::winding {

struct StatorPart {
  StatorSlot slot;
  /// A slot as it is drawn, upright(); `slot` then has its height, the clear width of its opening, and no tip radius.
  std::optional<PolygonSlot> drawn = {};
  /// `slot_pitch` and `span` are ignored: they follow from the number of slots and from the coil.
  StatorHeads heads;
  int slots = 48;
  double pitch() const { return 2 * std::numbers::pi / slots; }
};

/// Returns a stator whose slot is drawn, with its base at `base_radius` from the axis. Throws InvalidInput naming
/// members of "slot".
StatorPart drawn_stator(const PolygonSlot& slot, double base_radius);

struct RotorPart {
  RotorSlot slot;
  RotorHeads heads;
  int poles = 6;
  double pitch() const { return 2 * std::numbers::pi / poles; }
};

/// The wire goes down through slot `first` and up through slot `first + span`, counted round the part; the span's sign
/// is the sense in which it passes the lower winding head.
struct Coil {
  int first = 0;
  int span = 5;
  friend bool operator==(const Coil&, const Coil&) = default;
};

/// Returns the coil from slot `from` to slot `to`, both 0 … number of slots (which is slot 0), the shorter way round.
/// Over half a stator it follows the numbering. About a rotor's pole it is [n, n + 1] or, in the other direction, [n +
/// 1, n]. Throws InvalidInput naming coil.slots.
Coil coil_between(const StatorPart& part, int from, int to);
Coil coil_between(const RotorPart& part, int from, int to);

/// Returns the coil wound in the other direction: down where it went up.
Coil reversed(Coil coil);
/// Returns `count` coils, each `step` slots after the one before, every other one reversed if `alternate`. Slot numbers
/// are reduced to 0 … slots − 1.
std::vector<Coil> repeated(Coil coil, int slots, int step, std::size_t count, bool alternate);

/// Returns the slot for sections and layouts. Throws InvalidInput naming members of "slot", and of "part" for a number
/// of slots or poles below 2 or so large that the slots overlap.
Slot checked_slot(const StatorPart& part);
Slot checked_slot(const RotorPart& part);

/// Returns the azimuth of the middle of a slot, rad. Slot numbers need not be reduced.
inline double slot_azimuth(const StatorPart& part, int slot) { return slot * part.pitch(); }
inline double slot_azimuth(const RotorPart& part, int slot) { return (slot - 0.5) * part.pitch(); }

/// Returns the diameter of a stator's bore, mm.
double bore(const StatorPart& part);
/// Returns the radius of a rotor's outer circle, through the outer ends of the pole shoes, mm. `slot` is
/// checked_slot(part).
double outer_radius(const RotorPart& part, const Slot& slot);
/// Returns the narrowest opening that wire and needle have to pass, mm: the opening between a stator's tooth tips, the
/// gap between the coils of a rotor's neighbouring poles.
double clear_way(const StatorPart& part, const Slot& slot);
double clear_way(const RotorPart& part, const Slot& slot);

/// Tells whether a tooth remains between neighbouring slots, `pitch` rad apart, whose base is at `base_radius` from the
/// axis.
bool leaves_teeth(const Slot& slot, double base_radius, double pitch);

/// Returns the four laying regions of one coil, at its place in the part. Sections and layouts are equal for all coils
/// with one size of span: a counterclockwise coil mirrors a clockwise one. `slot` is checked_slot(part). Throws
/// InvalidInput where the winding tools of both sides overlap.
LayingRegions coil_regions(const StatorPart& part, const Slot& slot, Coil coil);
LayingRegions coil_regions(const RotorPart& part, const Slot& slot, Coil coil);

}  // namespace bahnwerk::winding
