#pragma once
/// The region inside a boundary of lines and arcs: a slot, or its part without liner and wedge. Distances, areas and
/// offsets are exact up to rounding; no arc is replaced by chords.
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/region/edge_tree.hpp"

namespace bahnwerk {

/// Number of edges from which it saves time to compute first where parallels are needed, and to intersect them then.
inline constexpr std::size_t many_edges = 200;

/// A region by its boundary.
class Region {
 public:
  Region() = default;
  /// Takes one or more closed loops of consecutive edges, the region on their left. Ends may miss by 1e-6 mm. Throws
  /// std::invalid_argument if a loop does not close.
  explicit Region(std::vector<Edge> edges);

  /// The nearest point of the boundary: `distance` is positive inside, `normal` the unit vector into the region.
  struct Nearest {
    double distance = 0;
    Point at, normal;
    std::size_t edge = 0;
  };
  Nearest nearest(Point p) const;  ///< nearest point of the boundary; among equally near ones that of the first edge
  double distance(Point p) const { return nearest(p).distance; }

  bool empty() const { return edges_.empty(); }
  double area() const;    ///< area, mm²
  double length() const;  ///< length of the boundary, mm
  const Box& box() const { return box_; }
  std::span<const Edge> edges() const { return edges_; }
  /// Returns whether the boundary turns to the right (more than 1e-9) where edge `i` begins: a corner that projects
  /// into the region.
  bool juts_at(std::size_t i) const { return corner_[i] < 0; }
  bool recedes_at(std::size_t i) const { return corner_[i] > 0; }
  std::size_t before(std::size_t i) const { return before_[i]; }
  /// Returns whether edge `i` is the first of its loop.
  bool begins_loop(std::size_t i) const { return before_[i] >= i; }

  /// Returns every edge moved by `depth` into the region, with arcs about the corners at which that opens gaps.
  /// Trimmed, they bound inward(depth).
  std::vector<Edge> parallels(double depth) const;
  /// Returns for each parallel a box that contains all of its points at `depth` inside the boundary. The other parts of
  /// parallels of many short edges would cross each other up to n² times. Computes a few distances per parallel and
  /// reports fraction 0 to `progress`, if given.
  std::vector<Box> reached(const std::vector<Edge>& parallels, double depth, Progress progress = {}) const;
  /// Returns the areas of all points at least `depth` inside the boundary: several loops where a neck closes, empty
  /// where nothing remains. Remaining lines and points are left out (see centre_borders). A negative depth widens the
  /// region, around its corners by arcs. O(n²) for n edges.
  Region inward(double depth, Progress progress = {}) const;
  /// Returns the difference of this region and `other`. Boundaries must not coincide along a part. O(n·m).
  Region without(const Region& other) const;

 private:
  std::vector<Edge> edges_;
  std::vector<std::size_t> before_, after_;
  std::vector<int> corner_;  ///< corner at the beginning of each edge: +1 turns left, 0 smooth, −1 turns right
  EdgeTree tree_;

  /// Returns the fraction from which on a straight parallel is far enough from all edges; 1 if nowhere.
  double first_reached(const Edge& parallel, double depth) const;
  Box box_;
};

}  // namespace bahnwerk
