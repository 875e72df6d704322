#include "api/kinds/motion_law/cam_input.hpp"

#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

namespace bahnwerk::api::motion_law {
namespace {

using cam::CamGeometry;
using cam::CamType;
using cam::FollowerType;
using nlohmann::json;

constexpr double degree = std::numbers::pi / 180;

cam::ElasticMaterial material(const json& contact, const char* name) {
  cam::ElasticMaterial out;
  if (const auto at = contact.find(name); at != contact.end()) {
    out.modulus = at->value("modulus", out.modulus);
    out.poisson = at->value("poisson", out.poisson);
  }
  return out;
}

CamGeometry geometry(const json& cam) {
  CamGeometry g;
  g.type = value_of<CamType>(cam["type"].get<std::string>(), cam::cam_types);
  g.follower = value_of<FollowerType>(cam["follower"].get<std::string>(), cam::follower_types);
  g.clockwise = cam.value("rotation", "counterclockwise") == "clockwise";
  if (const auto at = cam.find("base_radius"); at != cam.end() && !at->is_null()) g.base_radius = at->get<double>();
  g.roller_radius = cam.value("roller_radius", 0.0);
  g.offset = cam.value("offset", 0.0);
  g.arm = cam.value("arm", 0.0);
  g.distance = cam.value("distance", 0.0);
  if (const auto at = cam.find("pressure_angle"); at != cam.end()) g.pressure_angle = at->get<double>() * degree;
  // The least radius without any cusp would make a sharp edge.
  g.profile_radius = cam.value("profile_radius", g.base_radius ? 0.0 : 0.05 * g.roller_radius);
  g.tolerance = cam.value("tolerance", 1e-3);
  if (const auto at = cam.find("contact"); at != cam.end()) {
    cam::CamContact contact;
    contact.force = at->value("force", 0.0);
    contact.spring = at->value("spring", 0.0);
    contact.mass = at->value("mass", 0.0);
    contact.width = (*at)["width"].get<double>();
    contact.cam = material(*at, "cam"), contact.follower = material(*at, "follower");
    if (const auto limit = at->find("stress"); limit != at->end()) contact.stress = limit->get<double>();
    g.contact = contact;
  }
  return g;
}

class Faults {
 public:
  Faults(const json& cam, const CamGeometry& g, const cam::MotionLawProblem& problem, std::vector<InputFault>& out)
      : cam_(cam), g_(g), problem_(problem), out_(out) {}

  void run() {
    if (problem_.master_unit != "deg" || problem_.length != 360)
      out_.push_back({{"master"}, "`cam` needs a master of 360 deg: one cycle of the law is one turn of the cam"});
    if (!problem_.periodic) out_.push_back({{"periodic"}, "`cam` needs a periodic law: the profile closes"});
    const bool oscillates = g_.follower == FollowerType::oscillating;
    if (problem_.slave_unit != (oscillates ? "deg" : "mm"))
      out_.push_back({{"slave"}, oscillates ? "an oscillating follower moves in deg" : "this follower moves in mm"});
    if (g_.type == CamType::barrel && g_.follower != FollowerType::translating)
      add("follower", "a barrel cam has a translating follower; other followers of barrels are not planned");
    only("offset", g_.type == CamType::radial && g_.follower == FollowerType::translating,
         "belongs to a translating follower of a radial cam");
    only("arm", oscillates, "belongs to an oscillating follower");
    only("distance", oscillates, "belongs to an oscillating follower");
    only("roller_radius", g_.has_roller(), "a flat follower has no roller");
    only("pressure_angle", g_.has_roller(), "a flat follower's pressure angle is always 0");
    if (oscillates && !(g_.arm > 0)) add("arm", "an oscillating follower needs the length of its arm");
    if (oscillates && !(g_.distance > 0)) add("distance", "an oscillating follower needs the distance of its pivot");
    if (!g_.base_radius && !g_.pressure_angle && !cam_.contains("profile_radius"))
      add("base_radius", std::string("must be a number, or ") + (g_.has_roller() ? "pressure_angle or " : "") +
                             "profile_radius must say what the least one keeps");
    if (!g_.base_radius && cam_.contains("profile_radius") && !(g_.profile_radius > 0))
      add("profile_radius", "must be above 0 where base_radius is null: the least radius has a cusp else");
    if (g_.contact && g_.has_roller() && !(g_.roller_radius > 0))
      add("contact", "needs a roller: a knife edge has no Hertz pressure");
  }

 private:
  void add(const char* member, std::string message) { out_.push_back({{"cam", member}, std::move(message)}); }
  void only(const char* member, bool allowed, const char* message) {
    if (!allowed && cam_.contains(member)) add(member, message);
  }

  const json& cam_;
  const CamGeometry& g_;
  const cam::MotionLawProblem& problem_;
  std::vector<InputFault>& out_;
};

}  // namespace

std::optional<CamGeometry> cam_geometry(const json& spec, const cam::MotionLawProblem& problem,
                                        std::vector<InputFault>& faults) {
  const auto cam = spec.find("cam");
  if (cam == spec.end()) return {};
  CamGeometry g = geometry(*cam);
  Faults(*cam, g, problem, faults).run();
  return g;
}

}  // namespace bahnwerk::api::motion_law
