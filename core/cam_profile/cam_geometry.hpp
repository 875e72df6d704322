#pragma once
/// What a designer gives of a mechanical cam [VDI 2142, VDI 2143; Norton, "Cam Design and Manufacturing Handbook"].
///
/// Radial cam: it turns about the origin. A translating follower moves along +y at x = `offset`; an oscillating one
/// turns about (`distance`, 0) with its roller at the end of `arm`; the face of a flat one is parallel to x and moves
/// along +y. Barrel cam: a groove in a cylinder; the follower moves parallel to the axis. Lengths in mm, angles in rad.
#include <optional>

#include "core/base/named.hpp"

namespace bahnwerk::cam {

enum class CamType { radial, barrel };
inline constexpr Named<CamType> cam_types[] = {{CamType::radial, "radial"}, {CamType::barrel, "barrel"}};
enum class FollowerType { translating, oscillating, flat };
inline constexpr Named<FollowerType> follower_types[] = {{FollowerType::translating, "translating"},
                                                         {FollowerType::oscillating, "oscillating"},
                                                         {FollowerType::flat, "flat"}};

/// Elastic constants of a material.
struct ElasticMaterial {
  double modulus = 210000;  ///< Young's modulus E, N/mm²
  double poisson = 0.3;     ///< ν
};

/// What presses the follower on the cam. The force along the follower's motion at its roller, or at its face, is
/// force + spring · displacement + mass · acceleration, the displacement counted from the lowest position.
struct CamContact {
  double force = 0;   ///< N, at the lowest position
  double spring = 0;  ///< N/mm
  double mass = 0;    ///< kg, reduced to the roller
  double width = 0;   ///< mm, of the line of contact
  ElasticMaterial cam, follower;
  std::optional<double> stress;  ///< largest allowed Hertz pressure, N/mm²
};

struct CamGeometry {
  CamType type = CamType::radial;
  FollowerType follower = FollowerType::translating;
  bool clockwise = false;  ///< sense in which the cam turns
  /// Radius of the base circle, on which the profile touches the follower at the law's lowest position; of the cylinder
  /// for a barrel cam. None: the least one that keeps `pressure_angle` and `profile_radius`.
  std::optional<double> base_radius;
  double roller_radius = 0;      ///< 0: a knife edge
  double offset = 0;             ///< distance of a translating follower's line from the cam's axis, mm
  double arm = 0, distance = 0;  ///< length of an oscillating follower, distance of its pivot from the cam's axis, mm
  std::optional<double> pressure_angle;  ///< largest allowed |α|
  double profile_radius = 0;             ///< least allowed radius of curvature where the profile is convex
  double tolerance = 1e-3;               ///< largest distance of the published curve from the exact profile
  std::optional<CamContact> contact;

  double turn() const { return clockwise ? -1 : 1; }
  bool has_roller() const { return follower != FollowerType::flat; }
};

/// Returns what it is for people: "radial cam with an oscillating follower".
inline const char* name_of_cam(const CamGeometry& g) {
  if (g.type == CamType::barrel) return "barrel cam with a translating follower";
  return g.follower == FollowerType::flat          ? "radial cam with a flat follower"
         : g.follower == FollowerType::oscillating ? "radial cam with an oscillating follower"
                                                   : "radial cam with a translating follower";
}

}  // namespace bahnwerk::cam
