#include "core/redundant/iterative/iterative.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "core/base/errors.hpp"
#include "core/numeric/windows.hpp"
#include "core/redundant/iterative/coarse_motion.hpp"

namespace bahnwerk {
namespace {

void check(const RedundancyTask& task, const RedundancyOptions& options) {
  const auto refuse = [](const char* field, const std::string& why) {
    throw InvalidInput({{{"machine", "redundancy", field}, why}});
  };
  if (options.degree < 2 || options.degree > static_cast<int>(max_spline_degree))
    refuse("degree", "the degree of the coarse axes' splines is 2 to 5");
  const int smooth = task.machine.limited_order() - 1;
  if (options.knot_multiplicity < 1 || options.degree - options.knot_multiplicity < smooth)
    refuse("knot_multiplicity", smooth == 2 ? "with limited jerk knots count at most degree − 2 times"
                                            : "knots count at most degree − 1 times");
  if (options.afterburner < 0) refuse("afterburner", "the number of passes is not negative");
  if (options.thinning < 1) refuse("thinning", "every sample counts, or every second, third …");
  if (options.window && (options.window->blocks < 1 || options.window->overlap >= options.window->blocks))
    refuse("window", "windows overlap by less than their blocks");
}

/// A share of the fine accelerations with which a motion is searched.
struct Share {
  double value;
  const char* note;
};
constexpr Share shares[] = {
    {1, nullptr},
    {0.5, "no motion was found with all of the fine axes' accelerations, but with half of them"},
    {0.25, "no motion was found with all of the fine axes' accelerations, but with a quarter of them"}};
constexpr double resolved_share = 0.2;  // share of the stroke that samples of every cycle leave to the fit

/// Returns the task with fine accelerations with which a fine axis cannot use up its stroke between samples of every
/// cycle. So more acceleration than that is not slower: the same motion is planned.
RedundancyTask resolved(RedundancyTask task, const RedundancyOptions& options) {
  if (options.thinning != 1) return task;  // the document's own distance of samples
  const double cycle = task.machine.cycle_time;
  for (CoarseFineAxis& axis : task.machine.axes) {
    const double most = 4 * (1 - resolved_share) * axis.stroke / (cycle * cycle);  // half of it each for fit and check
    axis.fine.acceleration = std::min(axis.fine.acceleration, most);
  }
  return task;
}

/// Returns the task with that share of its fine accelerations.
RedundancyTask with_less(RedundancyTask task, double share) {
  for (CoarseFineAxis& axis : task.machine.axes) axis.fine.acceleration *= share;
  return task;
}

class Planner {
 public:
  /// Plans `less`, which has the task's limits or smaller ones.
  Planner(const RedundancyTask& task, RedundancyTask less, const RedundancyOptions& options,
          const IterativeOptions& constants, Progress progress)
      : task_(task),
        less_(std::move(less)),
        options_(options),
        constants_(constants),
        split_(less_, options, constants, progress) {}

  /// Searches a motion. Returns the reason if there is none.
  std::optional<NoPlan> find() {
    if (!split_.resolves_samples()) return NoPlan::samples_apart;
    result_.fastest = split_.fastest();
    coarse_.resize(task_.machine.axes.size());
    const bool found = search();
    result_.slowed = split_.slowed(), result_.passes = split_.passes();
    result_.iterations = result_.passes.size();
    return found ? std::nullopt : std::optional(NoPlan::no_split);
  }
  RedundancyResult result() {
    result_.coarse_jerk_limited = options_.degree - options_.knot_multiplicity >= 2;
    result_.head = std::make_shared<const PathMotion>(task_.path, std::move(law_));
    std::vector<Limits> limits;
    for (const CoarseFineAxis& axis : task_.machine.axes) limits.push_back(axis.coarse);
    result_.coarse = coarse_motion(coarse_, result_.head->duration(), limits);
    if (rescues_ > 0)
      result_.notes.push_back("all axes stop at " + std::to_string(rescues_) +
                              " more places, because windows could not be joined in motion");
    if (options_.window) result_.notes.push_back("the contour was planned in " + std::to_string(windows_) + " windows");
    return std::move(result_);
  }

 private:
  const HeadSections& sections() const { return split_.sections(); }

  /// Returns the head's resting position.
  std::vector<SplineBegin> at_head() const {
    std::vector<SplineBegin> begin(coarse_.size());
    const AxisJet q = task_.path->at_parameter(0, (*task_.path)[0].curve().begin());
    for (std::size_t k = 0; k < begin.size(); ++k) begin[k] = {q.value[k], 0, 0, task_.machine.limited_order(), {}};
    return begin;
  }
  /// Returns the coarse axes' states at time t of a part.
  std::vector<SplineBegin> state(const SplitPart& part, double t) const {
    std::vector<SplineBegin> begin(coarse_.size());
    for (std::size_t k = 0; k < begin.size(); ++k) {
      const TimeSpline& axis = part.coarse[k];
      const std::size_t piece = axis.find(t, 0);
      const AxisState x = axis.in_piece(piece, t);
      const bool ends = t >= axis.duration();  // at rest, but for rounding
      begin[k] = {x.x, ends ? 0 : x.v, ends ? 0 : x.a, task_.machine.limited_order(), {}};
    }
    return begin;
  }

