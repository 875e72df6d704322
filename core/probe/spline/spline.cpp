#include "core/probe/spline/spline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <memory>
#include <optional>
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
  SplinePlanner(const ProbeProblem& problem, const std::vector<std::size_t>& row_end, bool jerks)
      : problem_(problem), row_end_(row_end), jerks_(jerks), many_(has_many_points(problem)) {}

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
      auto run = std::make_unique<SplineRun>(problem_, first, last, jerks_, late);
      const bool found = run->solve(progress);
      const std::vector<std::size_t> rests = run->rests();
      if (found) {
        if (rests.empty() && run->duration() < resting(first, last)) {
          sections_.push_back({first, last, std::move(run)});
          continue;
        }
        if (rests.empty()) {
          take_rests(first, last);
          continue;
        }
        whole_.push_back({first, last, std::move(run)});
      }
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
    prefer_whole();
    duration_ = 0;
    for (const Section& section : sections_) duration_ += duration_of(section);
  }

  double duration() const { return duration_; }

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
  double duration_of(const Section& s) const {
    return s.run ? s.run->duration() : rest_to_rest_duration(problem_, s.first, s.last);
  }
  /// Parts that were divided by rests could be passed without, too: the quicker way is taken, the inner ones first.
  void prefer_whole() {
    if (whole_.empty()) return;
    std::vector<std::size_t> begins_at(problem_.points.size(), 0);  // the section that does
    for (std::size_t i = 0; i < sections_.size(); ++i) begins_at[sections_[i].first] = i;
    const auto section = [&](std::size_t point) -> Section& { return sections_[begins_at[point]]; };
    for (std::size_t n = whole_.size(); n-- > 0;) {
      Section& whole = whole_[n];
      double divided = 0;
      for (std::size_t p = whole.first; p < whole.last; p = section(p).last) divided += duration_of(section(p));
      if (whole.run->duration() < divided) section(whole.first) = std::move(whole);
    }
    whole_.clear();
    std::vector<Section> kept;
    for (std::size_t p = 0, next = 0; p + 1 < problem_.points.size(); p = next) {
      next = section(p).last;
      kept.push_back(std::move(section(p)));
    }
    sections_ = std::move(kept);
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
  bool jerks_, many_;
  std::vector<Section> sections_, whole_;  // sections in order of points; those that were divided, outer ones first
  double duration_ = 0;
};

/// The quickest spline of all speeds at which the points may be passed in the middle of the way: the times of a spline
/// are scaled as a whole in the end, so that a lower speed leaves more of the limits to where speeds change.
class SplineSearch {
 public:
  /// `row_end` as straight_rows() has it.
  SplineSearch(const ProbeProblem& problem, const std::vector<std::size_t>& row_end, ProgressScope& scope)
      : problem_(problem), row_end_(row_end), scope_(scope) {}

  ProbeMotion search() {
    const std::size_t points = problem_.points.size();
    offer(problem_.speed);
    if (points <= some) {
      scope_.half_of_rest();
      for (const double share : {0.95, 0.85}) offer(share * problem_.speed);
      // The speeds are shares of what the path admits, which hardly depend on the nominal one. No motion through the
      // points is quicker at a lower speed than length / duration.
      const double length = polyline_length(problem_), highest = unreachable_speed(problem_),
                   ratio = std::exp2(points <= few ? -1.0 / 3 : -0.5);
      for (double speed = highest; speed > length / best_->duration(); speed *= ratio)
        if (speed < problem_.speed) offer(speed);
      scope_.half_of_rest();
      for (double step = std::sqrt(ratio); step < closest; step = std::sqrt(step)) {
        const double centre = best_speed_;
        offer(centre * step);
        if (centre / step < problem_.speed) offer(centre / step);
      }
    }
    return best_->write(scope_);
  }

 private:
  static constexpr std::size_t few = 100, some = 300;  // points up to which more speeds are tried
  static constexpr double closest = 0.98;

  void offer(double speed) {
    ProbeProblem& slower = problems_.emplace_back(problem_);
    slower.speed = speed;
    for (const bool jerks : {true, false}) {
      if (!jerks && has_many_points(problem_)) continue;
      SplinePlanner planner(slower, row_end_, jerks);
      planner.solve(scope_);
      if (!best_ || planner.duration() < best_->duration()) best_.emplace(std::move(planner)), best_speed_ = speed;
    }
  }

  const ProbeProblem& problem_;
  const std::vector<std::size_t>& row_end_;
  ProgressScope& scope_;
  std::deque<ProbeProblem> problems_;  // plans refer to them
  std::optional<SplinePlanner> best_;
  double best_speed_ = 0;
};

/// The quickest sections of splines through all points, through those that are left of points in a row, and of rests at
/// the ends of rows.
ProbeMotion search_splines(const ProbeProblem& given, ProgressScope& scope) {
  const ProbeProblem problem = with_reachable_speed(given);
  const std::vector<std::size_t> row_end = straight_rows(problem);
  std::vector<ProbeMotion> plans{write_stops(problem, row_end, scope)};
  if (row_end[0] + 1 == problem.points.size()) return plans.front();
  plans.push_back(SplineSearch(problem, row_end, scope).search());
  const ThinnedProblem thin = thinned(problem);
  if (thin.point.size() < problem.points.size())
    plans.push_back(with_all_points(problem, thin, SplineSearch(thin.problem, thin.next, scope).search()));
  return quickest_sections(problem, std::move(plans));
}

}  // namespace

ProbeMotion plan_spline(const ProbeProblem& problem, Progress& progress, double progress_from, double progress_to) {
  ProgressScope scope(progress, "spline", progress_from, progress_to);
  scope.report();
  const ProbeMotion planned = search_splines(problem, scope);
  ProbeMotion plan = within_limits(problem, slowed(planned, 1), scope);  // slowed motions land
  // A motion that rounding does not slow is no slower than rests by construction.
  constexpr double rounding = 1e-12;
  if (plan.duration() <= planned.duration() * (1 + rounding)) return plan;
  ProbeMotion stops = plan_stops(problem, scope);
  return plan.duration() <= stops.duration() * (1 + rounding) ? plan : stops;
}

}  // namespace bahnwerk
