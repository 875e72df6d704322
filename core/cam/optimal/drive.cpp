#include "core/cam/optimal/drive.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/cam/optimal/degree_choice.hpp"
#include "core/cam/optimal/free_angles.hpp"
#include "core/cam/optimal/law_faults.hpp"
#include "core/cam/optimal/refine_pieces.hpp"
#include "core/cam/optimal/relaxation/law_bound.hpp"
#include "core/cam/spline/spline_faults.hpp"

namespace bahnwerk::cam {
namespace {

constexpr double wanted = 1e-7;  // fraction by which the cycle may be longer than its degree, pieces and angles allow
constexpr double solved = 2e-9;  // fraction of a limit that peaks stay below it, for what programs and rounding leave
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_durations = 60, most_passes = 8, most_bounds = 7, most_refinements = 10;
constexpr std::size_t most_pieces = 200;      // most pieces of a section
constexpr std::size_t most_cycle_boxes = 40;  // programs of branch and bound per duration

std::array<double, limited_orders> limits_of(const DriveLimits& drive) {
  return {0, drive.velocity, drive.acceleration, drive.jerk};
}

/// Returns whether a stretched law is one, too: all derivatives that are asked for are 0 or ranges that contain it.
bool stretches(const MotionLawProblem& problem) {
  const auto contains_zero = [](const Range& range) { return range.min <= 0 && range.max >= 0; };
  for (const MotionPoint& point : problem.points) {
    for (int r = 1; r < static_cast<int>(point.values.size()); ++r)
      if (!contains_zero(point.value(r))) return false;
    for (std::size_t r = 1; r < limited_orders; ++r)
      if (!contains_zero(point.section[r])) return false;
  }
  return problem.vibration.empty();
}

LawTask task_of(const MotionLawProblem& problem, double duration) {
  MotionLawProblem timed = problem;
  timed.cycle_duration = duration;
  LawTask task = make_law_task(timed);
  const auto limit = limits_of(*problem.drive);
  task.largest_peak = true;
  task.groups = {std::vector<std::size_t>(task.sections(), 0), {1}};
  for (std::size_t r = 1; r < limited_orders; ++r)
    task.weight[r] = std::isfinite(limit[r]) ? 1 / (limit[r] * task.to_task(static_cast<int>(r))) : 0;
  return task;
}

bool keeps_limits(const SplineResult& spline) { return spline.feasible && spline.violation <= 1e-8; }

class CycleSearch {
 public:
  CycleSearch(const MotionLawProblem& problem, ShortestCycle& result, Progress progress)
      : problem_(problem),
        result_(result),
        progress_(progress),
        monotone_(stretches(problem)),
        times_(task_of(problem, 1).middle()) {}

  void run() {
    const bool free = task_of(problem_, 1).free_angles();
    shorten(likely_duration(), free ? 1e-4 : problem_.degree ? wanted : 1e-3);
    const auto move_angles = [&](int wide, double gain) {
      for (int pass = 0; pass < most_passes && choose_angles(pass < wide, gain); ++pass)
        shorten(result_.duration, gain);
    };
    if (free) move_angles(2, problem_.degree ? 1e-5 : 1e-4);
    if (!problem_.degree) {
      refine();
      if (free) move_angles(0, 1e-5);
    }
    shorten(result_.duration, wanted);
    if (monotone_) bound();
  }

 private:
  /// Returns the time that a stroke between two points takes from rest to rest, the largest of them in parts of the
  /// cycle; 1 s where nothing is said of strokes.
  double likely_duration() const {
    const auto limit = limits_of(*problem_.drive);
    double out = 0;
    for (std::size_t s = 0; s < problem_.sections(); ++s) {
      const std::size_t e = problem_.end_point(s);
      const Range from = problem_.points[s].value(0), to = problem_.end_position(s);
      const double stroke = std::max({from.min - to.max, to.min - from.max, 0.0});
      const double share =
          (problem_.points[e].at.max - problem_.points[s].at.min + (e <= s ? problem_.length : 0)) / problem_.length;
      out = std::max(
          out,
          std::max({stroke / limit[1], std::sqrt(4 * stroke / limit[2]), std::cbrt(32 * stroke / limit[3])}) / share);
    }
    return out > 0 ? out : 1;
  }

