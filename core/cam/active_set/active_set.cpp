#include "core/cam/active_set/active_set.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <set>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/cam/bernstein.hpp"
#include "core/cam/classical/classical_sections.hpp"
#include "core/cam/spline/spline_faults.hpp"

namespace bahnwerk::cam {
namespace {

using Conversions = std::vector<Conversion>;

constexpr std::size_t most_next = 64;  // distributions that follow the balanced ones where all of these are singular

/// A range that a law does not keep.
struct Violation {
  Conversion conversion;
  double size = 0;
};

class Search {
 public:
  Search(const MotionLawProblem& problem, const std::vector<double>& at, Progress progress,
         const ActiveSetOptions& options)
      : problem_(problem),
        task_(spline_task(problem, at)),
        fixed_(task_.values.size()),
        progress_(progress),
        options_(options) {
    best_.at = at;
    best_.cycle_duration = *problem.cycle_duration;
  }

  Expected<LawSolution, NoLaw> run() {
    // The source's order first; where it ends without a law, the last choice is replaced by another one.
    std::vector<Conversions> way;
    std::vector<Step> steps;
    way.emplace_back();
    steps.push_back(step(way.back()));
    while (!steps.empty() && !(steps.back().solved && steps.back().violations.empty())) {
      Step& now = steps.back();
      if (now.next == now.violations.size() || solved_sections_ > most_sections) {
        way.pop_back(), steps.pop_back();
        continue;
      }
      Conversions next = way.back();
      next.push_back(now.violations[now.next++].conversion);
      if (!tried_.insert(key(next)).second) continue;
      steps.push_back(step(next));
      way.push_back(std::move(next));
    }
    if (way.empty()) return none();
    solved_sections_ = 0;
    explore(way.back());
    source_.conversions = way.back();
    source_.objective = best_objective_;
    if (!options_.source_order_only) {
      for (const Conversions& state : way) explore(state);
      while (!waiting_.empty() && !spent()) {
        const Conversions state = std::move(waiting_.front());
        waiting_.pop_front();
        explore(state);
      }
    }
    if (!std::isfinite(best_objective_)) return none();
    finish();
    return std::move(best_);
  }

 private:
  bool spent() const { return solved_sections_ >= options_.sections; }

  SplineTask& with(const Conversions& conversions) {
    task_.values.resize(fixed_);
    for (const Conversion& c : conversions) task_.values.push_back({c.point, c.order, c.value});
    return task_;
  }
  DegreeDistributions distributions(const SplineTask& task, std::size_t at_most) const {
    return balance_degrees(point_shares(task), sections_with_unknowns(task), max_degree, at_most);
  }
  SolvedSpline solve(const SplineTask& task, const std::vector<int>& degrees) {
    progress_.report("spline", 0.5);
    ++best_.systems;
    solved_sections_ += task.sections();
    return solve_spline(task, degrees);
  }

  /// Looks at what the first balanced distribution that is not singular says of a set of conversions.
  struct Step {
    bool solved = false;
    std::vector<Violation> violations;  ///< the source's choice first
    std::size_t next = 0;
  };
  Step step(const Conversions& conversions) {
    Step out;
    const SplineTask& task = with(conversions);
    std::optional<SingularSystem> singular;
    const auto succeeds = [&](const std::vector<int>& degrees) {
      SolvedSpline solved = solve(task, degrees);
      if (solved.singular) {
        if (!singular) singular = std::move(solved.singular);
        return false;
      }
      out.solved = true;
      out.violations = violations(assemble_law(task, solved), conversions);
      last_degrees_ = degrees;
      return true;
    };
    DegreeDistributions found = distributions(task, 1);
    if (found.degrees.empty() && conversions.empty()) throw degree_faults(problem_, task, found.least_maximum);
    if (!found.degrees.empty() && succeeds(found.degrees.front())) return out;
    const std::vector<int> first = found.degrees.empty() ? std::vector<int>{} : found.degrees.front();
    found = distributions(task, options_.distributions);
    // If there are many, those most like the last that was not singular are taken.
    if (!found.complete && last_degrees_.size() == task.sections())
      std::stable_sort(found.degrees.begin(), found.degrees.end(), [&](const auto& a, const auto& b) {
        return distance(a, last_degrees_) < distance(b, last_degrees_);
      });
    for (const auto& degrees : found.degrees)
      if (degrees != first && succeeds(degrees)) return out;
    for (const auto& degrees : next_degrees(point_shares(task), sections_with_unknowns(task), max_degree, most_next))
      if (succeeds(degrees)) return out;
    if (conversions.empty()) throw singular_faults(problem_, *singular);
    return out;
  }

