#pragma once
/// From a slot to its layouts: every wire by every algorithm, checked by the independent verifier, with a proven bound
/// on the count.
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "core/base/verification.hpp"
#include "core/winding/fill.hpp"
#include "core/winding/laying/needle.hpp"
#include "core/winding/laying/windable.hpp"
#include "core/winding/layout/layout.hpp"
#include "core/winding/slot/slot.hpp"
#include "core/winding/wire.hpp"

namespace bahnwerk {

class Progress;

/// Samples of a slot and a wire that are not nominal.
struct FillSampling {
  int samples = 0;
  std::optional<double> wire_tolerance;  ///< fraction of the overall diameter; the wire's own if not given
  double slot_tolerance = 0;             ///< mm, of the walls
};

struct FillRequest {
  winding::Slot slot;
  std::vector<winding::Wire> wires;
  std::vector<winding::Algorithm> algorithms;
  std::optional<double> overlap_tolerance;  ///< fraction of the radius; 0.5 ε_D if not given [Herrmann 4.2.3]
  std::uint64_t seed = 1;
  double effort = 1;
  int shifts = 4;
  Point tie_in;
  /// Winding heads of layout needle; without heads every wire is drawn to tie_in.
  std::variant<std::monostate, winding::StatorHeads, winding::RotorHeads> heads;
  std::optional<std::size_t> serial, parallel;
  double temperature = 20;  ///< °C
  winding::ProducibleOptions producible;
  std::optional<winding::Needle> needle;  ///< needs a channel; none: only the wire must pass the opening
  /// Where the coil's wires go in its other slot; empty: in the same usable area. See core/winding/slot/coil_sides.hpp.
  Region back;
  std::size_t sides = 1;  ///< coil sides that share the slot's area, all with as many wires
  FillSampling sampling;
};

struct FilledLayout {
  winding::Algorithm algorithm = winding::Algorithm::needle;
  winding::Wire wire;
  winding::Layout layout;
  std::vector<winding::Layout> regions;  ///< of needle with heads: winding head, other slot, winding head
  double overlap = 0;                    ///< mm, allowed
  std::size_t bound = 0;                 ///< no layout has more wires
  double electrical = 0, mechanical = 0;
  winding::Overlaps overlaps;
  winding::Windable windable;  ///< of the whole layout
  winding::Turns turns;
  double resistance = 0;             ///< Ω/m of the coil's conductor
  std::vector<std::size_t> sampled;  ///< counts of the samples

  std::size_t count() const { return layout.wires.size(); }
  /// Wires of the coil that is wanted; all of them where the layout does not take it.
  std::size_t wanted() const { return turns.fits ? turns.wires : count(); }
  bool can_be_wound() const { return windable.can_be_wound(wanted()); }
};

struct FillPlan {
  std::vector<FilledLayout> layouts;  ///< by wires, then by algorithms, in the order of the request
  std::vector<std::size_t> best;      ///< per algorithm: the layout with the largest electrical fill factor
  std::size_t top = 0;                ///< the best of all
  Verification verification;
  Bound bound;  ///< on the wires of the best of all, from above
};

/// Plans the same request to the same bits. Throws Stopped; Infeasible if turns are asked for and no layout takes them.
/// Cost: that of the algorithms, see their headers; verification is quadratic in the wires of a layout.
FillPlan plan_fill(const FillRequest& request, Progress& progress);

/// Returns by how much two wires of a layout may be nearer than their diameter, mm [Herrmann 4.2.3].
double allowed_overlap(const FillRequest& request, winding::Algorithm algorithm, const winding::Wire& wire);

const char* name(winding::Algorithm algorithm);
/// Returns the name of an element of FilledLayout::regions.
const char* region_name(std::size_t region);

}  // namespace bahnwerk
