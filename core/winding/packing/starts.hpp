#pragma once
/// Layouts from which a packing search begins.
#include <vector>

#include "core/numeric/random.hpp"
#include "core/winding/packing/centre_area.hpp"

namespace bahnwerk::winding {

/// Rows of wires: neighbours in a row are `pitch` apart, rows `height` apart and shifted by half a pitch.
struct Rows {
  Point origin;
  Point along{1, 0};  ///< unit vector
  double pitch = 1, height = 0.8660254037844386;
};
/// Returns all points of `rows` that are possible centres.
std::vector<Point> points_of(const Rows& rows, const CentreArea& usable_area);

/// Direction of an edge at least `least` long, by its chord, with a point of it.
struct Side {
  Point at, along, inwards;
  double length = 0;
};
std::vector<Side> sides(std::span<const Edge> edges, double least);

/// Returns a random layout of about as many wires as fit at `distance`: rows along a random side, rows along two sides
/// that meet halfway between them, or rows in any direction, compressed to a smaller pitch until there are `count` of
/// them. The number may differ.
std::vector<Point> random_rows(const CentreArea& usable_area, const std::vector<Side>& sides, double distance,
                               std::size_t count, Random& random);

/// Returns the largest layout of uncompressed rows, over many directions, shifts and stretches of the rows.
std::vector<Point> best_rows(const CentreArea& usable_area, const std::vector<Side>& sides, double distance,
                             std::size_t trials, Random& random);

}  // namespace bahnwerk::winding