  /// Solves all balanced distributions of one set of conversions: laws that keep all ranges are compared, others say
  /// which conversions may follow.
  void explore(const Conversions& conversions) {
    if (!visited_.insert(key(conversions)).second) return;
    const SplineTask& task = with(conversions);
    // At most as many are solved as may be, except those of the source's own law.
    const std::size_t left = options_.sections > solved_sections_ ? options_.sections - solved_sections_ : 0;
    const std::size_t wanted = best_.law.pieces() > 0 ? 1 + left / task.sections() : options_.distributions;
    const DegreeDistributions found = distributions(task, std::min(options_.distributions, wanted));
    bool singular = !found.degrees.empty();
    // Returns whether there is effort left for more.
    const auto look_at = [&](const std::vector<int>& degrees, std::size_t of) {
      if (spent() && best_.law.pieces() > 0) return false;
      const SolvedSpline solved = solve(task, degrees);
      if (solved.singular) return true;
      singular = false;
      CamLaw law = assemble_law(task, solved);
      const auto violated = violations(law, conversions);
      if (violated.empty()) consider(std::move(law), conversions, degrees, of);
      for (const Violation& each : violated) {
        waiting_.push_back(conversions);
        waiting_.back().push_back(each.conversion);
      }
      return true;
    };
    for (const auto& degrees : found.degrees)
      if (!look_at(degrees, found.degrees.size())) return;
    if (!singular) return;
    const auto next = next_degrees(point_shares(task), sections_with_unknowns(task), max_degree, most_next);
    for (const auto& degrees : next)
      if (!look_at(degrees, next.size())) return;
  }

  static int distance(const std::vector<int>& a, const std::vector<int>& b) {
    int sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
    return sum;
  }

  static std::vector<std::pair<std::size_t, int>> key(const Conversions& conversions) {
    std::vector<std::pair<std::size_t, int>> out;
    for (const Conversion& c : conversions) out.emplace_back(2 * c.point + (c.at_maximum ? 1 : 0), c.order);
    std::sort(out.begin(), out.end());
    return out;
  }

  /// Returns the violations, lowest order first, and the largest first within an order.
  std::vector<Violation> violations(const CamLaw& law, const Conversions& conversions) const {
    constexpr double tolerance = 1e-10;
    std::vector<Violation> out;
    for (std::size_t p = 0; p < problem_.points.size(); ++p) {
      const MotionPoint& point = problem_.points[p];
      std::size_t hint = 0;
      for (int r = 0; r < static_cast<int>(point.values.size()); ++r) {
        const Range range = point.value(r);
        if (range.free() || range.fixed()) continue;
        const auto same = [&](const Conversion& c) { return c.point == p && c.order == r; };
        if (std::any_of(conversions.begin(), conversions.end(), same)) continue;
        while (hint + 1 < law.pieces() && law.breaks()[hint + 1] <= task_.breaks[p]) ++hint;
        const bool end = p + 1 == problem_.points.size() && !problem_.periodic;
        const std::vector<double> b = law.derivative(hint, r);
        const double value = end ? b.back() : b.front();
        double scale = 0;
        for (const double c : b) scale = std::max(scale, std::abs(c));
        const auto add = [&](double bound, double beyond, bool at_maximum) {
          if (beyond > tolerance * (scale + std::abs(bound))) out.push_back({{p, r, bound, at_maximum}, beyond});
        };
        if (value < range.min) add(range.min, range.min - value, false);
        if (value > range.max) add(range.max, value - range.max, true);
      }
    }
    std::stable_sort(out.begin(), out.end(), [](const Violation& a, const Violation& b) {
      return a.conversion.order != b.conversion.order ? a.conversion.order < b.conversion.order : a.size > b.size;
    });
    return out;
  }

