#include "api/kinds/motion_law/motion_law_input.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/kinds/motion_law/motion_law_faults.hpp"
#include "core/base/errors.hpp"
#include "core/cam/problem.hpp"
#include "core/cam_profile/cam_geometry.hpp"

namespace bahnwerk::api::motion_law {
namespace {

// Member `cam` of a motion law's spec → geometry of a mechanical cam.

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

/// Returns the cam of a spec that passed its schema; none if it has no `cam`. Appends faults: members that the type of
/// follower lacks or has no use for, a master that is no turn.
std::optional<CamGeometry> cam_geometry(const json& spec, const cam::MotionLawProblem& problem,
                                        std::vector<InputFault>& faults) {
  const auto cam = spec.find("cam");
  if (cam == spec.end()) return {};
  CamGeometry g = geometry(*cam);
  Faults(*cam, g, problem, faults).run();
  return g;
}

using cam::MotionLawProblem;
using cam::MotionPoint;
using cam::Range;
using nlohmann::json;

Range range(const json& value) {
  if (value.is_number()) return {value.get<double>(), value.get<double>()};
  Range out;
  if (const auto at = value.find("min"); at != value.end()) out.min = at->get<double>();
  if (const auto at = value.find("max"); at != value.end()) out.max = at->get<double>();
  return out;
}

constexpr const char* order_names[] = {"position", "velocity", "acceleration", "jerk"};

MotionPoint point(const json& p) {
  MotionPoint out;
  out.at = range(p["at"]);
  out.continuity = p.value("continuity", 2);
  const auto put = [&](int order, const json& value) {
    const auto at = static_cast<std::size_t>(order);
    if (at >= out.values.size()) out.values.resize(at + 1);
    out.values[at] = range(value);
  };
  for (int r = 0; r < 4; ++r)
    if (const auto at = p.find(order_names[r]); at != p.end()) put(r, *at);
  if (const auto at = p.find("derivatives"); at != p.end())
    for (const auto& [order, value] : at->items()) put(std::stoi(order), value);
  if (const auto at = p.find("section"); at != p.end() && at->is_object()) {
    if (const auto weight = at->find("weight"); weight != at->end()) out.weight = weight->get<double>();
    for (int r = 0; r < 4; ++r)
      if (const auto limit = at->find(order_names[r]); limit != at->end())
        out.section[static_cast<std::size_t>(r)] = range(*limit);
  }
  if (const auto at = p.find("law"); at != p.end())
    out.law = value_of<cam::ClassicalLaw>(at->get<std::string>(), cam::classical_laws);
  if (const auto at = p.find("inflection"); at != p.end()) out.inflection = at->get<double>();
  if (const auto at = p.find("fractions"); at != p.end())
    out.fractions = {(*at)["b"].get<double>(), (*at)["c"].get<double>(), (*at)["d"].get<double>()};
  out.still = p.value("still", false);
  return out;
}

/// Faults of the law `sine_straight_combination`, which has fractions, as no other law.
std::vector<InputFault> fraction_faults(const json& points, const MotionLawProblem& problem) {
  std::vector<InputFault> faults;
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    const bool named = problem.points[i].law == cam::ClassicalLaw::sine_straight_combination;
    const cam::SineStraight& f = problem.points[i].fractions;
    if (points[i].contains("fractions") != named)
      faults.push_back({{"points", std::to_string(i), "fractions"},
                        named ? "are missing: law sine_straight_combination consists of b, c and d"
                              : "belong to the law sine_straight_combination: leave them out"});
    const auto fits = [](double part) { return std::abs(part) < 1e-9 || part >= 0.001; };
    if (named && !(fits(f.b) && fits(f.c) && fits(f.d) && fits(1 - f.b - f.c - f.d)))
      faults.push_back({{"points", std::to_string(i), "fractions"},
                        "each of b, c, d and of 1 - b - c - d has to be 0 or at least 0.001"});
  }
  return faults;
}

/// Replaces the words "dwell" and "monotone" by what they stand for; faults where a section is neither.
std::vector<InputFault> expand_sections(const json& points, MotionLawProblem& problem) {
  std::vector<InputFault> faults;
  const auto value = [&](std::size_t p, std::size_t order) -> Range& {
    auto& values = problem.points[p].values;
    if (values.size() <= order) values.resize(order + 1);
    return values[order];
  };
  for (std::size_t s = 0; s < problem.sections(); ++s) {
    const auto section = points[s].find("section");
    if (section == points[s].end() || !section->is_string()) continue;
    const std::size_t end = problem.end_point(s);
    const auto fault = [&](const char* text) { faults.push_back({{"points", std::to_string(s), "section"}, text}); };
    if (*section == "dwell") {
      const double more = problem.travel_at_end(s);
      Range &from = value(s, 0), to = problem.end_position(s);
      if (!from.fixed() && to.fixed()) from = to;
      if (to.free()) value(end, 0) = to = {from.min - more, from.max - more};
      if (!from.fixed() || problem.end_position(s).min != from.min || !problem.end_position(s).fixed()) {
        fault("a dwell has one position: write it as a number in this point or the next one, or the same in both");
        continue;
      }
      problem.points[s].law = cam::ClassicalLaw::straight;
      for (const std::size_t p : {s, end})
        for (const std::size_t order : {1u, 2u})
          if (value(p, order).free()) value(p, order) = {0, 0};
      continue;
    }
    const Range from = problem.points[s].value(0), to = problem.end_position(s);
    if (to.min >= from.max)
      problem.points[s].section[1].min = 0;
    else if (to.max <= from.min)
      problem.points[s].section[1].max = 0;
    else
      fault(
          "a monotone section rises or falls, and the positions of its points allow both: write the limit of velocity");
  }
  return faults;
}

MotionLawProblem problem(const json& spec) {
  MotionLawProblem out;
  const json& master = spec["master"];
  out.master_unit = master.value("unit", "deg");
  out.length = master["length"].get<double>();
  if (!master["cycle_duration"].is_null()) out.cycle_duration = master["cycle_duration"].get<double>();
  if (const auto slave = spec.find("slave"); slave != spec.end()) out.slave_unit = slave->value("unit", "mm");
  out.periodic = spec["periodic"].get<bool>();
  out.travel = spec.value("travel", 0.0);
  for (const json& p : spec["points"]) out.points.push_back(point(p));
  out.method = spec.value("method", "optimal") == "optimal" ? cam::LawMethod::optimal : cam::LawMethod::active_set;
  if (const auto degree = spec.find("degree"); degree != spec.end() && !degree->is_null())
    out.degree = degree->get<int>();
  out.pieces = spec.value("pieces", 1);
  const json objective = spec.value("objective", json::object());
  out.objective.weight = {0, objective.value("velocity", 1.0), objective.value("acceleration", 1.0),
                          objective.value("jerk", 0.1)};
  out.objective.normalised = objective.value("normalised", false);
  if (const auto then = objective.find("then"); then != objective.end())
    out.objective.then_order = *then == "rms_acceleration" ? 2 : 3;
  out.objective.zero_crossing_penalty = objective.value("zero_crossing_penalty", 0.0);
  if (const auto drive = spec.find("drive"); drive != spec.end()) {
    cam::DriveLimits limits;
    limits.velocity = drive->value("velocity", limits.velocity);
    limits.acceleration = drive->value("acceleration", limits.acceleration);
    limits.jerk = drive->value("jerk", limits.jerk);
    out.drive = limits;
  }
  if (const auto modes = spec.find("vibration"); modes != spec.end())
    for (const json& mode : *modes)
      out.vibration.push_back({mode["frequency"].get<double>(), mode.value("damping", 0.0)});
  out.seed = spec.value("seed", std::uint64_t{1});
  return out;
}

void note_what_has_no_effect(const json& spec, MotionLawRequest& request) {
  const auto note = [&](const char* text) { request.notes.emplace_back(text); };
  if (request.problem.method == cam::LawMethod::active_set) {
    if (request.problem.degree)
      note("degree has no effect: method \"active_set\" balances the degrees of the sections");
    if (spec.contains("pieces") && request.problem.pieces != 1)
      note("pieces have no effect: method \"active_set\" takes one polynomial per section");
  } else {
    if (!request.problem.degree && spec.contains("pieces"))
      note("pieces have no effect where degree is null: both are chosen");
  }
}

}  // namespace

MotionLawRequest request(const json& spec) {
  MotionLawRequest out;
  out.problem = problem(spec);
  if (const auto at = spec.find("cycle_time"); at != spec.end()) out.sampling.cycle_time = at->get<double>();
  if (const auto at = spec.find("samples"); at != spec.end()) out.sampling.samples = at->get<std::size_t>();
  out.drawings = spec.value("drawings", true);
  note_what_has_no_effect(spec, out);
  std::vector<InputFault> faults = expand_sections(spec["points"], out.problem);
  for (InputFault& fault : fraction_faults(spec["points"], out.problem)) faults.push_back(std::move(fault));
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  std::vector<InputFault> drive_faults;
  out.drive = read_drive(spec, out.problem, drive_faults, out.notes);
  faults = problem_faults(out.problem);
  std::move(drive_faults.begin(), drive_faults.end(), std::back_inserter(faults));
  for (InputFault& fault : sampling_faults(out.problem, out.sampling)) faults.push_back(std::move(fault));
  out.cam = cam_geometry(spec, out.problem, faults);
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  return out;
}

}  // namespace bahnwerk::api::motion_law
