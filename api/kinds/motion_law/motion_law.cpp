#include "api/kinds/motion_law/motion_law.hpp"

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "api/kinds/motion_law/motion_law_input.hpp"
#include "api/kinds/motion_law/motion_law_result.hpp"
#include "api/planned_job.hpp"
#include "api/problem.hpp"
#include "core/base/errors.hpp"
#include "core/cam/spline/active_set.hpp"
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

}  // namespace

void check(const nlohmann::json& spec) {
  try {
    const MotionLawRequest asked = request(spec);
    constexpr std::size_t quickly_solved = 200;  // points, some 2 ms
    if (asked.problem.method != cam::LawMethod::active_set || asked.problem.has_free_angles() ||
        asked.problem.points.size() > quickly_solved)
      return;
    std::vector<double> at;
    for (const cam::MotionPoint& point : asked.problem.points) at.push_back(point.at.min);
    cam::check_spline(asked.problem, at);
  } catch (const InvalidInput&) {
    throw problem_from_current_exception("/spec");
  }
}

PlannedJob plan(const nlohmann::json& spec, Progress& progress) {
  const MotionLawRequest asked = request(spec);
  const LawPlan plan = plan_motion_law(asked.problem, asked.sampling, progress);
  PlannedJob job;
  job.result = result_document(asked, plan);
  if (asked.drawings)
    job.result["details"]["drawings"] = {{"law.svg", law_drawing(plan)}, {"spectrum.svg", spectrum_drawing(plan)}};
  job.setpoints = std::make_unique<SharedTable>(plan.table);
  job.verified = plan.verification.passed;
  return job;
}

}  // namespace bahnwerk::api::motion_law