  bool keeps_sections(const CamLaw& law) {
    for (std::size_t s = 0; s < problem_.sections(); ++s)
      for (int r = 0; r < limited_orders; ++r) {
        const Range limit = problem_.points[s].section[static_cast<std::size_t>(r)];
        if (limit.free()) continue;
        const LawExtremes extremes = law.section_extremes(r, s);
        const double low = extremes.lowest.value, high = extremes.highest.value;
        const double slack = 1e-9 * (std::max(std::abs(low), std::abs(high)));
        if (low < limit.min - slack || high > limit.max + slack) {
          broken_limits_.insert({s, r});
          return false;
        }
      }
    return true;
  }

  void consider(CamLaw law, const Conversions& conversions, const std::vector<int>& degrees, std::size_t compared) {
    if (!keeps_sections(law)) return;
    const LawValue value = evaluate_objective(problem_, law);
    if (!(value.objective < best_objective_ * (1 - 1e-12))) return;
    best_objective_ = value.objective;
    best_.law = std::move(law);
    best_.value = value;
    best_.conversions = conversions;
    best_.degrees = degrees;
    best_.distributions = compared;
  }

  NoLaw none() const {
    if (broken_limits_.empty()) return NoLaw::ranges;
    std::vector<InputFault> faults;
    for (const auto& [section, order] : broken_limits_)
      faults.push_back({{"points", std::to_string(section), "section", order_name(order)},
                        "the law of method \"active_set\" leaves this limit, which the method does not know: use "
                        "method \"optimal\", or give ranges at more points"});
    throw InvalidInput(std::move(faults));
  }

  void finish() {
    if (source_.objective > best_.value.objective && source_.conversions != best_.conversions)
      best_.source_order = source_;
    const SplineTask& task = with(best_.conversions);
    best_.condition = spline_condition(task, best_.degrees);
  }

  const MotionLawProblem& problem_;
  SplineTask task_;
  std::size_t fixed_;  // values that are no conversions
  Progress progress_;
  const ActiveSetOptions& options_;
  LawSolution best_;
  double best_objective_ = std::numeric_limits<double>::infinity();
  ConversionOrder source_;
  static constexpr std::size_t most_sections = 100000;  // sections solved before a first law is found
  std::set<std::vector<std::pair<std::size_t, int>>> visited_, tried_;
  std::set<std::pair<std::size_t, int>> broken_limits_;
  std::vector<int> last_degrees_;  // degrees of the last system that was not singular
  std::deque<Conversions> waiting_;
  std::size_t solved_sections_ = 0;
};

}  // namespace

SplineTask spline_task(const MotionLawProblem& problem, const std::vector<double>& at) {
  SplineTask task;
  task.breaks = section_times(problem, at);
  task.periodic = problem.periodic;
  task.travel = problem.periodic ? problem.travel : 0;
  for (std::size_t p = 0; p < problem.points.size(); ++p) {
    task.continuity.push_back(problem.continuity(p));
    for (int r = 0; r < static_cast<int>(problem.points[p].values.size()); ++r)
      if (problem.points[p].value(r).fixed()) task.values.push_back({p, r, problem.points[p].value(r).min});
  }
  task.given = classical_sections(problem, task.breaks);
  return task;
}

void check_spline(const MotionLawProblem& problem, const std::vector<double>& at) {
  const SplineTask task = spline_task(problem, at);
  const auto found = balance_degrees(point_shares(task), sections_with_unknowns(task), max_degree, 64);
  if (found.degrees.empty()) throw degree_faults(problem, task, found.least_maximum);
  std::optional<SingularSystem> singular;
  for (const auto& degrees : found.degrees) {
    const SolvedSpline solved = solve_spline(task, degrees);
    if (!solved.singular) return;
    if (!singular) singular = solved.singular;
  }
  for (const auto& degrees : next_degrees(point_shares(task), sections_with_unknowns(task), max_degree, most_next))
    if (!solve_spline(task, degrees).singular) return;
  throw singular_faults(problem, *singular);
}

Expected<LawSolution, NoLaw> solve_active_set(const MotionLawProblem& problem, const std::vector<double>& at,
                                              Progress progress, const ActiveSetOptions& options) {
  return Search(problem, at, progress, options).run();
}

}  // namespace bahnwerk::cam
