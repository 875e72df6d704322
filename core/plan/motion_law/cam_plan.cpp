#include "core/plan/motion_law/cam_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>

#include "core/base/infeasible_at.hpp"
#include "core/base/progress.hpp"
#include "core/cam_profile/profile_curve.hpp"
#include "core/verify/cam/cam_checks.hpp"
#include "core/verify/cam/law_verifier.hpp"

namespace bahnwerk {
namespace {

using cam::CamCondition;
using cam::CamType;
using cam::FollowerType;

constexpr double degree = std::numbers::pi / 180;

std::string number(double value, double smallest = 0) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", std::abs(value) < smallest ? 0 : value);
  return text;
}

[[noreturn]] void refuse(const char* member, const std::string& message) {
  throw InfeasibleAt("the cam is not possible: " + message, {{{"cam", member}, message}});
}

class CamPlanner {
 public:
  CamPlanner(const cam::CamGeometry& geometry, LawPlan& plan, Progress progress)
      : g_(geometry),
        plan_(plan),
        progress_(progress),
        law_(plan.solution.law, oscillates() ? degree : 1),
        conditions_(cam::cam_conditions(geometry)) {}

  CamPlan run() {
    if (!(law_.stroke() > 0)) refuse("type", "the follower does not move");
    joins();
    CamPlan out;
    out.geometry = g_;
    if (g_.pressure_angle || g_.profile_radius > 0) out.least = least(conditions_);
    if (!g_.base_radius && !out.least)
      refuse("base_radius", "no radius keeps the limits of pressure angle and profile; give a larger limit");
    const double radius = g_.base_radius ? *g_.base_radius : out.least->base_radius;
    reaches(radius);
    out.figures = cam::cam_figures(g_, law_, radius, progress_);
    keeps_limits(out);
    keeps_contact(out.figures);
    out.profile = curve(cam::CamCurve::profile, radius);
    out.pitch = curve(cam::CamCurve::pitch, radius);
    if (g_.type == CamType::barrel) out.other_flank = curve(cam::CamCurve::other_flank, radius);
    for (std::size_t i = 0; i < law_.pieces(); ++i) {
      const int parts = std::max(4, static_cast<int>(std::ceil(4 * law_.width(i) / degree)));
      for (int k = 0; k <= parts; ++k)
        out.places.push_back(cam::cam_place(g_, law_, radius, i, static_cast<double>(k) / parts));
    }
    verify(out);
    return out;
  }

 private:
  bool oscillates() const { return g_.type == CamType::radial && g_.follower == FollowerType::oscillating; }
  NurbsPath curve(cam::CamCurve which, double radius) const {
    return cam::cam_curve(g_, law_, radius, which, progress_);
  }
  std::optional<cam::LeastRadius> least(const std::vector<CamCondition>& list) const {
    return cam::least_base_radius(g_, law_, list, progress_);
  }
  const char* radius_name() const { return g_.type == CamType::barrel ? "cylinder" : "base circle"; }
  std::string degrees(double rad) const {
    double angle = rad / degree;
    angle -= 360 * std::floor(angle / 360);
    return number(angle, 1e-9) + " deg";
  }

  /// The pitch curve has a tangent where the law's velocity is continuous, and closes where its position is.
  void joins() const {
    const cam::CamLaw& law = plan_.solution.law;
    double fastest = law.peak(1).value;
    for (std::size_t i = 0; i < law.pieces(); ++i) {
      const std::size_t next = i + 1 < law.pieces() ? i + 1 : 0;
      const double position = std::abs(law.in_piece(i, 1, 0) - law.in_piece(next, 0, 0)),
                   velocity = std::abs(law.in_piece(i, 1, 1) - law.in_piece(next, 0, 1));
      if (position <= 1e-9 * fastest * law.duration() && velocity <= 1e-7 * fastest) continue;
      const double at = law.breaks()[i + 1] * law_.angular_velocity();
      refuse("type", position > 1e-9 * fastest * law.duration()
                         ? "the position at the end of the cycle is not the one at its begin"
                         : "the velocity jumps at " + degrees(at) + ": the profile has a corner there");
    }
  }

  void reaches(double radius) const {
    const double pitch = cam::pitch_radius(g_, radius);
    if (cam::follower_reaches(g_, law_, pitch)) return;
    if (oscillates())
      refuse("base_radius", "the arm does not reach: the roller's centre at the lowest position is " + number(pitch) +
                                " mm from the cam's axis, the arm's length is " + number(g_.arm) +
                                " mm, its pivot is at " + number(g_.distance) + " mm");
    refuse("offset", "the offset is as large as the radius of the pitch circle, " + number(pitch) + " mm");
  }

