#pragma once
/// Drawings as SVG: a slot with its wires, fill factors over wires. Self-contained files on a white background.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/winding/layout/layout.hpp"
#include "core/winding/slot/slot.hpp"

namespace bahnwerk::winding {

struct DrawnWires {
  std::string title;
  double radius = 0;                          ///< mm, radius of a wire with its enamel
  double copper = 0;                          ///< mm, diameter of the conductor
  std::vector<Point> wires;                   ///< centres of the wires in laying order
  std::vector<std::size_t> slipping;          ///< indices of wires that do not stay where they are laid
  std::optional<std::size_t> unreached = {};  ///< index of the first wire that the needle cannot lay
  bool numbered = true;                       ///< whether wires that are large enough are numbered
  /// Direction of the rows of a lattice, rad; every row is then a layer, counted from the first wire's.
  std::optional<double> rows = {};
};

/// Draws the slot's outline, the usable area and the wires, coloured by layers counted from the base and numbered in
/// laying order; a wire that slips is crossed out in red, one out of the needle's reach is ringed. A legend and a scale
/// are beside it.
std::string slot_drawing(const Slot& slot, const DrawnWires& drawn);

/// Returns the layers of a triangular lattice: the row of each wire, counted from the first wire's row.
std::vector<int> lattice_layers(double radius, double rows, std::span<const Point> wires);

/// Returns the layers from the base: wires that touch what supports the base layer are 0, those that touch them 1, and
/// so on.
std::vector<int> layers(const Region& usable_area, double radius, std::span<const Point> wires);

struct FillCurve {
  Algorithm algorithm;
  struct Value {
    double copper = 0, electrical = 0, mechanical = 0;
  };
  std::vector<Value> values;
  std::string enamel = {};  ///< enamel of all its wires; curves of different enamels have different marks
};
/// Draws the electrical (solid) and mechanical (dashed) fill factor over the copper diameter. Each curve's values are
/// joined in the order of their diameters.
std::string fill_chart(std::span<const FillCurve> curves, const std::string& title);

}  // namespace bahnwerk::winding
