#pragma once
/// The turns of a winding in the order in which they are wound: coil after coil, each with the layouts of the four
/// laying regions at its place in the part. Lengths mm.
#include <array>
#include <cstddef>
#include <vector>

#include "core/winding/laying/needle.hpp"
#include "core/winding/part/part.hpp"

namespace bahnwerk::winding {

/// A wire's passage through one laying region.
struct Passage {
  Vec3 begin, end;  ///< ^B r_{i,j,a} and ^B r_{i,j,e}: the wire's axis where it enters and leaves the region
  Vec3 held;        ///< the point at which it is held before it enters: in the region before [Herrmann (4.15)]
};

struct Turn {
  std::size_t coil = 0, number = 0;  ///< number: 0 … turns − 1 of its coil
  std::array<Passage, 4> at;
  int layer = 1;            ///< layer of the wire in the first slot, counted from its base
  bool layer_jump = false;  ///< whether the turn begins another layer than the turn before it in its coil
};

/// Returns the layer of each wire: a wire lies on the earlier wires that it touches and that are more than 30° below
/// it, as seen across the section. Gaps of up to `touch` diameters count as contacts. O(n²).
std::vector<int> layers(const std::vector<Point>& wires, double radius, double touch = 0.02);

/// Returns the turns of coils that all have the layouts `layouts`. The first turn of a coil is held where it would be
/// after another turn with the places of the first one. With `parallel` wires in hand a turn takes as many consecutive
/// places of the layouts and passes through their middle. Throws Infeasible where the layouts have fewer wires than
/// turns · parallel. O(turns · (coils + parallel)).
std::vector<Turn> turns_of(const std::vector<LayingRegions>& coils, const NeedleLayout& layouts, std::size_t turns,
                           double radius, std::size_t parallel = 1);

}  // namespace bahnwerk::winding