  SplineResult solve(double duration) {
    ++result_.programs;
    const LawTask task = task_of(problem_, duration);
    return SplineProgram(task, result_.basis, times_).solve({}, progress_);
  }

  /// Returns the fraction of a limit that the peaks of a law may take.
  double target() const {
    if (result_.duration == 0) return 1 - solved;
    const LawTask task = task_of(problem_, result_.duration);
    const std::vector<double> breaks = task.breaks(times_);
    double rounding = 0;
    for (std::size_t s = 0; s < task.sections(); ++s) {
      const SectionBasis& own = result_.basis.section(s);
      double piece = 1;
      for (std::size_t i = 0; i < own.pieces(); ++i) piece = std::min(piece, own.length(i));
      piece *= breaks[s + 1] - breaks[s];
      for (int r = 1; r < limited_orders; ++r)
        rounding = std::max(rounding, task.weight[static_cast<std::size_t>(r)] *
                                          published_rounding(task, static_cast<int>(own.degree()), piece, r));
    }
    return 1 - solved - std::min(rounding, 1e-3);
  }

  [[noreturn]] void refuse(double duration) {
    const LawTask task = task_of(problem_, duration);
    explain_infeasible(task, result_.basis, times_, progress_);
  }

  /// Finds the shortest cycle at the chosen angles, to a fraction `close`; begins with a duration.
  void shorten(double duration, double close) {
    double low = 0, high = infinity, slope = 2;  // M falls like T^−slope
    double last_duration = 0, last = 0;
    for (int i = 0; i < most_durations; ++i) {
      progress_.report("shortest cycle", 0);
      SplineResult spline = solve(duration);
      if (!keeps_limits(spline)) {
        if (monotone_ && i == 0 && result_.duration == 0) refuse(duration);
        low = std::max(low, duration);
        duration = std::isfinite(high) ? std::sqrt(low * high) : 2 * duration;
        continue;
      }
      const double m = spline.objective, most = target();
      if (m <= most) {
        if (duration < high) {
          high = duration;
          result_.spline = std::move(spline);
          result_.duration = duration;
        }
        if (m >= most * (1 - close)) return;
      } else {
        low = std::max(low, duration);
      }
      if (std::isfinite(high) && low > 0 && high <= low * (1 + close)) return;
      if (last > 0 && duration != last_duration) {
        const double now = -std::log(m / last) / std::log(duration / last_duration);
        if (std::isfinite(now)) slope = std::clamp(now, 0.9, 3.1);
      }
      last = m;
      last_duration = duration;
      duration *= std::pow(m / (most * (1 - 0.3 * close)), 1 / slope);
      if (!(duration > low && duration < high))
        duration = std::isfinite(high) ? (low > 0 ? std::sqrt(low * high) : high / 2) : 2 * low;
    }
    if (result_.duration == 0) refuse(duration);
  }

  /// Takes the angles with the least peaks in the cycle as it is, if they are less by the fraction `gain`. Returns
  /// whether it does.
  bool choose_angles(bool widely, double gain) {
    const LawTask task = task_of(problem_, result_.duration);
    FreeAngles free = widely ? optimise_angles(task, result_.basis, problem_.seed, progress_)
                             : refine_angles(task, result_.basis, times_, progress_);
    result_.programs += free.programs;
    if (!keeps_limits(free.spline) || free.spline.objective > target() * (1 - gain)) return false;
    times_.assign(free.spline.breaks.begin(), free.spline.breaks.begin() + static_cast<std::ptrdiff_t>(times_.size()));
    return true;
  }

  /// Halves pieces in the cycle as it is until the peaks fall no more.
  void refine() {
    const LawTask task = task_of(problem_, result_.duration);
    SplineResult last = result_.spline;
    for (int round = 0; round < most_refinements; ++round) {
      LawBasis finer = halve_at_changes(task, result_.basis, last);
      if (finer.size() == result_.basis.size() || finer.pieces() > most_pieces) break;
      ++result_.programs;
      SplineOptions options;
      options.gap = 1e-5;
      SplineResult now = SplineProgram(task, finer, times_).solve(options, progress_);
      if (!keeps_limits(now) || now.objective > last.objective * (1 + 1e-5)) break;
      const bool little = now.objective > last.objective * (1 - 1e-4);
      result_.basis = std::move(finer);
      last = std::move(now);
      result_.spline = last;
      if (little) break;
    }
  }