  /// What keeps a broken limit: the least base radius, and the largest roller.
  void keeps_limits(const CamPlan& out) const {
    const cam::CamFigures& f = out.figures;
    const double radius = f.base_radius;
    if (g_.has_roller() && g_.pressure_angle) {
      const auto& worst =
          f.pressure_angle.value > -f.pressure_angle_back.value ? f.pressure_angle : f.pressure_angle_back;
      if (std::abs(worst.value) > *g_.pressure_angle + 1e-9)
        refuse("base_radius", "the pressure angle is " + number(std::abs(worst.value) / degree) + " deg at " +
                                  degrees(worst.at) + ", the limit is " + number(*g_.pressure_angle / degree) +
                                  " deg: " + enough(out.least));
    }
    const double tightest = f.profile_radius ? f.profile_radius->value : HUGE_VAL;
    const double slack = 1e-9 * cam::pitch_radius(g_, radius);
    if (f.undercut_bound < 0 && tightest >= g_.profile_radius - slack) return;
    const std::string where = degrees(f.profile_radius->at);
    if (!g_.has_roller())
      refuse("base_radius",
             std::string(f.undercut_bound < 0 ? "the profile is too sharp at " : "the profile is undercut at ") +
                 where + ": its radius of curvature is " + number(tightest) + " mm; base_radius has to be " +
                 number(radius - tightest + g_.profile_radius) + " mm at least" +
                 (g_.profile_radius > 0 ? "" : ", and more for a profile without a cusp"));
    // A radius that only just avoids a cusp makes a sharp edge: a twentieth of the roller's radius is left.
    cam::CamGeometry wider = g_;
    wider.profile_radius = std::max(g_.profile_radius, 0.05 * g_.roller_radius);
    wider.pressure_angle.reset();
    const auto found = cam::least_base_radius(wider, law_, cam::cam_conditions(wider), progress_);
    const double pitch = tightest + g_.roller_radius;
    refuse("base_radius",
           std::string(f.undercut_bound < 0 ? "the profile is too sharp at " : "the profile is undercut at ") + where +
               ": the pitch curve's radius of curvature is " + number(pitch) + " mm, the roller's radius " +
               number(g_.roller_radius) + " mm" +
               (g_.profile_radius > 0 ? ", the profile's least radius " + number(g_.profile_radius) + " mm" : "") +
               "; a roller radius below " + number(std::max(0.0, pitch - g_.profile_radius)) +
               " mm keeps it, or: " + enough(found));
  }
  void keeps_contact(const cam::CamFigures& f) const {
    if (!f.contact) return;
    if (!(f.contact->least_force.value > 0))
      refuse("contact", "the follower leaves the cam at " + degrees(f.contact->least_force.at) +
                            ", where the force is " + number(f.contact->least_force.value) +
                            " N: a larger force or spring holds it");
    if (g_.contact->stress && f.contact->stress.value > *g_.contact->stress)
      refuse("contact", "the Hertz pressure is " + number(f.contact->stress.value) + " N/mm² at " +
                            degrees(f.contact->stress.at) + ", the limit is " + number(*g_.contact->stress) +
                            " N/mm²: a wider contact, less force or a larger radius has less");
  }
  std::string enough(const std::optional<cam::LeastRadius>& found) const {
    return found ? std::string("a ") + radius_name() + " of " + number(found->base_radius * (1 + 1e-5)) + " mm keeps it"
                 : std::string("no ") + radius_name() + " keeps it";
  }

  void verify(const CamPlan& out) const {
    CamToVerify seen;
    seen.geometry = g_;
    seen.base_radius = out.figures.base_radius;
    seen.profile = published_curve(out.profile);
    if (out.other_flank) seen.other_flank = published_curve(*out.other_flank);
    seen.pressure_angle = std::max(out.figures.pressure_angle.value, -out.figures.pressure_angle_back.value);
    if (out.figures.profile_radius) seen.profile_radius = out.figures.profile_radius->value;
    if (out.figures.contact) {
      seen.stress = out.figures.contact->stress.value;
      seen.least_force = out.figures.contact->least_force.value;
    }
    verify_cam(published(plan_), seen, progress_, plan_.verification);
  }
  static CamCurveToVerify published_curve(const NurbsPath& curve) {
    CamCurveToVerify out;
    for (std::size_t i = curve.degree; i < curve.knots.size(); i += curve.degree) out.angles.push_back(curve.knots[i]);
    for (const HomogeneousPoint& p : curve.points) out.points.push_back({p[0], p[1]});
    return out;
  }

  const cam::CamGeometry& g_;
  LawPlan& plan_;
  Progress progress_;
  cam::FollowerLaw law_;
  std::vector<CamCondition> conditions_;
};

}  // namespace

CamPlan plan_cam(const cam::CamGeometry& geometry, LawPlan& plan, Progress progress) {
  return CamPlanner(geometry, plan, progress).run();
}

}  // namespace bahnwerk
