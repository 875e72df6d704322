#pragma once
/// The possible centres of wires of one radius, for the many queries of a packing search. A square grid stores which
/// cells are certainly inside and which boundary pieces can be the nearest one in the others; a query costs 5 … 30 ns.
/// Lengths mm.
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/region/region.hpp"

namespace bahnwerk::winding {

class CentreArea {
 public:
  /// Contains all points of `usable_area` at least `radius` away from its boundary: areas, and the lines and points of
  /// exact fits. O((edges of usable area)²) and 4096 distances. Reports stage "potential".
  CentreArea(const Region& usable_area, double radius, Progress progress);

  bool empty() const { return edges_.empty(); }
  const Region& region() const { return region_; }  ///< the areas
  const Box& box() const { return box_; }
  /// Returns the borders of the areas, and the lines of exact fits; a point is a line without length.
  std::span<const Edge> edges() const { return edges_; }
  /// Returns the vector from `p` to the nearest possible centre; zero if `p` is one itself. Its squared length is
  /// differentiable in the corners of the usable area, unlike the distance from the nearest wall.
  Point way_in(Point p) const {
    const auto column = static_cast<int>(std::clamp((p.x - low_.x) * per_cell_, 0.0, last_column_));
    const auto row = static_cast<int>(std::clamp((p.y - low_.y) * per_cell_, 0.0, last_row_));
    const std::size_t cell =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
    return inside_[cell] ? Point{} : way_in(p, cell);
  }
  bool holds(Point p) const { return way_in(p) == Point{}; }
  /// Returns points of the usable area and its boundary at most about `pitch` apart, in a fixed order.
  std::vector<Point> spread(double pitch) const;

 private:
  struct Piece {
    Point from, to, centre, along;
    double radius = 0, length = 0;
    double side = 0;  ///< +1: the usable area is inside the arc's circle, −1: outside
    bool over_half = false;
    bool thin = false;                   ///< whether it bounds no area: an exact fit
    int corner_from = 0, corner_to = 0;  ///< −1: projects into the usable area, +1: does not, 0: smooth
  };
  struct Hit {
    double square = 0;
    Point at;
    bool inside = false;
  };
  Hit nearest(Point p, std::span<const std::uint32_t> among) const;
  Point way_in(Point p, std::size_t cell) const;

  Region region_;
  std::vector<Edge> edges_;
  Box box_;
  std::vector<Piece> pieces_;
  Point low_;
  double per_cell_ = 1, last_column_ = 0, last_row_ = 0;
  int columns_ = 0;
  std::vector<std::uint8_t> inside_;          ///< whether all of a cell lies inside
  std::vector<std::uint32_t> first_, among_;  ///< pieces of cell i: among_[first_[i] … first_[i+1])
};

}  // namespace bahnwerk::winding