  /// Finds the longest cycle, to 1e-4 (2e-3 with angles in ranges), of which the relaxation says that it is too short.
  void bound() {
    const bool free = task_of(problem_, 1).free_angles();
    const double close = free ? 2e-3 : 1e-4;  // boxes of angles are settled once they are too short, not exactly
    double proven = 0, open = result_.duration, duration = result_.duration * (free ? 1 - close / 2 : 1), slope = 2;
    double last = 0, last_duration = 0;
    for (int i = 0; i < most_bounds && open > proven * (1 + close); ++i) {
      const LawTask task = task_of(problem_, duration);
      SplineResult stretched = result_.spline;  // the same numbers in the units of this task
      stretched.objective = 0;
      for (std::size_t r = 1; r < limited_orders; ++r)
        stretched.objective = std::max(stretched.objective, task.weight[r] * stretched.peaks[r]);
      const KnownLaw law(task, result_.basis, stretched);
      const AllLawsBound least =
          bound_over_angles(task, law, most_cycle_boxes, 1e-4, progress_, free ? 1 + 5e-5 : infinity);
      result_.programs += static_cast<int>(least.programs);
      const double m = least.objective;
      (m > 1 ? proven : open) = duration;
      if (!(m > 0)) break;
      if (last > 0 && duration != last_duration) {
        const double now = -std::log(m / last) / std::log(duration / last_duration);
        if (std::isfinite(now)) slope = std::clamp(now, 0.9, 3.1);
      }
      last = m;
      last_duration = duration;
      duration *= std::pow(m / (1 + 5e-5), 1 / slope);
      if (!(duration > proven && duration < open)) duration = proven > 0 ? std::sqrt(proven * open) : 0.9 * open;
    }
    if (proven > 0)
      result_.bound = CycleBound{proven,
                                 "linear programs over the states of a grid, in which the peaks exceed the drive's "
                                 "limits: every law with bounded jerk keeps them"};
  }

  const MotionLawProblem& problem_;
  ShortestCycle& result_;
  Progress progress_;
  bool monotone_;
  std::vector<double> times_;
};

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace

void check_drive(const MotionLawProblem& problem) {
  const auto limit = limits_of(problem.drive.value_or(DriveLimits{}));
  if (std::none_of(limit.begin() + 1, limit.end(), [](double each) { return std::isfinite(each); }))
    throw InvalidInput(
        {InputFault{{"drive"}, "a cycle without duration needs a limit of velocity, acceleration or jerk"}});
  static constexpr const char* units[] = {"", "/s", "/s²", "/s³"};
  std::vector<InputFault> faults;
  for (std::size_t i = 0; i < problem.points.size(); ++i)
    for (int r = 1; r < limited_orders; ++r) {
      const auto o = static_cast<std::size_t>(r);
      const std::string unit = " " + problem.slave_unit + units[r], point = std::to_string(i);
      const auto look = [&](const Range& range, std::vector<std::string> place) {
        const double least = std::max({range.min, -range.max, 0.0});
        if (least > limit[o])
          faults.push_back({std::move(place), "asks for a " + std::string(order_name(r)) + " of " + short_text(least) +
                                                  unit + ", and the drive can " + short_text(limit[o]) + unit +
                                                  ": take less, or raise drive/" + order_name(r)});
      };
      look(problem.points[i].value(r), {"points", point, order_name(r)});
      look(problem.points[i].section[o], {"points", point, "section", order_name(r)});
    }
  if (!faults.empty()) throw InvalidInput(std::move(faults));
  if (stretches(problem) && problem.points_stroke() == 0)
    throw InvalidInput({InputFault{{"drive"},
                                   "nothing has to move: every cycle is long enough, and none is the shortest. Give "
                                   "master/cycle_duration, or positions that differ"}});
}

ShortestCycle find_shortest_cycle(const MotionLawProblem& problem, Progress progress) {
  const LawTask task = task_of(problem, 1);
  const int pieces = problem.degree ? problem.pieces : std::clamp(96 / static_cast<int>(task.sections()), 8, 24);
  ShortestCycle result(LawBasis(task, problem.degree.value_or(least_degree(task)), pieces));
  CycleSearch(problem, result, progress).run();
  return result;
}

}  // namespace bahnwerk::cam
