#pragma once
/// The obstacles of the needle as signed distances: positive outside, negative inside, 1-Lipschitz. Lengths mm, angles
/// rad.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/winding/needle/solid.hpp"
#include "core/winding/part/part.hpp"
#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {

/// Lower bounds of the distance: of all points, of those above and below, and of those at one height.
struct Distances {
  double whole, section, height;
};

class Obstacle {
 public:
  virtual ~Obstacle() = default;
  virtual double distance(Vec3 p) const = 0;
  /// Tells whether the obstacle is convex: then distance() is convex along every line.
  virtual bool convex() const { return false; }
  /// Returns for a convex obstacle a unit vector n such that all of it lies behind the plane normal to n at distance(p)
  /// before `p`, inside as well as outside.
  virtual Vec3 away(Vec3) const { return {}; }
  /// Returns a lower bound of distance() for all points above and below `p`; it decides long straight moves along the
  /// part's axis at once.
  virtual double section_distance(Vec3) const { return -std::numeric_limits<double>::infinity(); }
  /// Returns a lower bound of distance() for all points at the height of `p`; it decides arcs above the part's end.
  virtual double height_distance(Vec3) const { return -std::numeric_limits<double>::infinity(); }
  /// Returns all three at once.
  virtual Distances distances(Vec3 p) const { return {distance(p), section_distance(p), height_distance(p)}; }
  /// Returns the obstacle as a prism whose arcs are chords within `tolerance` mm of them; all points of it that are
  /// farther than that from its surface are where distance() is negative.
  virtual Solid solid(double tolerance) const = 0;

 protected:
  /// Returns the distances of a section that extends from one height to another.
  static Distances extruded(double section, double beyond) {
    if (section >= 0) return {beyond > 0 ? std::hypot(section, beyond) : section, section, beyond};
    return {beyond > 0 ? beyond : std::max(section, beyond), section, beyond};
  }
};

/// A stator's stack: slots, tooth tips, bore. The tips end in half circles of the radius r_et about points b_t apart,
/// which leaves b_t − 2 r_et between them. All slots are open; between neighbouring slots only the tooth's face
/// matters, whose distance is equal from either side, so the slot nearest to a point decides.
class StatorIron final : public Obstacle {
 public:
  /// `slot` is checked_slot(part).
  StatorIron(const StatorPart& part, const Slot& slot);
  double distance(Vec3 p) const override { return distances(p).whole; }
  Distances distances(Vec3 p) const override { return extruded(section_distance(p), height_distance(p)); }
  double section_distance(Vec3 p) const override;
  /// Returns the distance in a section as if the slot with its middle at azimuth `slot` alone were open: beyond the
  /// middles of the teeth beside it, it is the distance at these.
  double section_distance(Vec3 p, double slot) const;
  double height_distance(Vec3 p) const override { return std::max(-p.z, p.z - stack_); }
  Solid solid(double tolerance) const override;
  /// Returns slot, opening and bore together, in slot coordinates.
  const Region& air() const { return air_; }

 private:
  double local_distance(double from_axis, double angle) const;

  Region air_;
  double axis_, pitch_, stack_;
};

/// A stator's or rotor's iron in which one slot alone is open. `Iron` has section_distance(p, slot).
template <class Iron>
class OneSlot final : public Obstacle {
 public:
  /// `iron` has to outlive the object; `slot` is the azimuth of the slot's middle.
  OneSlot(const Iron& iron, double slot) : iron_(iron), slot_(slot) {}
  double distance(Vec3 p) const override { return distances(p).whole; }
  Distances distances(Vec3 p) const override { return extruded(section_distance(p), height_distance(p)); }
  double section_distance(Vec3 p) const override { return iron_.section_distance(p, slot_); }
  double height_distance(Vec3 p) const override { return iron_.height_distance(p); }
  /// Returns the iron with all its slots.
  Solid solid(double tolerance) const override { return iron_.solid(tolerance); }

 private:
  const Iron& iron_;
  double slot_;
};

/// A block across a radius, such as a winding tool's post.
class Block final : public Obstacle {
 public:
  /// The extent of a block, mm.
  struct Extent {
    double inner, outer;  ///< distances from the axis, along the radius
    double left, right;   ///< distances from the radius, across it, counterclockwise positive
    double low, high;     ///< heights, along the axis
  };
  /// The block is about the radius at `azimuth`, rad.
  Block(double azimuth, const Extent& extent);
  double distance(Vec3 p) const override;
  bool convex() const override { return true; }
  Vec3 away(Vec3 p) const override;
  Solid solid(double tolerance) const override;

 private:
  Rotation outwards_, inwards_;  ///< rotations from the azimuth 0 to the block, and back
  Vec3 middle_, half_;
};

/// The posts of a stator's winding tools; the source gives no sizes for them.
struct ToolPost {
  double width = 4;      ///< width across the radius, mm
  double thickness = 3;  ///< thickness along the radius, inwards from r_WK, mm
  double height = 20;    ///< height above the stack's end, mm
};
/// Returns the four posts of a coil. Throws InvalidInput naming members of "tool".
std::vector<Block> tool_posts(const StatorPart& part, const ToolPost& post, Coil coil);

}  // namespace bahnwerk::winding
