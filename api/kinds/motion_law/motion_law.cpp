#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "api/kinds/kind_frame.hpp"
#include "api/kinds/motion_law/controller_layouts.hpp"
#include "api/kinds/motion_law/motion_law_input.hpp"
#include "api/kinds/motion_law/motion_law_result.hpp"
#include "core/base/errors.hpp"
#include "core/base/infeasible_at.hpp"
#include "core/cam/active_set/active_set.hpp"
#include "core/plan/motion_law/cam_drawing.hpp"
#include "core/plan/motion_law/law_drawings.hpp"

namespace bahnwerk::api::motion_law {
namespace {

/// A table that several own: the job takes it with it.
class SharedTable final : public SetpointSource {
 public:
  explicit SharedTable(std::shared_ptr<const SetpointSource> table) : table_(std::move(table)) {}
  const std::vector<Column>& columns() const override { return table_->columns(); }
  std::size_t count() const override { return table_->count(); }
  double cycle_time() const override { return table_->cycle_time(); }
  Independent independent() const override { return table_->independent(); }
  double duration() const override { return table_->duration(); }
  void read(std::size_t first, std::size_t rows, double* out) const override { table_->read(first, rows, out); }

 private:
  std::shared_ptr<const SetpointSource> table_;
};

constexpr auto layout_names = [] {
  std::array<std::string_view, std::size(controller_layouts)> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = controller_layouts[i].name;
  return names;
}();

/// Returns a job's name as one that every controller takes: letters and digits, underlines between them, a letter
/// first; 24 characters at most.
std::string table_name(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const bool digit = c >= '0' && c <= '9', letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (out.empty() && digit) out = "cam_";
    if (digit || letter)
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
    if (out.size() == 24) break;
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out.empty() ? "law" : out;
}

/// Returns a controller's cam table of a result.
ResultFile cam_table(const nlohmann::json& result, std::string_view layout, std::string_view name) {
  ControllerFile table =
      controller_file(result, value_of<ControllerLayout>(layout, controller_layouts), table_name(name));
  return {std::move(table.text),
          std::move(table.content_type),
          std::move(table.extension),
          "differs from the law by " + table.refit_error,
          "X-Refit-Error",
          table.refit_error};
}

/// Sections that the drive limits name the drive where they exclude every law.
LawPlan planned_law(const MotionLawRequest& asked, Progress progress) {
  try {
    return plan_motion_law(asked.problem, asked.sampling, progress);
  } catch (const InfeasibleAt& error) {
    throw InfeasibleAt(error.what(), blamed_on_drive(error.faults, asked.drive));
  } catch (const InvalidInput& error) {
    throw InvalidInput(blamed_on_drive(error.faults, asked.drive));
  }
}

/// Returns the limits of the sections by angle, and those of the drive. Near a point whose angle the plan chooses, no
/// section is certain, and nothing counts as limited.
DeclaredLimits declared_limits(const cam::MotionLawProblem& problem) {
  constexpr std::array<const char*, cam::limited_orders> names{"position", "velocity", "acceleration", "jerk"};
  constexpr std::array<const char*, cam::limited_orders> per_time{"", "/s", "/s²", "/s³"};
  const double rounding = 1e-9 * problem.length;
  DeclaredLimits list;
  for (std::size_t r = 0; r < names.size(); ++r) {
    const auto section = [&](std::size_t i) {
      const cam::Range& range = problem.points[i].section[r];
      return Permitted{range.min, range.max};
    };
    const int order = static_cast<int>(r);
    DeclaredLimit limit{std::string("section ") + names[r], problem.slave_unit + per_time[r], r == 0 ? "s" : "", order};
    limit.key = "phi";
    const std::size_t sections = problem.sections();
    if (problem.periodic) limit.steps.push_back({-std::numeric_limits<double>::infinity(), section(sections - 1)});
    for (std::size_t i = 0; i < problem.points.size(); ++i) {
      const cam::Range& at = problem.points[i].at;
      if (!at.fixed() || i == sections) limit.steps.push_back({at.min - rounding, {}});
      if (i < sections) limit.steps.push_back({at.max - rounding, section(i)});
    }
    const auto is_none = [](const LimitStep& step) { return step.permitted.none(); };
    if (!std::all_of(limit.steps.begin(), limit.steps.end(), is_none)) list.push_back(std::move(limit));
  }
  if (!problem.drive) return list;
  const std::array<double, 3> drive{problem.drive->velocity, problem.drive->acceleration, problem.drive->jerk};
  for (std::size_t r = 1; r < names.size(); ++r)
    if (const double most = drive[r - 1]; std::isfinite(most))
      list.push_back(
          {std::string("drive ") + names[r], problem.slave_unit + per_time[r], "", static_cast<int>(r), {-most, most}});
  return list;
}

struct MotionLawKind {
  static constexpr std::string_view name = "motion_law";
  static constexpr std::string_view title = "A motion law for a cam or servo drive";
  static constexpr ResultFiles files{
      "cam table", layout_names,
      "Header X-Refit-Error says by how much the controller's motion then differs from the law.", cam_table};

  static MotionLawRequest read(const nlohmann::json& spec, Progress) { return request(spec); }

  static void check(const MotionLawRequest& asked) {
    constexpr std::size_t quickly_solved = 200;  // points, some 2 ms
    if (asked.problem.method != cam::LawMethod::active_set || asked.problem.has_free_angles() ||
        asked.problem.points.size() > quickly_solved)
      return;
    std::vector<double> at;
    for (const cam::MotionPoint& point : asked.problem.points) at.push_back(point.at.min);
    cam::check_spline(asked.problem, at);
  }

  static ViewFacts view_facts(const MotionLawRequest& asked) { return {declared_limits(asked.problem)}; }

  static MotionLawPlan plan(const MotionLawRequest& asked, Progress progress) {
    MotionLawPlan plan{planned_law(asked, progress), {}, {}};
    if (asked.cam) plan.cam = plan_cam(*asked.cam, plan, progress);
    if (asked.drive.given_cycle) check_drive(*asked.drive.given_cycle, plan);
    if (asked.drive.load) plan.load = plan_load(*asked.drive.load, asked.drive.limits, plan, progress);
    return plan;
  }

  static KindReport report(const MotionLawRequest& asked, const MotionLawPlan& plan, Progress) {
    KindReport out = report_law(asked, plan);
    if (asked.drawings) {
      out.drawings = {{"law.svg", law_drawing(plan)}, {"spectrum.svg", spectrum_drawing(plan)}};
      if (plan.cam) out.drawings["cam.svg"] = cam_drawing(*plan.cam), out.drawings["cam.dxf"] = cam_dxf(*plan.cam);
      if (plan.load) out.drawings["load.svg"] = load_drawing(*plan.load, plan);
    }
    out.setpoints = std::make_unique<SharedTable>(plan.table);
    return out;
  }
};

}  // namespace
}  // namespace bahnwerk::api::motion_law

namespace bahnwerk::api {
Kind describe_motion_law() { return kind_of<motion_law::MotionLawKind>(); }
}  // namespace bahnwerk::api
