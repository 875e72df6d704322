#include "api/kinds/motion_law/load_result.hpp"

#include <nlohmann/json.hpp>
#include <numbers>

namespace bahnwerk::api::motion_law {

using nlohmann::ordered_json;

ordered_json load_result(const LoadPlan& load, const LawPlan& plan) {
  const double scale = plan.problem.length / (2 * std::numbers::pi);
  const cam::LoadFigures& f = load.figures;
  const auto figure = [&](const cam::CamExtreme& extreme) {
    return ordered_json{{"value", extreme.value}, {"at", extreme.at * scale}};
  };
  ordered_json phi = ordered_json::array(), effort = phi, speed = phi, power = phi;
  for (const cam::LoadPoint& p : f.points) {
    phi.push_back(p.at * scale), effort.push_back(p.effort);
    speed.push_back(p.speed), power.push_back(p.power);
  }
  const bool turns = load.load.turns();
  return {{"unit", turns ? "N m" : "N"},
          {"speed_unit", turns ? "1/min" : "mm/s"},
          {"max", figure(f.most)},
          {"min", figure(f.least)},
          {"rms", f.rms},
          {"max_power", figure(f.most_power)},
          {"min_power", figure(f.least_power)},
          {"mean_power", f.mean_power},
          {"curve",
           {{"phi", std::move(phi)},
            {"load", std::move(effort)},
            {"speed", std::move(speed)},
            {"power", std::move(power)}}}};
}

}  // namespace bahnwerk::api::motion_law
