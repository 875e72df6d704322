#pragma once
/// An edge of a boundary: a straight line or an arc of a circle.
#include <vector>

#include "core/geometry/region/point.hpp"

namespace bahnwerk {

/// A rectangle with sides along the axes.
struct Box {
  Point low, high;
};

/// A straight line, or an arc if `radius` > 0.
struct Edge {
  Point from, to;     ///< ends, mm
  Point centre;       ///< centre of an arc, mm
  double radius = 0;  ///< radius of an arc, mm; 0: the edge is a straight line
  double turn = 0;    ///< angle of an arc, rad: positive counterclockwise, at most a full circle

  bool straight() const { return radius == 0; }
  double length() const;
  Point at(double fraction) const;         ///< returns the point at a fraction 0 … 1 of the length
  Point direction(double fraction) const;  ///< returns the unit tangent there
  /// Returns the fraction of the point of the edge that is nearest to `p`, in [0, 1].
  double nearest(Point p) const;
  /// Returns the part between two fractions.
  Edge part(double first, double last) const;
  Edge reversed() const;
  /// Returns twice the area between the edge and the origin, counterclockwise positive; a loop's sum is twice its area.
  double doubled_area() const;
};

Edge line(Point from, Point to);
/// Returns an arc from the angle `start` rad over `turn` rad (positive counterclockwise).
Edge arc(Point centre, double radius, double start, double turn);
/// Returns the arc about `centre` from one point to another on its circle, at most one turn.
Edge arc_between(Point centre, Point from, Point to, bool counterclockwise);

/// Returns a box that contains the edge and `more` mm around it; around arcs it may be larger.
Box extent(const Edge& edge, double more);

/// A common point of two edges, as fractions of each.
struct Meeting {
  double first = 0, second = 0;
};
/// Returns the meetings of two edges, at most two; lines that overlap have none.
std::vector<Meeting> meetings(const Edge& a, const Edge& b);

}  // namespace bahnwerk
