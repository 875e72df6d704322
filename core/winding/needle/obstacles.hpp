#pragma once
/// What the needle must not touch, as signed distances: positive outside, negative inside, changing by at most 1 mm per
/// mm. Lengths mm, angles rad.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/winding/part/part.hpp"
#include "core/winding/part/space.hpp"

namespace bahnwerk::winding {

/// What bounds the distance of all points, of those above and below, and of those at the same height.
struct Distances {
  double whole, section, height;
};

class Obstacle {
 public:
  virtual ~Obstacle() = default;
  virtual double distance(Space p) const = 0;
  /// Whether the obstacle is convex: then distance() is convex along every line.
  virtual bool convex() const { return false; }
  /// Of a convex one: a unit vector n so that all of it lies behind the plane normal to n that is distance(p) before
  /// `p`, inside as outside.
  virtual Space away(Space) const { return {}; }
  /// A lower bound of distance() for all points above and below `p`: long straight moves along the part's axis are
  /// decided by it at once.
  virtual double section_distance(Space) const { return -std::numeric_limits<double>::infinity(); }
  /// The same for all points at the height of `p`: arcs above the part's end are decided by it.
  virtual double height_distance(Space) const { return -std::numeric_limits<double>::infinity(); }
  /// All three at once.
  virtual Distances distances(Space p) const { return {distance(p), section_distance(p), height_distance(p)}; }

 protected:
  /// Of a section that reaches from one height to another.
  static Distances extruded(double section, double beyond) {
    if (section >= 0) return {beyond > 0 ? std::hypot(section, beyond) : section, section, beyond};
    return {beyond > 0 ? beyond : std::max(section, beyond), section, beyond};
  }
};

/// A stator's stack: slots, tooth tips, bore. The tips end in half circles of the radius r_et about points b_t apart,
/// which leaves b_t − 2 r_et between them. All slots are open; of one next to another only the tooth's face matters,
/// whose distance is the same from either side, so that the slot nearest to a point decides.
class StatorIron final : public Obstacle {
 public:
  /// `slot` is checked_slot(part).
  StatorIron(const StatorPart& part, const Slot& slot);
  double distance(Space p) const override { return distances(p).whole; }
  Distances distances(Space p) const override { return extruded(section_distance(p), height_distance(p)); }
  double section_distance(Space p) const override;
  double height_distance(Space p) const override { return std::max(-p.z, p.z - stack_); }
  /// Slot, opening and bore together, in slot coordinates.
  const Region& air() const { return air_; }

 private:
  Region air_;
  double axis_, pitch_, stack_;
};

/// A block that stands across a radius, as a winding tool's post does.
class Block final : public Obstacle {
 public:
  /// About the point at `azimuth`: from `inner` to `outer` mm along the radius there, from `left` to `right` mm across
  /// it (counterclockwise positive), from `low` to `high` along the axis.
  Block(double azimuth, double inner, double outer, double left, double right, double low, double high);
  double distance(Space p) const override;
  bool convex() const override { return true; }
  Space away(Space p) const override;

 private:
  Rotation outwards_, inwards_;  ///< from the azimuth 0 to the block, and back
  Space middle_, half_;
};

/// The posts of the winding tools that a stator's wires lie behind; the source gives none of their own sizes.
struct ToolPost {
  double width = 4;      ///< across the radius, mm
  double thickness = 3;  ///< along the radius, inwards from r_WK, mm
  double height = 20;    ///< from the stack's end, mm
};
/// The four posts of a coil. Throws InvalidInput naming members of "tool".
std::vector<Block> tool_posts(const StatorPart& part, const ToolPost& post, Coil coil);

}  // namespace bahnwerk::winding
