#pragma once
/// The four regions that a turn of a needle winding passes [Herrmann 4.2.4, 4.2.6]: slot, winding head at the bottom,
/// slot of the coil's other side, winding head at the top. Each has a plane section in which wires are laid and a frame
/// of that plane in the part's coordinates at either end of the region. Lengths mm, angles rad.
/// Part: z along its axis from the stack's lower to its upper end, x through the first slot's middle (stator) or along
/// the tooth (rotor); the wire enters the first slot from above.
#include <array>
#include <cstddef>
#include <numbers>

#include "core/geometry/curve/vec.hpp"
#include "core/winding/slot/slot.hpp"

namespace bahnwerk::winding {

/// A point or vector in the part's coordinates.
using Vec3 = Vec;

/// A section's plane in the part: orthonormal x and y axis.
struct Frame {
  Vec3 origin, x, y;
  Vec3 place(Point p) const;
  /// Returns the foot of `p` on the plane. Its distance to a place is the length of the part of (p − place) that is
  /// normal to the wire (4.15).
  Point foot(Vec3 p) const;
};

struct LayingRegion {
  Region usable_area;
  Frame begin, end;  ///< frames at which the wire enters and leaves the region, ^B T_{j,a} and ^B T_{j,e}
};

struct LayingRegions {
  std::array<LayingRegion, 4> at;
  /// The wire is drawn from a point this far before the end of the region that it leaves: it bends round the edge
  /// between two regions instead of being held at its tip.
  double hold = 0;
  /// Returns the point at which the wire at `place` of region `j` is held before it leaves the region.
  Vec3 held(std::size_t j, Point place) const;
};

/// Winding heads of a stator. Wires lie behind a winding tool per slot: outside a cylinder about the stator's axis and
/// beyond the tool's contact height, in the section radial (x) by axial (y) with the corner of both contacts as origin.
/// The tools are shifted towards the coil's middle, and the wires between them are straight across the section. The
/// second slot lies clockwise from the first, so the first slot's wires are drawn to negative x. Defaults: [Herrmann
/// Table 4.3].
struct StatorHeads {
  double base_radius = 95.7;                         ///< r_NG, of the base as punched, the origin of slot coordinates
  double slot_pitch = 7.5 * std::numbers::pi / 180;  ///< φ_Z
  double tool_radius = 99.971;                       ///< r_WK
  double tool_shift = 2.5;                           ///< b_WK, tangential
  double tool_height = 15.5;                         ///< h_WK, from the stack's end
  double stack = 210;                                ///< h_BP
  int span = 5;                                      ///< slot pitches between the coil's sides
};

/// Winding heads of a rotor: end caps with the grooves of the slot's base, flanges that continue the slot's flanks up
/// to the cap's height, sections along the tooth (x) by axial (y). Defaults: [Herrmann Table 4.4].
struct RotorHeads {
  double cap_height = 28;           ///< h_E, from the stack's end
  double cap_base = 10.6;           ///< h_EN, of the grooves from the stack's end
  double stack = 202;               ///< h_BP
  double tooth_half_width = 10.35;  ///< b_Z, from the tooth's middle to the slot's base
  double tooth_radius = 40.10;      ///< r_Z, of the slot's origin
  double hold =
      5;  ///< length of held wire before the edges of the tooth; [Herrmann Fig. 4.10] draws from 5 mm below the base
};

/// Returns sections and frames after [Herrmann (4.22)] with y from the base to the bore, i.e. R_z(+π/2).
LayingRegions laying_regions(const Slot& slot, const StatorHeads& heads);
/// Returns sections and frames after (4.23). The slot's outline must have one straight closing line between two
/// straight flanks, as make_slot gives it; otherwise throws std::invalid_argument. Throws InvalidInput if the flanks
/// cannot be extended to the cap's height.
LayingRegions laying_regions(const Slot& slot, const RotorHeads& heads);

}  // namespace bahnwerk::winding
