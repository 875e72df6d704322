#include "core/cam/optimal/degree_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/progress.hpp"
#include "core/cam/optimal/free_angles.hpp"
#include "core/cam/optimal/law_faults.hpp"
#include "core/cam/optimal/relaxation/law_bound.hpp"
#include "core/cam/optimal/relaxation/relaxation.hpp"

namespace bahnwerk::cam {
namespace {

constexpr double wanted_gap = 0.01;
constexpr int most_pieces = 16;
constexpr int hopeless_degrees =
    3;  // the search over free angles ends after so many degrees in a row that gain nothing
constexpr std::size_t most_boxes = 60;  // programs of branch and bound

class Search {
 public:
  Search(const LawTask& task, Progress& progress) : task_(task), progress_(progress) {}

  SplineResult at(int degree, int pieces, const std::vector<double>& times, double gap) {
    ++programs;
    const SectionBasis basis(degree, pieces);
    SplineOptions options;
    options.gap = gap;
    return SplineProgram(task_, basis, times).solve(options, progress_);
  }
  int programs = 0;

 private:
  const LawTask& task_;
  Progress& progress_;
};

std::vector<double> times_of(const LawTask& task, const SplineResult& spline) {
  return {spline.breaks.begin(), spline.breaks.begin() + static_cast<std::ptrdiff_t>(task.points())};
}

bool usable(const SplineResult& spline) { return spline.feasible && spline.violation <= 1e-8; }

}  // namespace

int least_degree(const LawTask& task) {
  int degree = 3;
  for (std::size_t i = 0; i < task.points(); ++i)
    if (task.joint(i)) degree = std::max(degree, task.continuity[i] + 1);
  return std::min(degree, max_degree);
}

namespace {

/// Returns what the laws under a bound have in common, if the bound is not over all laws.
const char* common_sections(const LawTask& task) {
  const bool any =
      std::any_of(task.given.begin(), task.given.end(), [](const auto& given) { return given.has_value(); });
  return any ? "; over all laws that contain the classical sections" : "";
}

/// Returns what a bound assumes if neither weights nor conditions limit what rounding of its multipliers is worth.
const char* assumption(const LawTask& task, double objective) {
  return task.weight[1] > 0 && task.weight[2] > 0 && position_bound(task, objective) > 0
             ? ""
             : "; for laws whose position, velocity and acceleration stay below a thousand times this one's";
}

}  // namespace

void bound_law(const LawTask& task, const KnownLaw& law, DegreeChoice& choice, Progress& progress) {
  const std::string program =
      "over node values of position, velocity and acceleration with moments of the jerk in each cell of a grid";
  if (!task.free_angles()) {
    choice.bound = relaxation_bound(task, task.at, law, {}, progress);
    ++choice.programs;
    choice.basis = "linear program " + program + ": every law with bounded jerk keeps it" + common_sections(task) +
                   assumption(task, law.objective());
    return;
  }
  const AllLawsBound bound = bound_over_angles(task, law, most_boxes, 1e-3, progress);
  choice.programs += static_cast<int>(bound.programs);
  choice.bound = bound.objective;
  choice.basis = "linear programs " + program + ", over boxes of angles (branch and bound, " +
                 std::to_string(bound.programs) + " programs" +
                 (bound.complete ? ")" : ", ended before the last box was settled)") + common_sections(task) +
                 assumption(task, law.objective());
}

DegreeChoice choose_degree(const MotionLawProblem& problem, const LawTask& task, Progress& progress) {
  DegreeChoice choice;
  Search search(task, progress);
  const double fine = SplineOptions{}.gap;
  const auto solve = [&](int degree, int pieces, double gap) {
    if (!task.free_angles()) return search.at(degree, pieces, task.middle(), gap);
    const SectionBasis basis(degree, pieces);
    FreeAngles free = optimise_angles(task, basis, problem.seed, progress);
    search.programs += free.programs;
    return std::move(free.spline);
  };
  const auto bound_of = [&](const SplineResult& spline, int degree, int pieces) {
    const SectionBasis basis(degree, pieces);
    bound_law(task, KnownLaw(task, basis, spline), choice, progress);
  };
  if (problem.degree) {
    choice.degree = *problem.degree;
    choice.pieces = problem.pieces;
    choice.spline = solve(choice.degree, choice.pieces, fine);
    if (!usable(choice.spline)) {
      const SectionBasis basis(choice.degree, choice.pieces);
      const std::vector<double> times = choice.spline.breaks.empty() ? task.middle() : times_of(task, choice.spline);
      explain_infeasible(task, basis, times, progress);
      throw InvalidInput(
          std::vector{InputFault{{"degree"}, "no law of this degree keeps all values, ranges and limits"}});
    }
    bound_of(choice.spline, choice.degree, choice.pieces);
    choice.programs += search.programs;
    return choice;
  }
  // A first law, for the bound and the angles.
  const int least = least_degree(task);
  SplineResult first;
  int first_degree = std::max(least, 7), first_pieces = 1;
  for (; first_degree <= max_degree; first_degree += 2, first_pieces = std::min(most_pieces, 2 * first_pieces)) {
    // Angles elsewhere than in the middle are tried with few pieces alone: where none has a law, degrees seldom help.
    if (first_pieces > 2 && task.free_angles() && !usable(search.at(first_degree, first_pieces, task.middle(), 1e-4)))
      continue;
    first = solve(first_degree, first_pieces, 1e-6);
    if (usable(first)) break;
  }
  if (!usable(first)) {
    const SectionBasis basis(max_degree, 1);
    explain_infeasible(task, basis, first.breaks.empty() ? task.middle() : times_of(task, first), progress);
    throw Infeasible("no law up to degree 21 keeps all values, ranges and limits");
  }
  bound_of(first, first_degree, first_pieces);
  const std::vector<double> times = times_of(task, first);
  double target = choice.bound;
  if (task.free_angles()) {  // the bound over all angles leaves a gap that no degree can close
    const SectionBasis basis(first_degree, first_pieces);
    const KnownLaw law(task, basis, first);
    target = std::max(target, relaxation_bound(task, law.points(), law, {}, progress));
  }
  const auto good = [&](const SplineResult& spline) {
    return usable(spline) && spline.objective <= (1 + wanted_gap) * target;
  };
  struct Tried {
    int degree;
    SplineResult spline;
  };
  std::vector<Tried> tried;  // results with the most pieces
  double least_objective = std::numeric_limits<double>::infinity();
  bool found = false;
  int without_gain = 0;
  for (int degree = least; degree <= max_degree && !found && !(task.free_angles() && without_gain == hopeless_degrees);
       ++degree) {
    // More pieces are never worse if they divide each other: the largest number comes first.
    SplineResult most = search.at(degree, most_pieces, times, 1e-5);
    found = good(most);
    const bool gains = usable(most) && most.objective < least_objective * (1 - 1e-4);
    if (gains) least_objective = most.objective;
    if (usable(most)) tried.push_back({degree, std::move(most)});
    without_gain = gains || tried.empty() ? 0 : without_gain + 1;
  }
  choice.degree = first_degree;
  choice.pieces = first_pieces;
  choice.spline = std::move(first);
  if (!tried.empty()) {
    // If the bound is out of reach, the least J counts with free angles, whose refinement is dear; else the smallest
    // degree within 1 %.
    if (!found) target = least_objective * (task.free_angles() ? 1 : (1 + 1e-4) / (1 + wanted_gap));
    Tried& smallest = *std::find_if(tried.begin(), tried.end(), [&](const Tried& each) { return good(each.spline); });
    choice.degree = smallest.degree;
    choice.spline = std::move(smallest.spline);
    for (choice.pieces = 1; choice.pieces < most_pieces; ++choice.pieces)
      if (SplineResult fewer = search.at(choice.degree, choice.pieces, times, 1e-5); good(fewer)) {
        choice.spline = std::move(fewer);
        break;
      }
  }
  // The law is refined to the gap of laws with a given degree; a result that rounding makes worse is not taken.
  SplineResult settled;
  if (task.free_angles()) {
    FreeAngles free = refine_angles(task, SectionBasis(choice.degree, choice.pieces), times, progress);
    search.programs += free.programs;
    settled = std::move(free.spline);
  } else {
    settled = search.at(choice.degree, choice.pieces, times, fine);
  }
  if (usable(settled) && settled.objective <= choice.spline.objective * (1 + 1e-6)) choice.spline = std::move(settled);
  if (!found)
    choice.notes.push_back(
        task.free_angles()
            ? "No degree up to 21 with up to 16 pieces comes within 1 % of the bound at these angles; this is the "
              "smallest within 1 % of the least J among them."
            : "No degree up to 21 with up to 16 pieces comes within 1 % of the bound; this is the least J among them.");
  bound_of(choice.spline, choice.degree, choice.pieces);
  choice.programs += search.programs;
  return choice;
}

}  // namespace bahnwerk::cam
