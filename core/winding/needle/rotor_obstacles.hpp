#pragma once
/// The obstacles of the needle when it winds a rotor: poles with their shoes, the hub between them, end caps with their
/// walls. Lengths mm, angles rad.
#include <algorithm>
#include <vector>

#include "core/winding/needle/obstacles.hpp"

namespace bahnwerk::winding {

/// Sizes that the parameters of slot and heads do not determine; [Herrmann] gives none.
struct RotorShape {
  double shoe_edge = 0;      ///< radial thickness of the pole shoe at its edges, mm
  double outer_wall = 0;     ///< height of the end cap's wall at the pole shoe above the cap's grooves, mm; 0: none
  double wall_overhang = 0;  ///< width of the cap's walls beyond the flanks below them, on each side, mm
};

/// Poles and hub over the stack and the part of both end caps below the grooves. In the section of a pole these are the
/// slot's outline on both sides, a circle about the axis through the outer ends of the shoe's flanks (or their edges),
/// and the hub's circle through the inner ends of the root's flanks. Poles are equal and symmetric, so the one nearest
/// in azimuth decides.
class RotorIron final : public Obstacle {
 public:
  /// `slot` is checked_slot(part). Throws InvalidInput naming members of "rotor", and slot.root_flank where the
  /// flanks reach into the hub or beyond the shoe.
  RotorIron(const RotorPart& part, const Slot& slot, const RotorShape& shape = {});
  double distance(Vec3 p) const override { return distances(p).whole; }
  Distances distances(Vec3 p) const override { return extruded(section_distance(p), height_distance(p)); }
  double section_distance(Vec3 p) const override;
  /// Returns the distance in a section as if the slot with its middle at azimuth `slot` alone were open: beyond the
  /// middles of the poles beside it, it is the distance at these.
  double section_distance(Vec3 p, double slot) const;
  double height_distance(Vec3 p) const override { return std::max(low_ - p.z, p.z - high_); }
  Solid solid(double tolerance) const override;
  /// Returns one pole and the whole hub; x along the pole's middle from the rotor's axis, y across it.
  const Region& iron() const { return iron_; }

 private:
  Region iron_;
  double pitch_, low_, high_;
};

/// A convex section, in the plane of radius and axis at one azimuth, that extends straight across that plane.
class Wall final : public Obstacle {
 public:
  /// `section` counterclockwise and convex: x the radius, y the height along the part's axis.
  Wall(double azimuth, Region section, double half_width);
  double distance(Vec3 p) const override;
  bool convex() const override { return true; }
  Vec3 away(Vec3 p) const override;
  Solid solid(double tolerance) const override;

 private:
  Rotation outwards_, inwards_;
  double half_width_;
  Region section_;
};

/// Returns the walls of both end caps at every pole, below and above: inner ones, which continue the root's flank from
/// the cap's grooves to its height and are taken as solid down to the axis, and outer ones on the shoe if the shape has
/// any. They are as wide as the flanks below them. The source gives no outer wall; its needle, which crosses the cap
/// while its tip passes the wires, (4.28) and (4.29), leaves no room for one. Throws InvalidInput naming members of
/// "rotor".
std::vector<Wall> cap_walls(const RotorPart& part, const Slot& slot, const RotorShape& shape = {});

}  // namespace bahnwerk::winding
