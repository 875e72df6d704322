#include "core/probe/spline/spline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/probe/spline/spline_run.hpp"
#include "core/probe/straight/rows.hpp"
#include "core/probe/straight/stops.hpp"
#include "core/probe/straight/straight.hpp"
#include "core/probe/tighter.hpp"
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
  SplinePlanner(const ProbeProblem& problem, bool jerks)
      : problem_(problem), jerks_(jerks), many_(has_many_points(problem)), row_end_(straight_rows(problem)) {}

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
    prefer_rows();
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
  /// Rests within a row cost time: where sections begin and end with rows, rows from rest to rest are taken if they are
  /// quicker.
  void prefer_rows() {
    std::vector<char> begins_row(problem_.points.size(), 0);
    for (std::size_t i = 0; i + 1 < problem_.points.size(); i = row_end_[i]) begins_row[i] = 1;
    begins_row.back() = 1;
    std::vector<Section> kept;
    double total = 0;
    for (std::size_t a = 0; a < sections_.size();) {
      const std::size_t first = sections_[a].first;
      double planned = 0;
      std::size_t b = a;
      do {
        const Section& s = sections_[b];
        planned += duration_of(s);
        ++b;
      } while (!begins_row[sections_[b - 1].last]);
      const std::size_t last = sections_[b - 1].last;
      if (const double rows = resting(first, last); rows <= planned) {
        total += rows;
        for (std::size_t i = first; i < last; i = next(i, last)) kept.push_back({i, next(i, last), nullptr});
      } else {
        total += planned;
        for (std::size_t i = a; i < b; ++i) kept.push_back(std::move(sections_[i]));
      }
      a = b;
    }
    sections_ = std::move(kept);
    duration_ = total;
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
  bool jerks_, many_;
  std::vector<std::size_t> row_end_;
  std::vector<Section> sections_, whole_;  // sections in order of points; those that were divided, outer ones first
  double duration_ = 0;
};

/// The quickest plan for the problem and for tighter ones.
class SplineSearch {
 public:
  SplineSearch(const ProbeProblem& problem, ProgressScope& scope)
      : problem_(with_reachable_speed(problem)), scope_(scope) {}

  const SplinePlanner& best() const { return *best_; }

  void search() {
    scope_.part(0, 0.1);
    const std::size_t points = problem_.points.size();
    starts_.push_back(offer(problem_, true));
    if (has_many_points(problem_)) return;
    starts_.push_back(offer(problem_, false));
    offer_all(slower_problems(problem_, best_->duration()));
    offer_all(weaker_problems(problem_));
    // A change that helps at the speed of the best plan may do nothing at the given one.
    if (starts_.front().problem != &problem_ && points <= some) offer_all(weaker_problems(*starts_.front().problem));
    starts_.resize(std::min<std::size_t>(starts_.size(), points <= few ? 3 : points <= some ? 1 : 0));
    for (const Candidate& start : starts_) improve(start);
  }

 private:
  static constexpr std::size_t few = 40, some = 100;  // points: up to there hundreds of plans take less than a second

  struct Candidate {
    double duration;
    const ProbeProblem* problem;
    bool jerks;
  };

  void offer_all(std::vector<ProbeProblem> problems) {
    scope_.half_of_rest();
    for (ProbeProblem& problem : problems) {
      tighter_.push_back(std::move(problem));
      for (const bool jerks : {true, false}) starts_.push_back(offer(tighter_.back(), jerks));
    }
    std::stable_sort(starts_.begin(), starts_.end(),
                     [](const Candidate& a, const Candidate& b) { return a.duration < b.duration; });
  }
  Candidate offer(const ProbeProblem& problem, bool jerks) {
    SplinePlanner planner(problem, jerks);
    planner.solve(scope_);
    const Candidate candidate{planner.duration(), &problem, jerks};
    if (!best_ || candidate.duration < best_->duration()) best_.emplace(std::move(planner));
    return candidate;
  }
  /// Pattern search about the tighter problem of a plan: each quantity is raised and lowered by steps that become
  /// smaller. Limits that the best plan does not use hardly matter then.
  void improve(Candidate centre) {
    constexpr int rounds = 6;
    double step = 0.25;  // octaves
    scope_.half_of_rest();
    for (int round = 0; round < rounds; ++round, step /= 2)
      for (const TightenedQuantity quantity : tightened_quantities)
        for (const double octaves : {-step, step}) {
          ProbeProblem problem = *centre.problem;
          if (!scale_quantity(problem, quantity, std::exp2(octaves), problem_)) continue;
          tighter_.push_back(std::move(problem));
          if (const Candidate found = offer(tighter_.back(), centre.jerks); found.duration < centre.duration)
            centre = found;
          else
            tighter_.pop_back();
        }
  }

  ProbeProblem problem_;
  ProgressScope& scope_;
  std::deque<ProbeProblem> tighter_;  // plans refer to them
  std::vector<Candidate> starts_;     // ordered by duration
  std::optional<SplinePlanner> best_;
};

}  // namespace

ProbeMotion plan_spline(const ProbeProblem& problem, Progress& progress, double progress_from, double progress_to) {
  ProgressScope scope(progress, "spline", progress_from, progress_to);
  scope.report();
  SplineSearch search(problem, scope);
  search.search();
  const SplinePlanner& best = search.best();
  ProbeMotion plan = within_limits(problem, slowed(best.write(scope), 1), scope);  // slowed motions land
  // A motion that rounding does not slow is no slower than rests by construction.
  constexpr double rounding = 1e-12;
  if (plan.duration() <= best.duration() * (1 + rounding)) return plan;
  ProbeMotion stops = plan_stops(problem, scope);
  return plan.duration() <= stops.duration() * (1 + rounding) ? plan : stops;
}

}  // namespace bahnwerk