  /// Plans in windows by Algorithm 4.2, which begin where the head rests, or the whole contour in one. Returns false if
  /// there is no motion.
  bool search() {
    struct Place {
      std::size_t begin;  // section
      std::vector<SplineBegin> state;
    };
    const std::size_t n = sections().size();
    std::optional<SplitPart> before;  // solved, and kept up to where this window begins
    const Place reached = solve_windows(Place{0, at_head()}, n, [&](const Place& here, auto*) -> WindowResult<Place> {
      const std::size_t last = window_end(here.begin);
      std::optional<SplitPart> part = split_.solve(here.begin, last, here.state);
      if (!part) {
        if (!before || before->last == here.begin) return WindowRetry::none;
        keep(*before, before->last);  // to its end, at rest
        ++rescues_;
        Place rest{before->last, state(*before, before->coarse.front().duration())};
        before.reset();
        return rest;
      }
      if (before) keep(*before, here.begin);
      ++windows_;
      before = std::move(part);
      const std::size_t kept = keeps(here.begin, last);
      return Place{kept, state(*before, time_of(*before, kept))};
    });
    if (before) keep(*before, reached.begin);
    return reached.begin == n;
  }

  bool long_move(std::size_t section) const {
    const std::size_t i = sections().begin(section);
    if (sections().begin(section + 1) != i + 1 || !task_.path->linear(i)) return false;
    double stroke = 0;
    for (const CoarseFineAxis& axis : task_.machine.axes) stroke = std::max(stroke, axis.stroke);
    return (*task_.path)[i].length() > constants_.long_move * stroke;
  }

  /// Returns the index behind the last section of the window that begins at `first`: as many blocks as requested,
  /// rounded to whole sections. Long moves are windows of their own.
  std::size_t window_end(std::size_t first) const {
    if (!options_.window) return sections().size();
    std::size_t last = first + 1;
    if (long_move(first)) return last;
    const std::size_t wished = sections().begin(first) + options_.window->blocks;
    while (last < sections().size() && sections().begin(last) < wished && !long_move(last)) ++last;
    return last;
  }
  /// Returns the section up to which a window is kept.
  std::size_t keeps(std::size_t first, std::size_t last) const {
    if (last == sections().size() || long_move(last) || long_move(first)) return last;
    std::size_t kept = last;
    while (kept > first + 1 && sections().begin(last) - sections().begin(kept) < options_.window->overlap) --kept;
    return kept;
  }

  /// Returns when a part reaches the begin of a section, before the dwells there.
  double time_of(const SplitPart& part, std::size_t section) const {
    if (section >= part.last) return part.law.duration();
    return part.law.pieces()[pieces_before(part, section)].t0;
  }
  std::size_t pieces_before(const SplitPart& part, std::size_t section) const {
    const auto& pieces = part.law.pieces();
    if (section >= part.last) return pieces.size();
    const std::size_t segment = sections().begin(section);
    return static_cast<std::size_t>(std::lower_bound(pieces.begin(), pieces.end(), segment,
                                                     [](const LawPiece& p, std::size_t s) { return p.segment < s; }) -
                                    pieces.begin());
  }

  void keep(const SplitPart& part, std::size_t until) {
    const std::size_t n = pieces_before(part, until);
    const double t = time_of(part, until);
    law_.reserve(n);
    for (std::size_t i = 0; i < n; ++i) law_.append(part.law.pieces()[i]);
    for (std::size_t k = 0; k < coarse_.size(); ++k) coarse_[k].append(part.coarse[k], t, law_.duration());
  }

  const RedundancyTask& task_;
  const RedundancyTask less_;
  const RedundancyOptions& options_;
  const IterativeOptions& constants_;
  AdaptiveSplit split_;
  RedundancyResult result_;
  TimeLaw law_;
  std::vector<TimeSpline> coarse_;
  std::size_t windows_ = 0, rescues_ = 0;
};

}  // namespace

Expected<RedundancyResult, NoPlan> plan_iterative(const RedundancyTask& task, const RedundancyOptions& options,
                                                  const IterativeOptions& constants, Progress progress) {
  check(task, options);
  const RedundancyTask less = resolved(task, options);
  NoPlan why_not = NoPlan::no_split;
  // Limits that fall by and by may end where others would not: a motion with less acceleration is one, too.
  for (const Share& share : shares) {
    Planner planner(task, with_less(less, share.value), options, constants, progress);
    progress = progress.part(1, 1);
    if (const std::optional<NoPlan> none = planner.find()) {
      why_not = *none;
      continue;
    }
    RedundancyResult result = planner.result();
    if (share.note != nullptr) result.notes.emplace_back(share.note);
    return result;
  }
  return why_not;
}

Expected<RedundancyResult, NoPlan> plan_iterative(const RedundancyTask& task, const RedundancyOptions& options,
                                                  Progress progress) {
  return plan_iterative(task, options, IterativeOptions(), progress);
}

}  // namespace bahnwerk
