#include "core/probe/straight/stops.hpp"

#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/probe/lasting_phases.hpp"
#include "core/probe/straight/motion_writer.hpp"
#include "core/probe/straight/rows.hpp"
#include "core/probe/straight/straight.hpp"

namespace bahnwerk {

using namespace probe;

ProbeMotion write_stops(const ProbeProblem& problem, const std::vector<std::size_t>& row_end, ProgressScope& progress) {
  MotionWriter writer(problem);
  for (std::size_t i = 0; i + 1 < problem.points.size(); i = row_end[i]) {
    progress.work(64);
    if (i > 0) writer.rest(i);
    append_rest_to_rest(writer, problem, i, row_end[i]);
  }
  writer.aim(problem.points.back());
  return writer.finish();
}

ProbeMotion plan_stops(const ProbeProblem& problem, ProgressScope& progress) {
  const std::vector<std::size_t> row_end = straight_rows(problem);
  return with_lasting_phases(
      problem, write_stops(problem, row_end, progress),
      [&](const ProbeProblem& eased) { return write_stops(eased, row_end, progress); }, progress);
}

ProbeMotion plan_stops(const ProbeProblem& problem, Progress progress) {
  ProgressScope scope(progress, "stops");
  return plan_stops(problem, scope);
}

double stops_duration(const ProbeProblem& problem) {
  const std::vector<std::size_t> row_end = straight_rows(problem);
  double sum = 0;
  for (std::size_t i = 0; i + 1 < problem.points.size(); i = row_end[i])
    sum += rest_to_rest_duration(problem, i, row_end[i]);
  if (!phases_may_blur(problem, sum)) return sum;
  Progress silent;
  return plan_stops(problem, silent).duration();
}

}  // namespace bahnwerk
