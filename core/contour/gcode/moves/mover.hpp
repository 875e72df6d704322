#pragma once
/// The moves of a part program, in mm, as segments of a contour.
#include <limits>
#include <optional>

#include "core/contour/builder.hpp"

namespace bahnwerk::gcode {

/// Plane of arcs by its normal: G17 z, G18 y, G19 x. Seen against the normal, G3 turns counter-clockwise.
enum class Plane { xy, zx, yz };

/// The manner of an arc.
struct ArcMove {
  Plane plane = Plane::xy;
  bool counter_clockwise = false;
  std::size_t turns = 1;    ///< P: number of turns including the last one, which may be partial
  double tolerance = 0.01;  ///< allowed difference of the radii, mm
};

/// Returns the centre of an arc of |radius|, negative for more than half a turn; nothing, with the reason in `why`, if
/// there is none.
std::optional<Vec> centre_by_radius(Vec from, Vec to, double radius, const ArcMove& how, const char*& why);
/// Distances of an arc's ends from its centre, in its plane, mm.
struct RadiiOfArc {
  double begin, end;
};
RadiiOfArc radii_of_arc(Vec from, Vec to, Vec centre, Plane plane);

/// An arc of more than half a turn whose radii differ, as two arcs. They begin and end perpendicular to the radii at
/// the ends and meet in the middle with one tangent. Both stay within the difference of the radii from the spiral
/// between them, where a single arc would move its centre far to reach both ends.
struct ArcHalves {
  Vec middle, first, second;  ///< meeting point (at the mean height), and the centres
};
/// Returns nothing where a single arc moves its centre by less than the difference of the radii.
std::optional<ArcHalves> halves_of_arc(Vec from, Vec to, Vec centre, const ArcMove& how);

/// Returns the length in mm, all turns of a helix included.
double arc_length(Vec from, Vec to, Vec centre, const ArcMove& how);

/// Appends moves to a contour.
class Mover {
 public:
  /// `flat` sets every height to 0, for a contour that stays at one height.
  explicit Mover(bool flat) : builder_(2, {}, "gcode"), flat_(flat) {}

  /// Sets mode and feed (mm/s) of the next moves. A change begins a new block.
  void use(Mode mode, double feed);
  /// Declares that earlier moves did not cut, because the program uses a switch for the first time.
  void first_switch();

  /// Sets the head's position before the first move, if that is known or assumed.
  void place(Vec at);
  /// Starts the contour at a point, without a move from the position before.
  void start(Vec at);
  bool started() const { return started_; }
  void line(Vec to);
  void arc(Vec to, Vec centre, ArcMove how);
  /// Appends a Bézier curve of degree 3, or of degree 2 without a second control point.
  void spline(Vec to, Vec first, std::optional<Vec> second);

  /// Adds a rest of `seconds` at the head's position, in a block of this mode.
  void dwell(Mode mode, double seconds);

  Vec position() const { return at_; }  ///< programmed position of the head, mm
  bool climbs() const { return climbs_; }
  ContourBuilder& builder() { return builder_; }
  /// Throws InvalidInput.
  Contour finish();

 private:
  void begin_block();
  static void join_blocks(Contour& contour);
  Vec placed(Vec p) const { return flat_ ? Vec{p.x, p.y, 0} : p; }
  void go(Vec to);

  ContourBuilder builder_;
  Vec at_;
  Mode mode_ = Mode::cut;
  double feed_ = std::numeric_limits<double>::infinity();
  std::size_t positioning_ = 0;  // number of blocks before the first switch
  bool new_block_ = true, flat_, started_ = false, climbs_ = false;
};

}  // namespace bahnwerk::gcode
