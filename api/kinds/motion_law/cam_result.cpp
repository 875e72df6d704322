#include "api/kinds/motion_law/cam_result.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

namespace bahnwerk::api::motion_law {
namespace {

using cam::CamExtreme;
using cam::CamType;
using nlohmann::ordered_json;

constexpr double degree = std::numbers::pi / 180;

ordered_json figure(const CamExtreme& extreme, double unit = 1) {
  double at = extreme.at / degree;
  at -= 360 * std::floor(at / 360);
  return {{"value", extreme.value / unit}, {"at", at}};
}
ordered_json figure(const std::optional<CamExtreme>& extreme) { return extreme ? figure(*extreme) : ordered_json(); }
ordered_json number(bool known, double value) { return known ? ordered_json(value) : ordered_json(); }

ordered_json nurbs(const NurbsPath& curve) {
  ordered_json points = ordered_json::array();
  for (const HomogeneousPoint& p : curve.points) points.push_back({p[0], p[1]});
  return {{"degree", curve.degree}, {"points", std::move(points)}, {"knots", curve.knots}};
}

/// A job that runs along a curve; its machine is an example.
ordered_json contour_job(const NurbsPath& curve, const char* name) {
  const ordered_json axis{{"velocity", 500}, {"acceleration", 5000}, {"jerk", nullptr}};
  const ordered_json block{{"mode", "cut"}, {"feed", nullptr}, {"segments", {{{"nurbs", nurbs(curve)}}}}};
  const auto& begin = curve.points.front();
  return {{"kind", "contour"},
          {"name", name},
          {"spec",
           {{"contour", {{"start", {begin[0], begin[1]}}, {"blocks", {block}}}},
            {"machine", {{"kinematics", "cartesian"}, {"axes", {{"x", axis}, {"y", axis}}}, {"cycle_time", 0.001}}},
            {"planning", {{"method", "time_optimal"}}}}}};
}

/// Pitch radius of curvature where the sign of the curvature is right.
ordered_json pitch_radius(const CamExtreme& curvature) {
  const double most = std::abs(curvature.value);
  return most > 1e-12 ? figure({1 / most, curvature.at}) : ordered_json();
}

}  // namespace

ordered_json cam_result(const CamPlan& plan) {
  const cam::CamGeometry& g = plan.geometry;
  const cam::CamFigures& f = plan.figures;
  const bool roller = g.has_roller(), barrel = g.type == CamType::barrel;
  ordered_json out{{"type", name_of<CamType>(g.type, cam::cam_types)},
                   {"follower", name_of<cam::FollowerType>(g.follower, cam::follower_types)},
                   {"base_radius", f.base_radius},
                   {"least_base_radius", plan.least ? ordered_json(plan.least->base_radius) : ordered_json()},
                   {"excluded_base_radius", plan.least ? ordered_json(plan.least->excluded) : ordered_json()}};
  out["pressure_angle"] =
      roller ? ordered_json{{"max", figure(f.pressure_angle, degree)}, {"min", figure(f.pressure_angle_back, degree)}}
             : ordered_json();
  out["pitch_radius"] =
      roller ? ordered_json{{"convex", f.pitch_curvature.value > 0 ? pitch_radius(f.pitch_curvature) : ordered_json()},
                            {"concave",
                             f.pitch_curvature_back.value < 0 ? pitch_radius(f.pitch_curvature_back) : ordered_json()}}
             : ordered_json();
  out["profile_radius"] = figure(f.profile_radius);
  out["concave_radius"] = figure(f.concave_radius);
  out["undercut"] = !(f.undercut_bound < 0);
  out["face_width"] = number(!roller, f.face_width);
  out["stress"] = f.contact ? figure(f.contact->stress) : ordered_json();
  out["force"] = f.contact
                     ? ordered_json{{"max", figure(f.contact->most_force)}, {"min", figure(f.contact->least_force)}}
                     : ordered_json();
  out["tolerance"] = g.tolerance;
  out["profile"] = nurbs(plan.profile);
  out["other_flank"] = plan.other_flank ? nurbs(*plan.other_flank) : ordered_json();
  out["pitch_curve"] = roller ? nurbs(plan.pitch) : ordered_json();
  out["contour"] = barrel ? contour_job(plan.pitch, "centre line of a barrel cam's groove, unrolled")
                          : contour_job(plan.profile, "profile of a radial cam");
  return out;
}

}  // namespace bahnwerk::api::motion_law
