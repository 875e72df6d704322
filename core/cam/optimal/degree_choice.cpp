#include "core/cam/optimal/degree_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
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
constexpr int piece_counts[] = {1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32, 48};
constexpr int most_pieces[] = {16, 24, 48};    // counts that show what a degree can do: divided by all small ones
constexpr std::size_t most_all_pieces = 2000;  // pieces of a whole law beyond which 16 per section are enough
constexpr double little_gain = 1e-3;           // a degree that gains less is followed by one more, not by others
constexpr std::size_t most_boxes = 60;         // programs of branch and bound

class Search {
 public:
  Search(const LawTask& task, Progress progress) : task_(task), progress_(progress) {}

  SplineResult at(int degree, int pieces, const std::vector<double>& times, double gap) {
    ++programs;
    const LawBasis basis(task_, degree, pieces);
    SplineOptions options;
    options.gap = gap;
    return SplineProgram(task_, basis, times).solve(options, progress_);
  }
  int programs = 0;

 private:
  const LawTask& task_;
  Progress progress_;
};

std::vector<double> times_of(const LawTask& task, const SplineResult& spline) {
  return {spline.breaks.begin(), spline.breaks.begin() + static_cast<std::ptrdiff_t>(task.points())};
}

bool usable(const SplineResult& spline) { return spline.feasible && spline.violation <= 1e-8; }

/// Returns whether splines with a basis are splines with another one, whose pieces are parts of its own, too.
bool contains(const LawTask& task, const LawBasis& finer, const LawBasis& basis) {
  for (std::size_t s = 0; s < task.sections(); ++s)
    if (finer.section(s).pieces() % basis.section(s).pieces() != 0) return false;
  return true;
}

/// A spline, its number of pieces and J of its published law; infinite where there is none.
struct Nested {
  SplineResult spline;
  int pieces;
  double objective;
};

/// Splines whose numbers of pieces divide each other contain each other: the least J does not grow with the pieces.
/// Rounding, and programs that end before their optimum, hide that. So where no proof says that the law's J is the
/// least one to 1e-9, those of fewer pieces are looked at. Cost: at most that of all numbers that divide the given one.
class NestedSearch {
 public:
  NestedSearch(const LawTask& task, int degree, double gap, Search& search, const PublishedObjective& objective)
      : task_(task), degree_(degree), gap_(gap), search_(search), objective_(objective) {}

  /// Returns the law of the least published J among `spline`, which has that many pieces, and those of fewer.
  Nested best(SplineResult spline, int pieces) {
    const LawBasis basis(task_, degree_, pieces);
    Nested least{std::move(spline), pieces, std::numeric_limits<double>::infinity()};
    const bool found = usable(least.spline);
    if (found) least.objective = objective_(basis, least.spline);
    const bool proven = found && least.objective - least.spline.lower <= gap_ * least.objective;
    for (int divisor = pieces / 2; divisor >= 1; --divisor) {
      if (pieces % divisor != 0) continue;
      const LawBasis fewer(task_, degree_, divisor);
      if (proven && contains(task_, basis, fewer)) continue;
      auto known = known_.find(divisor);
      if (known == known_.end())
        known = known_.emplace(divisor, best(search_.at(degree_, divisor, task_.middle(), gap_), divisor)).first;
      if (known->second.objective < least.objective) least = known->second;
    }
    return least;
  }

 private:
  const LawTask& task_;
  int degree_;
  double gap_;
  Search& search_;
  const PublishedObjective& objective_;
  std::map<int, Nested> known_;  // laws by their number of pieces
};

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

