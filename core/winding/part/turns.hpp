#pragma once
/// All turns of a winding in the order in which they are wound: coil after coil, each with the layouts of the four
/// laying regions at its place in the part. Lengths mm.
#include <array>
#include <cstddef>
#include <vector>

#include "core/winding/laying/needle.hpp"
#include "core/winding/part/part.hpp"

namespace bahnwerk::winding {

/// A wire's passage through one laying region.
struct Passage {
  Space begin, end;  ///< ^B r_{i,j,a} and ^B r_{i,j,e}: its axis where it enters and leaves the region
  Space held;        ///< where it is held before it enters: in the region before [Herrmann (4.15)]
};

struct Turn {
  std::size_t coil = 0, number = 0;  ///< number: 0 … turns − 1 of its coil
  std::array<Passage, 4> at;
  int layer = 1;            ///< of the wire in the first slot, from its base
  bool layer_jump = false;  ///< whether the turn begins another layer than that of the turn before it in the same coil
};

/// How many wires lie under each one, itself included: a wire lies on those before it that it touches and that are more
/// than 30° below it, as seen across the section. Gaps of up to `touch` diameters count as contacts. O(n²).
std::vector<int> layers(const std::vector<Point>& wires, double radius, double touch = 0.02);

/// Turns of coils that all have the layouts `layouts`. The first turn of a coil is held where it would be if a turn
/// with the places of the first one had been laid before. With `parallel` wires in hand a turn takes as many places of
/// the layouts, one after the other, and goes through the middle of them. Throws Infeasible where the layouts have
/// fewer wires than turns · parallel. O(turns · (coils + parallel)).
std::vector<Turn> turns_of(const std::vector<LayingRegions>& coils, const NeedleLayout& layouts, std::size_t turns,
                           double radius, std::size_t parallel = 1);

}  // namespace bahnwerk::winding
