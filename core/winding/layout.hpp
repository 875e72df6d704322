#pragma once
/// Wires in a slot: their centres in the order in which they are laid.
#include <vector>

#include "core/winding/point.hpp"

namespace bahnwerk::winding {

enum class Algorithm { orthocyclic_base, orthocyclic_flank, raabe, potential, needle };

struct Layout {
  std::vector<Point> wires;
  /// Where each wire was pulled to when it was laid; empty: the slot's own point for all.
  std::vector<Point> pulls;
};

}  // namespace bahnwerk::winding
