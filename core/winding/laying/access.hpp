#pragma once
/// Decides whether wire and needle can reach the places of a layout: through the slot's opening, then through the free
/// part of the slot. [Herrmann 4.2.6] draws the reach of a needle in a stator slot and finds the lower two thirds
/// accessible; this code decides the case of a straight needle that does not swivel.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/progress.hpp"
#include "core/winding/layout/layout.hpp"
#include "core/winding/slot/slot.hpp"

namespace bahnwerk::winding {

/// The needle in the slot's section: a bar of `width`, upright in the opening: along `Opening::into`, in its middle
/// or, if a second coil side lies beside it, along the border to that side. Its mouth is the middle of its end.
struct Needle {
  enum class Stand { middle, left, right };  ///< seen with the opening at the top
  double width = 0;                          ///< mm
  Stand stand = Stand::middle;
  std::size_t wires = 1;  ///< wires in hand: it leads them all, side by side
  bool swivels = false;   ///< whether it swivels in the opening, so that it reaches more than an upright one
};

/// Returns the diameter of the least circle round `wires` circles of `diameter`: exactly for up to seven [Graham: Sets
/// of points with given minimum separation, 1968], for more a lower bound by Oler's inequality for their centres, see
/// core/winding/layout/count_bound.hpp.
double bundle_diameter(std::size_t wires, double diameter);
inline constexpr std::size_t exact_bundle = 7;  ///< largest number of wires whose bundle_diameter is exact

struct Obstruction {
  enum class Part {
    wire,     ///< the wire does not pass the opening
    needle,   ///< the needle does not pass the opening, or the part of it beside the other coil side
    bore,     ///< the needle's bore is too narrow for the wires that it leads
    channel,  ///< wires laid before block the needle's channel to the place of `wire`
  };
  Part part = Part::wire;
  double needed = 0, clear = 0;  ///< needed and clear width of wire or needle, mm; for the bore: of bundle and needle
  std::size_t wire = 0;          ///< index of the first wire that cannot be reached, if the part is the channel
};

/// Compares wire and needle with the opening's clear width, and the bundle of wires in hand with the needle's width: a
/// needle has walls, so a bundle as thick as the needle does not run in it.
std::vector<Obstruction> opening_obstructions(const Opening& opening, double radius, const std::optional<Needle>&);

/// The wires of a slot in laying order. Their places have to outlive the object.
struct WiresToLay {
  const std::vector<Point>& places;  ///< centres, mm
  double radius;                     ///< mm
  double touch;                      ///< fraction of their diameter by which wires yield
};

/// Returns the first wire that the needle cannot bring to its place. The needle stands at most as deep as wires laid
/// before and the slot's base allow. From its mouth the wire runs straight to its place, past all wires laid before
/// and, above the tooth tips, through the clear opening. Walls that project into the slot are ignored: they guide a
/// wire. Every position of the mouth is decided, by intervals. O(n²) for n wires.
std::optional<std::size_t> first_out_of_reach(const Region& usable_area, const Opening& opening, const Needle& needle,
                                              const WiresToLay& wires, Progress progress);

}  // namespace bahnwerk::winding