void bound_law(const LawTask& task, const KnownLaw& law, DegreeChoice& choice, Progress progress, bool finely) {
  const std::string program =
      "over node values of position, velocity and acceleration with moments of the jerk in each cell of a grid";
  if (!task.free_angles()) {
    RelaxationOptions options;
    if (finely) options.cells = std::max<std::size_t>(600, 16 * task.sections());
    choice.bound = std::max(choice.bound, relaxation_bound(task, task.at, law, options, progress));
    ++choice.programs;
    choice.basis = "linear program " + program + ": every law with bounded jerk keeps it" + common_sections(task) +
                   assumption(task, law.objective());
    return;
  }
  const AllLawsBound bound = bound_over_angles(task, law, most_boxes, 1e-3, progress);
  choice.programs += static_cast<int>(bound.programs);
  choice.bound = std::max(choice.bound, bound.objective);
  choice.basis = "linear programs " + program + ", over boxes of angles (branch and bound, " +
                 std::to_string(bound.programs) + " programs" +
                 (bound.complete ? ")" : ", ended before the last box was settled)") + common_sections(task) +
                 assumption(task, law.objective());
}

DegreeChoice choose_degree(const MotionLawProblem& problem, const LawTask& task,
                           const PublishedObjective& published_objective, Progress progress) {
  DegreeChoice choice;
  Search search(task, progress);
  const double fine = SplineOptions{}.gap;
  const auto solve = [&](int degree, int pieces, double gap) {
    if (!task.free_angles()) return search.at(degree, pieces, task.middle(), gap);
    const LawBasis basis(task, degree, pieces);
    FreeAngles free = optimise_angles(task, basis, problem.seed, progress);
    search.programs += free.programs;
    return std::move(free.spline);
  };
  const auto bound_of = [&](const SplineResult& spline, int degree, int pieces, bool finely) {
    const LawBasis basis(task, degree, pieces);
    bound_law(task, KnownLaw(task, basis, spline), choice, progress, finely);
  };
  if (problem.degree) {
    choice.degree = *problem.degree;
    choice.pieces = problem.pieces;
    choice.spline = solve(choice.degree, choice.pieces, fine);
    if (!task.free_angles()) {
      NestedSearch nested(task, choice.degree, fine, search, published_objective);
      Nested best = nested.best(std::move(choice.spline), choice.pieces);
      if (best.pieces < choice.pieces)
        choice.notes.push_back("With " + std::to_string(choice.pieces) +
                               " pieces per section no law was found whose "
                               "J is less than that of one with " +
                               std::to_string(best.pieces) +
                               ", which is a law of more pieces, too: the result has these.");
      choice.pieces = best.pieces;
      choice.spline = std::move(best.spline);
    }
    if (!usable(choice.spline)) {
      const LawBasis basis(task, choice.degree, choice.pieces);
      const std::vector<double> times = choice.spline.breaks.empty() ? task.middle() : times_of(task, choice.spline);
      explain_infeasible(task, basis, times, progress);
    }
    bound_of(choice.spline, choice.degree, choice.pieces, false);
    if (choice.spline.objective > (1 + wanted_gap) * choice.bound)
      bound_of(choice.spline, choice.degree, choice.pieces, true);
    choice.programs += search.programs;
    return choice;
  }
  // A first law, for the bound and the angles.
  const int least = least_degree(task);
  const auto fits = [&](int degree) { return degree == least || is_expressible(task, degree); };
  SplineResult first;
  int first_degree = std::max(least, 7), first_pieces = 1;
  for (; first_degree <= max_degree; first_degree += 2, first_pieces = std::min(16, 2 * first_pieces)) {
    while (first_degree > least && !fits(first_degree)) --first_degree;
    // Angles elsewhere than in the middle are tried with few pieces alone: where none has a law, degrees seldom help.
    if (first_pieces > 2 && task.free_angles() && !usable(search.at(first_degree, first_pieces, task.middle(), 1e-4)))
      continue;
    first = solve(first_degree, first_pieces, 1e-6);
    if (usable(first) || (!fits(first_degree + 2) && first_pieces == 16)) break;
  }
  if (!usable(first)) {
    first_degree = std::min(first_degree, max_degree);
    const LawBasis basis(task, first_degree, 16);
    explain_infeasible(task, basis, first.breaks.empty() ? task.middle() : times_of(task, first), progress, true);
  }
  bound_of(first, first_degree, first_pieces, false);
  const std::vector<double> times = times_of(task, first);
  double target = choice.bound;
  if (task.free_angles()) {  // the bound over all angles leaves a gap that no degree can close
    const LawBasis basis(task, first_degree, first_pieces);
    const KnownLaw law(task, basis, first);
    target = std::max(target, relaxation_bound(task, law.points(), law, {}, progress));
  }
  const auto good = [&](const SplineResult& spline) {
    return usable(spline) && spline.objective <= (1 + wanted_gap) * target;
  };
  struct Tried {
    int degree, pieces;
    SplineResult spline;
  };
  std::vector<Tried> tried;
  double least_objective = std::numeric_limits<double>::infinity();
  bool found = false, finely = false;
  int without_gain = 0;
  for (int degree = least; degree <= max_degree && fits(degree) && !found && without_gain < 2; ++degree) {
    const double before = least_objective;
    for (const int pieces : most_pieces) {
      if (pieces > 16 && static_cast<std::size_t>(pieces) * task.sections() > most_all_pieces) break;
      SplineResult most = search.at(degree, pieces, times, 1e-5);
      if (!usable(most)) continue;
      found = good(most);
      least_objective = std::min(least_objective, most.objective);
      tried.push_back({degree, pieces, std::move(most)});
      if (found) break;
    }
    // A sharper bound costs less than a degree.
    if (!found && degree == least && !task.free_angles() && !tried.empty()) {
      bound_of(tried.back().spline, degree, tried.back().pieces, finely = true);
      target = choice.bound;
      found = std::any_of(tried.begin(), tried.end(), [&](const Tried& each) { return good(each.spline); });
    }
    without_gain = least_objective < before * (1 - little_gain) || tried.empty() ? 0 : without_gain + 1;
  }
  choice.degree = first_degree;
  choice.pieces = first_pieces;
  choice.spline = std::move(first);
  if (!tried.empty()) {
    // If the first bound is out of reach, the smallest degree and the fewest pieces that gain what there is to gain.
    if (!found || finely)
      target = least_objective * (1 + (task.free_angles() ? wanted_gap : little_gain)) / (1 + wanted_gap);
    Tried& smallest = *std::find_if(tried.begin(), tried.end(), [&](const Tried& each) { return good(each.spline); });
    choice.degree = smallest.degree;
    choice.pieces = smallest.pieces;
    choice.spline = std::move(smallest.spline);
    for (const int pieces : piece_counts) {
      if (pieces >= choice.pieces) break;
      if (SplineResult fewer = search.at(choice.degree, pieces, times, 1e-5); good(fewer)) {
        choice.spline = std::move(fewer);
        choice.pieces = pieces;
        break;
      }
    }
  }
  // The law is refined to the gap of laws with a given degree; a result that rounding makes worse is not taken.
  SplineResult settled;
  if (task.free_angles()) {
    FreeAngles free = refine_angles(task, LawBasis(task, choice.degree, choice.pieces), times, progress);
    search.programs += free.programs;
    settled = std::move(free.spline);
  } else {
    settled = search.at(choice.degree, choice.pieces, times, fine);
  }
  if (usable(settled) && settled.objective <= choice.spline.objective * (1 + 1e-6)) choice.spline = std::move(settled);
  if (!found)
    choice.notes.push_back(std::string("No law that was tried, of degree ") +
                           std::to_string(tried.empty() ? first_degree : tried.front().degree) + " to " +
                           std::to_string(tried.empty() ? first_degree : tried.back().degree) +
                           ", comes within 1 % of the bound" + (task.free_angles() ? " at these angles" : "") +
                           "; this is the least J among them, and more pieces or a higher degree gain little.");
  bound_of(choice.spline, choice.degree, choice.pieces, finely);
  choice.programs += search.programs;
  return choice;
}

}  // namespace bahnwerk::cam
