#pragma once
/// Slots: the iron's cross-section and the usable area that liner and wedge leave for wires. [Herrmann Fig. 4.1,
/// Tables 4.1 and 4.2]; docs/methods/fill_factor.md draws both and says how unclear parameters are read. Coordinates:
/// origin in the middle of the base (stator) or in the corner at the inner radius (rotor), y from the base into the
/// usable area. Lengths mm, angles rad.
#include <array>
#include <optional>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/region/region.hpp"

namespace bahnwerk::winding {

/// A slot of a stator with teeth outside the bore: base an arc about the stator's axis, straight flanks, wedge at the
/// opening. Defaults: [Herrmann Table 4.1].
struct StatorSlot {
  double base_width = 5.857;              ///< b_N, between the corners of base and flanks
  double opening_width = 3.683;           ///< b_t, between the tooth tips where their rounding begins
  double base_corner_radius = 0.28;       ///< r_eb
  double base_radius = 95.48;             ///< r_b, about the stator's axis
  double liner = 0.22;                    ///< d_Iso
  double wedge_thickness = 0.42;          ///< d_DS
  double wedge_width = 3.683;             ///< b_DS
  double tip_corner_radius = 0.3;         ///< r_et
  double height = 16.129;                 ///< h_N, from the base's middle to the tooth tips
  double tip_angle = 1.6144295580947547;  ///< φ_et, 92.5°, interior angle between flank and tooth tip
};

/// The usable area beside a rotor's pole: base along the tooth with grooves, flanks at end winding side and pole shoe,
/// the open side closed by a straight line. Defaults: [Herrmann Table 4.2].
struct RotorSlot {
  int grooves = 12;                        ///< n_Gr
  double groove_radius = 0.65;             ///< r_Gr
  double shoe_radius = 0.65;               ///< r_t, between base and pole shoe
  double groove_pitch = 1.217;             ///< b_Gr
  double shoe_angle = 2.0943951023931953;  ///< φ_t, 120°, between base and flank at the outer radius
  double root_angle = 2.0943951023931953;  ///< φ_b, 120°, between base and flank at the inner radius
  double base_width = 13.738;              ///< b_N, from the root's corner to the last groove's middle
  double root_flank = 5.943;               ///< l_b, length of the flank at the inner radius
  double shoe_flank = 2.434;               ///< l_t, length of the flank at the outer radius
  double height = 14.684;                  ///< h_N, of the pole beside the coil; only checked against base_width
};

/// The outline is any simple polygon; the liner covers all of it.
struct PolygonSlot {
  std::vector<Point> points;
  double liner = 0;
  double corner_radius = 0;                          ///< mm, radius of convex corners
  std::optional<std::array<Point, 2>> opening = {};  ///< both ends of the opening, on the outline
};

/// The opening through which wires and needle enter.
struct Opening {
  Point middle;
  Point into{0, -1};  ///< unit vector
  double clear = 0;   ///< width between the tooth tips, mm
  double cover = 0;   ///< mm, thickness of the liner on the inside of the tooth tips
};

struct Slot {
  enum class Type { stator, rotor, polygon };
  Type type = Type::polygon;
  Region iron;                     ///< the slot as punched
  Region usable_area;              ///< area that wires may fill
  std::optional<Opening> opening;  ///< opening; a polygon has one only if it is given
  Region wedge;                    ///< wedge, for drawings; the usable area excludes it
  Region taken;                    ///< area of a coil side laid earlier; empty: none
  /// The point from which the winding head pulls a wire: [Herrmann 4.2.1] uses (−4, −4) mm for the stator.
  Point tension_point;
  Point flank_tension_point;  ///< the point for layers that begin at a flank: (−4, 0) mm there
  double flank = 0;           ///< direction of the flank at which layers may begin, rad against the base
};

/// Throws InvalidInput naming each impossible parameter by its member in the schema.
Slot make_slot(const StatorSlot&);
Slot make_slot(const RotorSlot&);
/// Asks `progress`, if there is one: with thousands of corners this takes a tenth of a second.
Slot make_slot(const PolygonSlot&, Progress progress = {});

/// Where a document draws a slot: the axes of slot coordinates in the document's.
struct Placement {
  Point origin{}, x{1, 0};
  Point place(Point slot) const { return origin + slot.x * x + slot.y * left_of(x); }
  Point foot(Point drawn) const { return {dot(drawn - origin, x), dot(drawn - origin, left_of(x))}; }
};

/// A drawn slot in slot coordinates: its opening lies across the y axis, level, and its lowest point at y = 0, as a
/// stator's slot is described; one without opening is not turned, and the middle of its width lies on the y axis. A
/// slot that is drawn so keeps its coordinates to the bit.
struct UprightSlot {
  PolygonSlot slot;
  Placement drawn;
};
/// Throws as make_slot does.
UprightSlot upright(const PolygonSlot&, Progress progress = {});

}  // namespace bahnwerk::winding
