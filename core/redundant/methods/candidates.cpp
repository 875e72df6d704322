#include "core/redundant/methods/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <utility>

#include "core/base/infeasible_at.hpp"
#include "core/redundant/coarse/coarse_alone.hpp"
#include "core/redundant/coarse/coarse_task.hpp"
#include "core/redundant/joint/energy.hpp"
#include "core/redundant/joint/joint.hpp"
#include "core/redundant/known/reparametrise.hpp"
#include "core/redundant/methods/method_table.hpp"
#include "core/redundant/methods/reversed_task.hpp"

namespace bahnwerk {
namespace {

constexpr double symmetric = 5e-4;     // share of the bound by which durations forwards and backwards may differ
constexpr double quicker = 1e-9;       // least gain, relative to a duration; less is rounding
constexpr double timing_begins = 0.7;  // share of the progress after which a motion is timed again

/// What a candidate's worth depends on.
struct Situation {
  const RedundancyTask& task;
  const RedundancyOptions& options;
  const RedundancyResult* best;  ///< quickest plan of the step so far; null: there is none
};

bool joint_asked(const Situation& s) { return s.options.method == RedundancyMethod::joint; }
bool centred(const CoarseFineMachine& machine) {
  return std::any_of(machine.axes.begin(), machine.axes.end(), [](const CoarseFineAxis& a) { return a.centred; });
}
/// Tells whether the joint planner takes the place of the method that was asked for.
bool joint_instead(const Situation& s) { return !joint_asked(s) && !centred(s.task.machine); }
bool any_instead(const Situation& s) { return !joint_asked(s); }
/// Returns the factor of the shortest duration that was asked for.
double stretch(const RedundancyOptions& options) {
  if (options.method != RedundancyMethod::joint) return 1;
  return options.stretch >= 1 ? options.stretch : stretch_of(options.smoothness);
}
/// Tells whether the bound leaves more than `symmetric` open, or whether there is no plan.
bool open(const Situation& s) {
  if (s.best == nullptr) return true;
  return s.task.bound > 0 && s.best->head->duration() > s.task.bound * stretch(s.options) * (1 + symmetric);
}
/// Tells whether the coarse axes can do the motion alone and no split is as quick as the head by itself.
bool coarse_axes_may_be_quicker(const Situation& s) {
  return (s.best == nullptr || (s.best->slowed_count > 0 && s.task.path->size() > 1)) &&
         within_coarse_range(*s.task.path, s.task.machine);
}

struct Candidate {
  int step;
  CandidatePlanner planner;
  bool backwards;  ///< whether the contour is planned from its end to its begin
  bool (*worth)(const Situation&);
};

using enum CandidatePlanner;

constexpr Candidate candidates[] = {
    // step, planner, backwards, worth trying
    {0, asked_timed_again, false,
     [](const Situation& s) { return s.options.reparametrise && s.task.machine.limited_order() == 2; }},
    {1, asked, false, [](const Situation&) { return true; }},
    {1, coarse_axes, false, [](const Situation& s) { return joint_asked(s) && coarse_axes_may_be_quicker(s); }},
    {1, asked, true, [](const Situation& s) { return redundancy_row(s.options.method).either_way && open(s); }},
    {2, joint, false, joint_instead},
    {2, coarse_axes, false, [](const Situation& s) { return any_instead(s) && coarse_axes_may_be_quicker(s); }},
    {2, joint, true, [](const Situation& s) { return joint_instead(s) && open(s); }},
};
constexpr int steps = std::end(candidates)[-1].step + 1;

const char* text(NoPlan why) {
  switch (why) {
    case NoPlan::head_exceeds_limits:
      return "the head's acceleration or jerk exceeds both axes'";
    case NoPlan::effort:
      return "slower sections were not found with the effort that is worth it";
    case NoPlan::cannot_follow:
      return "the coarse axes cannot follow, however slowly the tool moves";
    case NoPlan::no_fine_axis:
      return "no fine axis has a stroke that can be planned with";
    case NoPlan::samples_apart:
      return "between samples of every cycle a fine axis may leave its stroke";
    case NoPlan::no_split:
      return "no split was found that holds every limit";
    case NoPlan::no_reference:
      return "no limits of the reference motion were found with which the filtered motion holds those of the axes";
    case NoPlan::between_samples:
      return "the axes exceed their limits between the places that the planner looks at";
    case NoPlan::no_curve:
      return "no coarse curve within the strokes was found along which all axes hold their limits";
  }
  return "";
}

/// Stretches a motion of the coarse axes alone as asked for, and fills in the table of trade-offs.
void smooth(RedundancyResult& alone, const RedundancyTask& task, const RedundancyOptions& options) {
  const double by = stretch(options);
  if (options.compare) {
    const std::vector<double> energy = acceleration_energy(*alone.head);
    for (const double factor : stretches) {
      alone.trades.push_back({factor, alone.head->duration() * factor, energy});
      for (double& e : alone.trades.back().energy) e /= std::pow(factor, 3);
    }
  }
  if (by > 1) alone.head = std::make_shared<const PathMotion>(task.path, alone.head->law().slowed(by));
  alone.coarse = alone.head;
}

}  // namespace

PlanChoice::PlanChoice(RedundancyTask task, const RedundancyOptions& options, Progress progress)
    : task_(std::move(task)), options_(options), progress_(progress), rejected_(std::size(candidates), false) {
  const auto replaced_by = [&](RedundancyMethod other, const char* note) {
    gave_way_.push_back({planner_name(options_.method), GivingWay::unsuited});
    notes_.emplace_back(note);
    options_.method = other;
  };
  const auto& axes = task_.machine.axes;
  const bool split = std::all_of(axes.begin(), axes.end(), [](const CoarseFineAxis& a) { return a.stroke > 0; });
  if (redundancy_row(options_.method).every_axis && !split)
    replaced_by(RedundancyMethod::joint,
                "not every axis of the contour has a fine one, which the method asks for; the joint planner planned "
                "the contour");
  if (!redundancy_row(options_.method).centres && centred(task_.machine) && split)
    replaced_by(RedundancyMethod::iterative,
                "the joint planner leaves open where fine axes stand at rest: the iterative method planned the "
                "contour");
}

bool PlanChoice::next() {
  for (; step_ < steps; ++step_)
    if (plan_step(step_)) {
      explain();
      return true;
    }
  return false;
}

bool PlanChoice::plan_step(int step) {
  std::optional<std::size_t> lost;  // the step's own planner, if it has no plan
  split_.reset();
  std::optional<Chosen> best;
  for (std::size_t i = 0; i < std::size(candidates); ++i) {
    const Candidate& candidate = candidates[i];
    const Situation situation{task_, options_, best ? &best->result : nullptr};
    if (candidate.step != step || rejected_[i] || !candidate.worth(situation)) continue;
    const std::optional<RedundancyTask> back = candidate.backwards ? reversed(task_) : std::nullopt;
    if (candidate.backwards && !back) continue;
    Expected<RedundancyResult, NoPlan> found = planned(candidate.planner, back ? *back : task_);
    progress_ = progress_.part(1, 1);
    if (!found) {
      if (!why_not_) why_not_ = found.reason();
      if (!lost && found.reason() != NoPlan::no_fine_axis) lost = i;
      continue;
    }
    const double duration = found->head->duration();
    if (candidate.planner != coarse_axes && !(split_ && *split_ <= duration)) split_ = duration;
    if (best && !(duration < best->result.head->duration() * (1 - quicker))) continue;
    RedundancyResult result = back ? reversed(*std::move(found), task_) : *std::move(found);
    if (best) result.fastest = std::min(result.fastest, best->result.fastest);
    best = Chosen{i, std::move(result)};
  }
  if (lost && !split_ && candidates[*lost].planner != asked_timed_again)
    gave_way_.push_back({name(candidates[*lost].planner), GivingWay::no_motion});
  if (!best) return false;
  chosen_ = std::move(best);
  return true;
}

Expected<RedundancyResult, NoPlan> PlanChoice::planned(CandidatePlanner planner, const RedundancyTask& task) {
  if (planner == coarse_axes) {
    RedundancyOptions law = options_;
    law.keep_reserve = false;  // as in the joint planner's plans
    RedundancyResult alone = plan_coarse_alone(task, law, progress_.part(1, 1));
    if (options_.method == RedundancyMethod::joint) smooth(alone, task, options_);
    return alone;
  }
  if (planner == joint) {
    RedundancyOptions quickest = options_;
    quickest.compare = false;
    return redundancy_row(RedundancyMethod::joint).plan(task, quickest, progress_);
  }
  const double timing = planner == asked_timed_again ? timing_begins : 1;
  Expected<RedundancyResult, NoPlan> found =
      redundancy_row(options_.method).plan(task, options_, progress_.part(0, timing));
  if (!found || planner == asked) return found;
  return reparametrised(*std::move(found), task, progress_.part(timing, 1));
}

const char* PlanChoice::name(CandidatePlanner planner) const {
  if (planner == coarse_axes) return coarse_axes_alone;
  if (planner == asked_timed_again) return timed_again;
  return name_of<RedundancyMethod>(planner == joint ? RedundancyMethod::joint : options_.method, redundancy_methods);
}

/// Adds the notes of the list to the plan.
void PlanChoice::explain() {
  const Candidate& candidate = candidates[chosen_->candidate];
  std::vector<std::string>& notes = chosen_->result.notes;
  notes.insert(notes.begin(), notes_.begin(), notes_.end());
  if (candidate.backwards) notes.emplace_back("planned from its end to its begin, which is quicker here");
  if (candidate.planner == joint)
    notes.emplace_back("the method found no motion that holds every limit; the joint planner planned the contour");
  if (candidate.planner == asked && rejected_[0])
    notes.emplace_back("the motion timed again did not hold every limit: it is as the method planned it");
  if (candidate.planner != coarse_axes || (!split_ && why_not_ == NoPlan::no_fine_axis)) return;
  char note[200] =
      "no motion was found in which the fine axes take part: they stand still, and the coarse axes move alone";
  if (split_)
    std::snprintf(note, sizeof note,
                  "the coarse axes alone take %.6g s, the quickest motion that was found in which the fine axes take "
                  "part %.6g s: those stand still",
                  chosen_->result.head->duration(), *split_);
  notes.emplace_back(note);
}

void PlanChoice::reject(double duration, const Verification& verdict) {
  rejected_[chosen_->candidate] = true;
  gave_way_.push_back({name(candidates[chosen_->candidate].planner), GivingWay::verification, duration});
  gave_way_.back().failed = failed_by_most(verdict);
}

std::vector<GaveWay> PlanChoice::gave_way(double duration) const {
  std::vector<GaveWay> rows = gave_way_;
  if (rejected_[chosen_->candidate]) rows.pop_back();  // nothing took the place of the plan at hand
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool last = i + 1 == rows.size();
    rows[i].used = last ? name(candidates[chosen_->candidate].planner) : rows[i + 1].planner;
    rows[i].used_duration = last ? duration : rows[i + 1].duration;
  }
  std::erase_if(rows, [](const GaveWay& row) { return row.planner == row.used; });  // its plan in the other direction
  return rows;
}

