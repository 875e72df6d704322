#include "core/probe/spline/spline.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/probe/reachable_speed.hpp"
#include "core/probe/rest_sections.hpp"
#include "core/probe/spline/spline_run.hpp"
#include "core/probe/straight/rows.hpp"
#include "core/probe/straight/stops.hpp"
#include "core/probe/straight/straight.hpp"
#include "core/probe/within_limits.hpp"

namespace bahnwerk {
namespace {

using namespace probe;

/// A part between two rests: a spline, or straights from rest to rest.
struct Section {
  std::size_t first = 0, last = 0;
  std::unique_ptr<SplineRun> run;
};

class SplinePlanner {
 public:
  /// `row_end` as straight_rows() has it.
  SplinePlanner(const ProbeProblem& problem, const std::vector<std::size_t>& row_end)
      : problem_(problem), row_end_(row_end), many_(has_many_points(problem)) {}

  void solve(ProgressScope& progress) {
    // Parts that are still to be planned, the first one on top.
    std::vector<Part> open{{0, problem_.points.size() - 1}};
    while (!open.empty()) {
      const auto [first, last, level] = open.back();
      open.pop_back();
      const bool late = many_ && level >= late_level;
      if (row_end_[first] >= last || (many_ && level >= last_level)) {
        take_rests(first, last);
        continue;
      }
      auto run = std::make_unique<SplineRun>(problem_, first, last, late);
      if (run->solve(progress)) {
        if (run->duration() < resting(first, last))
          sections_.push_back({first, last, std::move(run)});
        else
          take_rests(first, last);
        continue;
      }
      const std::vector<std::size_t>& rests = run->rests();
      const auto divide = [&, whole = last - first, above = level](std::size_t from, std::size_t to) {
        open.push_back({from, to, above + (2 * (to - from) > whole ? 1 : 0)});
      };
      std::size_t end = last;
      for (std::size_t i = rests.size(); i-- > 0;) {
        divide(rests[i], end);
        end = rests[i];
      }
      divide(first, end);
    }
  }

  ProbeMotion write(ProgressScope& progress) const {
    MotionWriter writer(problem_);
    for (const Section& section : sections_) {
      progress.work(64);
      if (section.first > 0) writer.rest(section.first);
      if (section.run)
        write(writer, section, progress);
      else
        append_rest_to_rest(writer, problem_, section.first, section.last);
    }
    writer.aim(problem_.points.back());
    return writer.finish();
  }

 private:
  /// Rests that are found one after the other at an end of a part leave most of it to be planned once more. A point is
  /// planned within at most last_level such parts, and within log₂(points) others.
  static constexpr std::size_t late_level = 6, last_level = 10;
  struct Part {
    std::size_t first = 0, last = 0;
    std::size_t level = 0;  // number of times it was more than half of the divided part
  };
  std::size_t next(std::size_t i, std::size_t last) const { return std::min(last, row_end_[i]); }
  double resting(std::size_t first, std::size_t last) const {
    double sum = 0;
    for (std::size_t i = first; i < last; i = next(i, last)) sum += rest_to_rest_duration(problem_, i, next(i, last));
    return sum;
  }
  void take_rests(std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; i = next(i, last)) sections_.push_back({i, next(i, last), nullptr});
  }
  void write(MotionWriter& writer, const Section& section, ProgressScope& progress) const {
    const SplineRun& run = *section.run;
    writer.aim(problem_.points[section.first]);
    for (std::size_t i = 0; i < run.times().size(); ++i) {
      progress.work(8);
      const double begin = writer.time();
      const double h = run.times()[i];
      const bool last = i + 1 == run.times().size();
      // Terms of a whole interval cancel where it ends at rest, those of its second half hardly do.
      const std::array<Vec, 8> c = septic_coefficients(i == 0 ? run.end(0) : writer.carry(), run.end(i + 1), h);
      writer.add(last ? h / 2 : h, c, PieceJoint::landing);
      if (last) writer.add(h / 2, septic_coefficients(writer.carry(), run.end(i + 1), h / 2), PieceJoint::settling);
      writer.phase(ProbePhaseKind::interval, begin, writer.time(), section.first + i);
      if (!last) writer.pass(writer.time());
    }
  }

  const ProbeProblem& problem_;
  const std::vector<std::size_t>& row_end_;
  bool many_;
  std::vector<Section> sections_;  // in order of points
};

/// Returns the quickest sections of splines, and of rests at the ends of rows.
ProbeMotion splines_and_rests(const ProbeProblem& given, ProgressScope& scope) {
  const ProbeProblem problem = with_reachable_speed(given);
  const std::vector<std::size_t> row_end = straight_rows(problem);
  std::vector<ProbeMotion> plans{write_stops(problem, row_end, scope)};
  if (row_end[0] + 1 == problem.points.size()) return plans.front();
  SplinePlanner planner(problem, row_end);
  planner.solve(scope);
  plans.push_back(planner.write(scope));
  return quickest_sections(problem, std::move(plans));
}

}  // namespace

ProbeMotion plan_spline(const ProbeProblem& problem, Progress progress) {
  ProgressScope scope(progress, "spline");
  scope.report();
  const ProbeMotion planned = splines_and_rests(problem, scope);
  ProbeMotion plan = within_limits(problem, slowed(planned, 1), scope);  // slowed motions land
  // A motion that rounding does not slow is no slower than rests by construction.
  constexpr double rounding = 1e-12;
  if (plan.duration() <= planned.duration() * (1 + rounding)) return plan;
  ProbeMotion stops = plan_stops(problem, scope);
  return plan.duration() <= stops.duration() * (1 + rounding) ? plan : stops;
}

}  // namespace bahnwerk
