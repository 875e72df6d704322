#pragma once
/// Wires in a slot: their centres in the order in which they are laid.
#include <vector>

#include "core/base/named.hpp"
#include "core/geometry/region/point.hpp"

namespace bahnwerk::winding {

enum class Algorithm { orthocyclic_base, orthocyclic_flank, raabe, potential, needle };
inline constexpr Named<Algorithm> algorithms[] = {{Algorithm::orthocyclic_base, "orthocyclic_base"},
                                                  {Algorithm::orthocyclic_flank, "orthocyclic_flank"},
                                                  {Algorithm::raabe, "raabe"},
                                                  {Algorithm::potential, "potential"},
                                                  {Algorithm::needle, "needle"}};

struct Layout {
  std::vector<Point> wires;
  /// The point to which each wire was pulled when it was laid; empty: the slot's tension point for all.
  std::vector<Point> tension_points;
};

}  // namespace bahnwerk::winding
