#pragma once
/// The free places of the next wire of one size: centres that are at least `radius` from the boundary of a usable area
/// and twice that from every wire laid so far. That set is bounded by arcs and lines, so a force that draws a wire (to
/// a point, or downwards) takes it to one of finitely many places: a corner of the set, the foot of the attraction
/// point on a border or on the circle around a laid wire, or the point itself. All of them are enumerated, so the
/// result is the global optimum. [Herrmann (4.16)–(4.20)] searches along the wires laid before by local solvers from
/// several starts, and misses places that only walls hold.
///
/// Accuracy: places have both distances to 1e-9 mm; a gap that a wire fills exactly is a place.
///
/// Cost: O(b + c) per wire laid or query, b borders of the usable area, c open corners, at most O(laid wires). Memory
/// is linear in the wires and in the ratio of the usable area to a wire's area.
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/region/region.hpp"

namespace bahnwerk::winding {

class Sites {
 public:
  /// `radius` of the wires, mm, > 0. Reports fraction 0 to `progress`, if there is one.
  Sites(const Region& usable_area, double radius, Progress progress = {});

  /// Adds a wire at `centre`, which need not be free.
  void lay(Point centre);

  bool in_room(Point centre) const;  ///< far enough from the boundary
  bool free(Point centre) const;     ///< far enough from the boundary and from all wires

  /// Returns the free place nearest to `p`; nothing if no place is free. Of places equally near within 1e-9 mm it is
  /// the one with the least x, then least y.
  std::optional<Point> nearest(Point p);
  /// Returns the free place least far along `direction`, a unit vector, with the tie rule of nearest().
  std::optional<Point> least(Point direction);

  std::span<const Point> wires() const { return wires_; }
  /// Returns the borders of a first wire's places: pieces at `radius` from the boundary, in no order.
  std::span<const Edge> borders() const { return borders_; }

 private:
  bool clear_of_wires(Point p) const;
  void open(Point corner);
  /// Calls `visit(wire)` for all wires within `reach` cells of the cell of `p`; stops where that returns false.
  template <class Visit>
  bool around(Point p, int reach, Visit visit) const;
  template <class Cost>
  std::optional<Point> best(Cost cost) const;

  Region usable_area_;
  double radius_, apart_;
  std::vector<Edge> borders_;
  std::vector<Point> corners_;  ///< free corners of the set of places
  std::vector<Point> feet_;     ///< free places that depend on the query
  std::vector<Point> wires_;
  // Wires by cells as lists: the first in each cell, the next after each wire.
  double cell_;
  int columns_, rows_;
  std::vector<int> first_, next_;
};

}  // namespace bahnwerk::winding
