#pragma once
/// Decides whether a layout can be produced by laying its wires in their order under tension. [Herrmann 4.2.1–4.2.5]
/// decides this by eye.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/region/region.hpp"
#include "core/winding/layout/layout.hpp"

namespace bahnwerk::winding {

/// Every wire is drawn to its point with a unit force, and must stay where it was laid
/// (a) as it is laid: boundary and wires laid before, taken as fixed, hold it;
/// (b) as every later wire is laid: forces that only push, between wires and boundary, hold the whole pile.
///
/// Without friction hardly any pile passes (b): two wires side by side on a smooth base are driven apart by the first
/// one on top of them. Real piles are held by
/// - friction of enamel on enamel and on the liner, dry and under tension;
/// - neighbours whose gaps are within the tolerance of the wires: a wire that moves by less than its own tolerance is
///   still in its place. Gaps up to `touch` count as contacts.
///
/// Both numbers are equal for all layouts. In the example stator slot they separate widely what the source separates by
/// eye: needle layouts of the standard wires from 0.5 to 1.6 mm of copper are stable from a friction of 0.28 on,
/// layouts on a lattice along the flank slip up to 0.55, those on a lattice along the base up to 1.
struct ProducibleOptions {
  double friction = 0.3;
  double touch = 0.02;  ///< fraction of the diameter; overall diameters of a standard wire differ by 0.02 to 0.04
};

struct Producible {
  enum class Reason {
    no_support,  ///< the wire slips as it is laid
    pushed_out,  ///< a wire laid later pushes it out
  };
  struct Slip {
    std::size_t wire = 0;  ///< the wire that slips
    std::size_t laid = 0;  ///< the wire whose laying makes it slip; equal to `wire` if that has no support
    Reason reason = Reason::no_support;
    bool proved = true;  ///< whether velocities prove it; false: no balance was found, and no proof that there is none
  };
  std::optional<Slip> first;  ///< first wire that slips, in the order of laying; none: the layout is producible
  std::vector<std::size_t> unsupported;  ///< wires that fail (a)

  bool producible() const { return !first; }
  std::vector<std::size_t> slipping() const;  ///< returns the wires that slip, ascending
};

/// `tension_point` draws the wires of a layout without pulls of its own. (b) is decided up to the first slip only,
/// since later wires would lie differently. The whole boundary supports wires, also the side that a wedge closes later.
/// O(n) solutions of a balance of O(n) forces.
Producible producible(const Region& usable_area, double radius, const Layout& layout, Point tension_point,
                      const ProducibleOptions& options, Progress progress);

}  // namespace bahnwerk::winding