std::optional<std::string> PlanChoice::quicker_coarse_axes(double duration) {
  const CandidatePlanner planner = candidates[chosen_->candidate].planner;
  if (options_.method == RedundancyMethod::joint || (planner != asked && planner != asked_timed_again))
    return std::nullopt;
  if (task_.machine.limited_order() == 3 || !within_coarse_range(*task_.path, task_.machine)) return std::nullopt;
  const double alone = plan_coarse_alone(task_, options_, progress_.part(1, 1)).head->duration();
  if (duration <= alone * (1 + quicker)) return std::nullopt;
  char note[160];
  std::snprintf(note, sizeof note,
                "the method's motion takes %.6g s; the coarse axes alone, with fine axes that stand still, take %.6g s",
                duration, alone);
  return note;
}

void PlanChoice::refuse() const {
  refuse_beyond_range();
  throw Infeasible(why_not_ ? text(*why_not_) : "no motion was found that holds every limit");
}

void PlanChoice::refuse_beyond_range() const {
  std::vector<InputFault> faults;
  for (const std::size_t k : beyond_coarse_range(*task_.path, task_.machine))
    faults.push_back({{"machine", "coarse", task_.machine.axes[k].name, "range"},
                      "no motion was found in which this coarse axis stays within its range; widen the range, or move "
                      "the contour"});
  if (!faults.empty())
    throw InfeasibleAt("no motion was found in which the coarse axes stay within their ranges", std::move(faults));
}

std::optional<Check> failed_by_most(const Verification& verification) {
  const auto strain = [](const Check& check) {
    const double times = check.limit > 0 ? check.value / check.limit : unlimited;
    return std::isnan(times) ? unlimited : times;
  };
  std::optional<Check> most;
  for (const Check& check : verification.checks)
    if (!check.passed && (!most || strain(check) > strain(*most))) most = check;
  return most;
}

}  // namespace bahnwerk
