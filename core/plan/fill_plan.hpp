#pragma once
/// The plan of a slot's fill: layouts of every wire by every algorithm, checked by the independent verifier, with a
/// proven upper bound of the count.
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "core/base/progress.hpp"
#include "core/base/verification.hpp"
#include "core/winding/fill.hpp"
#include "core/winding/laying/needle.hpp"
#include "core/winding/laying/windable.hpp"
#include "core/winding/layout/layout.hpp"
#include "core/winding/slot/slot.hpp"
#include "core/winding/wire.hpp"

namespace bahnwerk {

/// Random deviations of slot and wire from their nominal sizes.
struct FillSampling {
  int samples = 0;
  std::optional<double> wire_tolerance;  ///< fraction of the overall diameter; none: the wire's own
  double slot_tolerance = 0;             ///< mm, largest displacement of the walls
};

struct FillRequest {
  winding::Slot slot;
  std::vector<winding::Wire> wires;
  std::vector<winding::Algorithm> algorithms;
  std::optional<double>
      overlap_tolerance;  ///< allowed overlap as a fraction of the radius; none: 0.5 ε_D [Herrmann 4.2.3]
  std::uint64_t seed = 1;
  double effort = 1;
  int shifts = 4;
  Point tie_in;
  std::variant<winding::StatorHeads, winding::RotorHeads> heads;  ///< winding heads for the algorithm `needle`
  winding::Placement drawn;  ///< where the document draws the slot; plans are in the slot's coordinates
  std::optional<std::size_t> serial, parallel;
  double temperature = 20;  ///< °C
  winding::ProducibleOptions producible;
  std::optional<winding::Needle> needle;  ///< needle that needs a channel; none: only the wire must pass the opening
  /// Usable area of the coil's other side; empty: equal to the first one. See core/winding/slot/coil_sides.hpp.
  Region back;
  std::size_t sides = 1;  ///< coil sides that share the slot's area, all with as many wires
  FillSampling sampling;
};

struct FilledLayout {
  winding::Algorithm algorithm = winding::Algorithm::needle;
  winding::Wire wire;
  winding::Layout layout;
  std::vector<winding::Layout> regions;  ///< layouts of winding head, other slot, winding head; for `needle` with heads
  double overlap = 0;                    ///< mm, allowed overlap
  std::size_t bound = 0;                 ///< proven upper bound of the number of wires
  double electrical = 0, mechanical = 0;
  winding::Overlaps overlaps;
  winding::Windable windable;  ///< verdict on the whole layout
  winding::Turns turns;
  double resistance = 0;             ///< Ω/m of the coil's conductor
  std::vector<std::size_t> sampled;  ///< numbers of wires in the samples

  std::size_t count() const { return layout.wires.size(); }
  /// Returns the number of wires of the requested coil; all wires if the layout does not hold the coil.
  std::size_t wanted() const { return turns.fits ? turns.wires : count(); }
  bool can_be_wound() const { return windable.can_be_wound(wanted()); }
};

struct FillPlan {
  std::vector<FilledLayout> layouts;  ///< ordered by wires, then by algorithms, as in the request
  std::vector<std::size_t> best;      ///< index of each algorithm's layout with the largest electrical fill factor
  std::size_t top = 0;                ///< index of the best layout of all
  Verification verification;
  Bound bound;  ///< upper bound of the number of wires of the best layout
};

/// Returns the plan; equal requests give identical plans. Throws Stopped, and Infeasible if turns are requested and no
/// layout holds them. Cost: that of the algorithms, see their headers; verification is quadratic in the wires of a
/// layout.
FillPlan plan_fill(const FillRequest& request, Progress progress);

/// Returns the expected time of plan_fill, s of one processor, within a factor of two for times above a second. Cost:
/// that of one bound on the number of wires.
double expected_time(const FillRequest& request);

/// Returns the largest amount, mm, by which the distance of two wires may be less than their diameter [Herrmann 4.2.3].
double allowed_overlap(const FillRequest& request, winding::Algorithm algorithm, const winding::Wire& wire);

/// Returns the algorithm's name in documents.
const char* name(winding::Algorithm algorithm);
/// Returns the name of an element of FilledLayout::regions.
const char* region_name(std::size_t region);

}  // namespace bahnwerk
