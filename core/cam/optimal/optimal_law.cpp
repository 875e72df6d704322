#include "core/cam/optimal/optimal_law.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/cam/optimal/degree_choice.hpp"
#include "core/cam/optimal/drive.hpp"
#include "core/cam/optimal/law_faults.hpp"
#include "core/cam/optimal/program/spline_program.hpp"
#include "core/cam/optimal/relaxation/law_bound.hpp"
#include "core/cam/optimal/rest_to_rest.hpp"
#include "core/cam/optimal/straight_sections.hpp"

namespace bahnwerk::cam {
namespace {

MotionLawProblem with_duration(MotionLawProblem problem, double duration) {
  problem.cycle_duration = duration;
  return problem;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// Both ends of a straight section: the numbers of its points, if there are any.
std::vector<double> straight_line(const MotionLawProblem& problem, const LawTask& task, std::size_t section,
                                  double begin, double length) {
  const double rise = *task.constant_velocity(section) * length * task.unit_position;
  const Range from = problem.points[section].value(0), to = problem.end_position(section);
  if (from.fixed()) return {from.min, to.fixed() ? to.min : from.min + rise};
  const double start = to.fixed() ? to.min - rise : task.origin + task.unit_position * begin;
  return {start, to.fixed() ? to.min : start + rise};
}

/// Given sections with their own pieces, straight ones as a line each.
CamLaw to_law(const MotionLawProblem& problem, const LawTask& task, const LawBasis& basis, const SplineResult& spline) {
  std::vector<double> breaks;
  std::vector<LawPiece> pieces;
  const double begin = problem.points.front().at.min * problem.seconds_per_unit();
  const auto add = [&](std::size_t section, double time, std::vector<double> bernstein) {
    breaks.push_back(begin + task.unit_time * time);
    pieces.push_back({section, std::move(bernstein)});
  };
  const auto in_user_units = [&](std::vector<double> bernstein) {
    for (double& b : bernstein) b = task.origin + task.unit_position * b;
    return bernstein;
  };
  for (std::size_t section = 0; section < task.sections(); ++section) {
    const double from = spline.breaks[section], length = spline.breaks[section + 1] - from;
    const double* const coefficients = spline.coefficients.data() + basis.first(section);
    if (task.is_given(section)) {
      const GivenSection& given = task.given[section]->law;
      for (std::size_t i = 0; i < given.bernstein.size(); ++i)
        add(section, from + length * given.breaks[i], in_user_units(given.bernstein[i]));
    } else if (task.constant_velocity(section)) {
      add(section, from, straight_line(problem, task, section, coefficients[0], length));
    } else {
      const SectionBasis& own = basis.section(section);
      for (std::size_t piece = 0; piece < own.pieces(); ++piece) {
        std::vector<double> b(own.degree() + 1);
        own.bernstein(piece, coefficients, 0, b.data());
        add(section, from + length * own.begin(piece), in_user_units(std::move(b)));
      }
    }
  }
  breaks.push_back(begin + task.unit_time * spline.breaks.back());
  return CamLaw(std::move(breaks), std::move(pieces), problem.periodic, problem.travel);
}

/// Returns the law with all peaks and with J as the problem weighs them: the drive's program knows the limited ones.
SplineResult in_weights(const MotionLawProblem& problem, const LawTask& task, const LawBasis& basis,
                        SplineResult spline) {
  const LawValue value = evaluate_objective(problem, to_law(problem, task, basis, spline));
  for (std::size_t r = 1; r < limited_orders; ++r)
    spline.peaks[r] = value.peaks[r].value * task.to_task(static_cast<int>(r));
  spline.objective = value.objective;
  return spline;
}

/// Returns whether rounding of the published positions leaves all derivatives that a law has to keep. Else the task's
/// sizes become those of the law.
bool is_published(LawTask& task, const LawBasis& basis, const SplineResult& spline, const CamLaw& law) {
  std::array<double, limited_orders> size = task.size;
  const LawExtremes positions = law.extremes(0);
  double least = (positions.highest.value - positions.lowest.value) / task.unit_position;  // stroke by cycle^r
  for (int r = 1; r < limited_orders; ++r) {
    double& own = size[static_cast<std::size_t>(r)];
    least /= task.cycle;
    own = std::min(own, std::max(least, law.peak(r).value * task.to_task(r)));
  }
  for (std::size_t s = 0; s < task.sections(); ++s) {
    if (task.is_given(s) || task.constant_velocity(s)) continue;
    const int order = kept_order(task, s);
    const double length = (spline.breaks[s + 1] - spline.breaks[s]) / static_cast<double>(basis.section(s).pieces());
    if (published_rounding(task, static_cast<int>(basis.degree()), length, order) <=
        1e-4 * size[static_cast<std::size_t>(order)])
      continue;
    task.size = size;
    return false;
  }
  return true;
}

/// Adds a note if the law leaves the positions' range between its points, and on what would prevent it: small peaks
/// alone do not keep it there.
void note_overshoot(const MotionLawProblem& problem, const CamLaw& law, std::vector<std::string>& notes) {
  const double stroke = problem.points_stroke();
  for (std::size_t section = 0; section < problem.sections(); ++section) {
    const MotionPoint& from = problem.points[section];
    const Range a = from.value(0), b = problem.end_position(section);
    if (from.law || !from.section[0].free() || !std::isfinite(a.min + a.max + b.min + b.max)) continue;
    const double low = std::min(a.min, b.min), high = std::max(a.max, b.max);
    const LawExtremes extremes = law.section_extremes(0, section);
    const double over = std::max(extremes.highest.value - high, low - extremes.lowest.value);
    if (!(over > 1e-4 * std::max(stroke, high - low))) continue;
    const double room = high - low > over ? 0 : over / 10;  // a dwell needs some
    const bool rises = b.min > a.max, falls = b.max < a.min;
    const std::string limit =
        rises   ? "\"velocity\": {\"min\": 0}"
        : falls ? "\"velocity\": {\"max\": 0}"
                : "\"position\": {\"min\": " + number(low - room) + ", \"max\": " + number(high + room) + "}";
    notes.push_back("Section " + std::to_string(section) + ", from point " + std::to_string(section) +
                    ", leaves the range of its points by " + number(over) + " " + problem.slave_unit +
                    ". If it must not, add to point " + std::to_string(section) + ": \"section\": {" + limit + "}.");
  }
}

/// Returns whether a law is a spline of that degree in all sections that are free.
bool has_degree(const CamLaw& law, const LawTask& task, int degree) {
  for (std::size_t i = 0; i < law.pieces(); ++i)
    if (!task.is_given(law.piece(i).section) && law.piece(i).degree() > static_cast<std::size_t>(degree)) return false;
  return true;
}

}  // namespace

OptimalLaw plan_optimal_law(const MotionLawProblem& given, Progress progress, const LawSolution* candidate) {
  check_classical_sections(given);
  MotionLawProblem problem = with_straight_sections(given);
  problem.objective.zero_crossing_penalty = 0;
  OptimalLaw result;
  LawSolution& solution = result.solution;
  DegreeChoice chosen;
  const bool shortest = !problem.cycle_duration;
  std::optional<RestToRest> direct;
  std::optional<LawBasis> basis;
  if (shortest) {
    check_drive(problem);
    if (!problem.degree) direct = rest_to_rest(problem);
    const LawTask task = make_law_task(with_duration(problem, 1));
    check_lengths(problem, task, direct ? 3 : problem.degree.value_or(least_degree(task)));
  }
  if (direct) {
    problem.cycle_duration = direct->duration;
    chosen.degree = 3, chosen.pieces = 7;
    chosen.notes.push_back(
        "The cycle is the shortest within the drive's limits, in closed form: constant jerk, "
        "acceleration and velocity from rest to rest.");
    if (direct->duration > direct->bound * (1 + 1e-9))
      chosen.notes.push_back("Without a limit of jerk no law reaches the shortest cycle, " + number(direct->bound) +
                             " s: its acceleration would jump. This one has ramps.");
    solution.cycle_bound = CycleBound{direct->bound, "time-optimal motion from rest to rest in each section"};
  } else if (shortest) {
    ShortestCycle cycle = find_shortest_cycle(problem, progress);
    problem.cycle_duration = cycle.duration;
    chosen = {static_cast<int>(cycle.basis.degree()),
              static_cast<int>(cycle.basis.pieces()),
              std::move(cycle.spline),
              0,
              "",
              cycle.programs,
              {}};
    basis = std::move(cycle.basis);
    chosen.notes.push_back("The cycle is the shortest within the drive's limits for degree " +
                           std::to_string(chosen.degree) + " and " + (problem.degree ? "" : "up to ") +
                           std::to_string(chosen.pieces) + " pieces per section" +
                           (problem.has_free_angles() ? ", at the angles that were found" : "") +
                           (cycle.bound ? ": no law at all has one of " + number(cycle.bound->duration) + " s or less."
                                        : ". Values other than 0 were asked for, or vibration: a shorter cycle may "
                                          "exist that is not next to this one."));
    solution.cycle_bound = std::move(cycle.bound);
  }
  check_contradictions(problem, given);
  LawTask task = make_law_task(problem);
  if (direct) {
    solution.law = direct->law;
    const double objective = evaluate_objective(problem, direct->law).objective;
    bound_law(task, KnownLaw(task, direct->law, task.middle(), objective), chosen, progress);
  } else if (shortest) {
    const KnownLaw law(task, *basis, in_weights(problem, task, *basis, chosen.spline));
    bound_law(task, law, chosen, progress);
  } else {
    check_lengths(problem, task, problem.degree.value_or(least_degree(task)));
    const PublishedObjective published = [&](const LawBasis& tried, const SplineResult& spline) {
      return evaluate_objective(problem, to_law(problem, task, tried, spline)).objective;
    };
    // Where the law's derivatives are smaller than usual, short sections have fewer pieces or are refused.
    for (int round = 0; round < 3; ++round) {
      chosen = choose_degree(problem, task, published, progress);
      const LawBasis tried(task, chosen.degree, chosen.pieces);
      if (is_published(task, tried, chosen.spline, to_law(problem, task, tried, chosen.spline))) break;
      check_lengths(problem, task, problem.degree.value_or(least_degree(task)));
    }
  }
  result.degree = chosen.degree;
  result.pieces = chosen.pieces;
  solution.notes = chosen.notes;
  if (!basis) basis.emplace(task, chosen.degree, chosen.pieces);
  if (problem.objective.then_order > 0 && !shortest) {
    const std::vector<double> times(chosen.spline.breaks.begin(),
                                    chosen.spline.breaks.begin() + static_cast<std::ptrdiff_t>(task.points()));
    chosen.spline = SplineProgram(task, *basis, times).least_rms(problem.objective.then_order, chosen.spline, progress);
    ++chosen.programs;
  }
  const SplineResult& spline = chosen.spline;
  if (!direct) solution.law = to_law(problem, task, *basis, spline);
  solution.cycle_duration = *problem.cycle_duration;
  for (std::size_t i = 0; i < task.points(); ++i)
    solution.at.push_back(task.at[i].fixed()
                              ? problem.points[i].at.min
                              : problem.points.front().at.min + spline.breaks[i] * problem.length / task.cycle);
  solution.value = evaluate_objective(problem, solution.law);
  if (candidate && !task.free_angles() && !shortest && !problem.effort &&
      has_degree(candidate->law, task, chosen.degree))
    if (const LawValue value = evaluate_objective(problem, candidate->law);
        value.objective < solution.value.objective * (1 - (problem.objective.then_order > 0 ? 1e-8 : 1e-12))) {
      solution.law = candidate->law;
      solution.value = value;
    }
  solution.degrees.assign(problem.sections(), 0);
  for (std::size_t i = 0; i < solution.law.pieces(); ++i) {
    int& degree = solution.degrees[solution.law.piece(i).section];
    degree = std::max(degree, static_cast<int>(solution.law.piece(i).degree()));
  }
  solution.systems = static_cast<std::size_t>(chosen.programs);
  if (direct) {
    result.proven = true;
  } else if (shortest) {
    // The law was made for the cycle, not for J: what J could be at its angles says another program.
    const std::vector<double> times(spline.breaks.begin(),
                                    spline.breaks.begin() + static_cast<std::ptrdiff_t>(task.points()));
    ++solution.systems;
    const SplineResult least = SplineProgram(task, *basis, times).solve({}, progress);
    if (least.feasible) solution.lower = std::min(least.lower, solution.value.objective);
  } else {
    solution.lower = std::min(spline.lower, solution.value.objective);
    result.proven = solution.value.objective - *solution.lower <= 1e-7 * solution.value.objective;
  }
  if (!result.proven && !(solution.lower.value_or(0) > 0))
    solution.notes.push_back("No least J above 0 is proven: what this law has may be rounding.");
  else if (!result.proven)
    solution.notes.push_back("The law is proven to be within " +
                             number(100 * (solution.value.objective / *solution.lower - 1)) +
                             " % of the least J of its degree, pieces and angles.");
  solution.bound = LawBound{std::min(chosen.bound, solution.value.objective), chosen.basis};
  note_overshoot(problem, solution.law, solution.notes);
  if (given.objective.zero_crossing_penalty > 0)
    solution.notes.push_back(
        "zero_crossing_penalty is not part of method optimal, whose problem is convex: section limits of velocity say "
        "the same exactly.");
  return result;
}

}  // namespace bahnwerk::cam
