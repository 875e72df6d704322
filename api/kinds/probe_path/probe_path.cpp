#include "api/kinds/probe_path/probe_path.hpp"

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/kinds/kind_frame.hpp"
#include "api/verification.hpp"
#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/plan/contour/contour_outline.hpp"
#include "core/plan/probe/probe_drawings.hpp"

namespace bahnwerk::api::probe_path {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

ordered_json summary(const ProbePlan& plan) {
  return {{"duration", plan.duration},
          {"path_length", plan.figures.path_length},
          {"max_deviation", plan.figures.max_deviation},
          {"mean_speed", plan.figures.path_length / plan.duration},
          {"speed_ripple", plan.figures.speed_ripple}};
}

constexpr std::size_t max_outline = 5000;  // vertices

struct Asked {
  ProbeRequest probe;
  std::vector<std::string> notes;
};

struct ProbePathKind {
  static constexpr std::string_view name = "probe_path";
  static constexpr std::string_view title = "A measuring head through given points, inside a tube";

  static constexpr std::array<std::string_view, 0> scene_parts{};

  static Asked read(const json& spec, Progress) { return {request(spec), notes(spec)}; }

  static ViewFacts view_facts(const Asked& asked) {
    const ProbeProblem& problem = asked.probe.problem;
    ViewFacts facts;
    facts.limits.push_back({"speed", "mm/s", "", 1, {-problem.speed, problem.speed}});
    declare_axes(facts.limits, problem.machine);
    if (problem.tolerance > 0)
      facts.limits.push_back({"tube", "mm", "deviation", 0, {-problem.tolerance, problem.tolerance}});
    return facts;
  }

  static ordered_json preview(const Asked& asked, Progress progress) {
    const ProbeProblem& problem = asked.probe.problem;
    double length = 0;
    for (std::size_t i = 1; i < problem.points.size(); ++i) length += norm(problem.points[i] - problem.points[i - 1]);
    const Outline shape = outline(problem.points, max_outline, progress);
    ordered_json vertices = ordered_json::array();
    for (const Vec& at : shape.vertices) {
      ordered_json vertex = ordered_json::array();
      for (std::size_t k = 0; k < problem.dimension(); ++k) vertex.push_back(at[k]);
      vertices.push_back(std::move(vertex));
    }
    return {{"notes", asked.notes},
            {"estimate", {{"duration", length / problem.speed}, {"path_length", length}}},
            {"outline", {{"vertices", std::move(vertices)}, {"tolerance", shape.tolerance}}}};
  }

  static Scene scene(const Asked& asked, const json&, Progress progress) {
    const ProbeProblem& problem = asked.probe.problem;
    const Outline shape = outline(problem.points, max_scene_vertices / 2, progress);
    const bool flat = problem.dimension() == 2;
    Scene scene;
    scene.tolerance = shape.tolerance;
    scene.movers = {{"tool", flat ? std::vector<std::string>{"x", "y"} : std::vector<std::string>{"x", "y", "z"}}};
    using Body = SceneBody;
    scene.add({.name = "head", .kind = Body::Kind::points, .moves = "tool", .points = {{}}});
    scene.add({.name = "tube",
               .kind = problem.tolerance > 0 ? Body::Kind::tube : Body::Kind::polyline,
               .points = shape.vertices,
               .radius = problem.tolerance});
    scene.add({.name = "points", .kind = Body::Kind::points, .points = problem.given});
    return scene;
  }

  static ProbePlan plan(const Asked& asked, Progress progress) { return plan_probe(asked.probe, progress); }

  static KindReport report(const Asked& asked, ProbePlan& plan, Progress progress) {
    KindReport out;
    out.summary = summary(plan);
    out.verification = verification(plan.verification);
    out.bound = bound(plan.bound);
    std::vector<std::string> remarks = asked.notes;
    for (std::string& note : notes(asked.probe, plan)) remarks.push_back(std::move(note));
    out.details = details(asked.probe, remarks, plan);
    progress.report("drawing", 1);
    out.drawings = {{"path.svg", probe_path_drawing(plan)}, {"motion.svg", probe_motion_drawing(plan, progress)}};
    out.setpoints = std::move(plan.setpoints);
    return out;
  }
};

}  // namespace
}  // namespace bahnwerk::api::probe_path

namespace bahnwerk::api {
Kind describe_probe_path() { return kind_of<probe_path::ProbePathKind>(); }
}  // namespace bahnwerk::api
