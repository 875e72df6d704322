#pragma once
/// Whether wire and needle can get to where a layout wants the wires: through the slot's opening, then through what is
/// left of the slot. [Herrmann 4.2.6] draws how far a needle reaches in a stator slot and finds the lower two thirds
/// accessible; decided here is the plain case of a straight needle that does not swivel.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/winding/layout/layout.hpp"
#include "core/winding/slot/slot.hpp"

namespace bahnwerk {
class Progress;
}

namespace bahnwerk::winding {

/// In the slot's section the needle is a bar of `width`, upright in the opening: along `Opening::into`, in its middle
/// or, where a second coil side lies beside, along the border to that. Its mouth is the middle of its end.
struct Needle {
  enum class Stand { middle, left, right };  ///< seen with the opening at the top
  double width = 0;                          ///< mm
  Stand stand = Stand::middle;
};

struct Obstruction {
  enum class Part {
    wire,     ///< does not pass the opening
    needle,   ///< does not pass the opening, or what the other coil side leaves of it
    bore,     ///< the needle's: too narrow for the wire, which is led inside it
    channel,  ///< the needle's: the wires laid before leave no way to the place of `wire`
  };
  Part part = Part::wire;
  double needed = 0, clear = 0;  ///< mm, of wire and needle; of the bore the wire's and the needle's width
  std::size_t wire = 0;          ///< of the channel: index of the first wire without a way
};

/// Wire and needle against the opening's clear width, the wire against the needle's width: a needle has walls, so a
/// wire as thick as the needle does not run in it.
std::vector<Obstruction> opening_obstructions(const Opening& opening, double radius, const std::optional<Needle>&);

/// The first wire, in laying order, that the needle cannot bring to its place. The needle stands as deep as wires laid
/// before and the slot's base allow, or less deep; from its mouth the wire runs straight to its place, past all wires
/// laid before and, above the tooth tips, through the clear opening. Wires yield by `touch`, a fraction of their
/// diameter. Walls that jut into the slot are not looked at: they guide a wire rather than hold it back.
/// Every position of the mouth is decided, by intervals. O(n²) for n wires.
std::optional<std::size_t> first_out_of_reach(const Region& usable_area, const Opening& opening, const Needle& needle,
                                              double radius, double touch, const std::vector<Point>& wires,
                                              Progress& progress);

}  // namespace bahnwerk::winding
