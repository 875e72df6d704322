#pragma once
/// Where the next wire of one size may lie: the centres that keep `radius` from the boundary of a usable area and twice
/// that from every wire laid so far. That set is bounded by arcs and lines, so whatever draws a wire (to a point,
/// downwards) takes it to one of finitely many places: a corner of the set, the foot of the attraction point on a
/// border or on the circle around a laid wire, or the point itself. They are all enumerated: the place found is the
/// global optimum. [Herrmann (4.16)–(4.20)] searches along the wires laid before by local solvers from several starts,
/// and misses places that only walls hold.
///
/// Accuracy: places keep both distances to 1e-9 mm; a gap that a wire fills exactly is a place.
///
/// Cost: O(b + c) per wire laid or asked for, b borders of the usable area, c open corners, at most O(laid wires).
/// Memory is linear in the wires and in the usable area's area in terms of a wire's.
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/region/region.hpp"

namespace bahnwerk::winding {

class Sites {
 public:
  /// `radius` of the wires, mm, > 0. Reports fraction 0 to `progress`, if there is one.
  Sites(const Region& usable_area, double radius, Progress* progress = nullptr);

  /// A wire lies at `centre` from now on; it need not be free.
  void lay(Point centre);

  bool in_room(Point centre) const;  ///< far enough from the boundary
  bool free(Point centre) const;     ///< far enough from the boundary and from all wires

  /// The free place nearest to `p`; nothing if no place is free. Of places equally near within 1e-9 mm the one with the
  /// least x, then least y.
  std::optional<Point> nearest(Point p);
  /// The free place that lies least far along `direction`, a unit vector. Ties as above.
  std::optional<Point> least(Point direction);

  std::span<const Point> wires() const { return wires_; }
  /// What bounds the places of a first wire: pieces at `radius` from the boundary, in no order.
  std::span<const Edge> borders() const { return borders_; }

 private:
  bool clear_of_wires(Point p) const;
  void open(Point corner);
  /// Calls `visit(wire)` for all wires within `reach` cells of the one that holds `p`; stops where that returns false.
  template <class Visit>
  bool around(Point p, int reach, Visit visit) const;
  template <class Cost>
  std::optional<Point> best(Cost cost) const;

  Region usable_area_;
  double radius_, apart_;
  std::vector<Edge> borders_;
  std::vector<Point> corners_;  ///< free corners of the set of places
  std::vector<Point> feet_;     ///< free places that depend on what is asked for
  std::vector<Point> wires_;
  // Wires by cells as lists: the first in each cell, the next after each wire.
  double cell_;
  int columns_, rows_;
  std::vector<int> first_, next_;
};

}  // namespace bahnwerk::winding
