#include "core/plan/coarse_fine/coarse_fine_plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/base/progress_scope.hpp"
#include "core/motion/setpoints/cycles.hpp"
#include "core/plan/coarse_fine/coarse_fine_setpoints.hpp"
#include "core/plan/coarse_fine/fitted_motion.hpp"
#include "core/plan/contour/contour_report.hpp"
#include "core/plan/contour/prepared_contour.hpp"
#include "core/plan/contour/stopping_time.hpp"
#include "core/plan/pipeline.hpp"
#include "core/redundant/joint/energy.hpp"
#include "core/redundant/methods/candidates.hpp"
#include "core/verify/geometry/tube.hpp"
#include "core/verify/law/rest_check.hpp"
#include "core/verify/law/verifier.hpp"
#include "core/verify/redundant/centre_checks.hpp"
#include "core/verify/redundant/coarse_fine_checks.hpp"
#include "core/verify/redundant/stroke_bound.hpp"
#include "core/verify/redundant/stroke_chains.hpp"
#include "core/verify/redundant/sum_checks.hpp"
#include "core/verify/setpoints/motion_setpoint_checks.hpp"
#include "core/verify/setpoints/setpoint_checks.hpp"

namespace bahnwerk {
namespace {

constexpr double largest_excess = 1e-4;  // largest excess over a limit, relative, that counts as rounding
constexpr int max_corrections = 4;
constexpr std::size_t slow_lines_listed = 20, slow_sections_listed = 100;
constexpr double slow_section = 1e-4;  // gap above which a section is listed
constexpr double no_stroke = 1e-9;  // mm: what rounding leaves between tool and coarse axis where there is no fine one

AxisLimits stage(const Limits& limits, const std::string& name) {
  AxisLimits axis;
  static_cast<Limits&>(axis) = limits;
  axis.name = name;
  return axis;
}

/// Returns the factor ≥ 1 of the duration with which limits that are exceeded by rounding hold; 1: no factor helps.
double slower(const Verification& verification) {
  double factor = 1;
  for (const Check& check : verification.checks) {
    if (check.passed) continue;
    if (!falls_with_speed(check) || !(check.value < check.limit * (1 + largest_excess))) return 1;
    factor = std::max(factor, check.value / check.limit);
  }
  return factor > 1 ? factor * (1 + 1e-12) : 1;
}

/// Sorts the sections by their excess over their bounds, the largest first.
std::vector<SectionGap> slowest(std::vector<SectionGap> sections) {
  std::erase_if(sections, [](const SectionGap& s) { return !(s.gap > slow_section); });
  const auto more = [](const SectionGap& a, const SectionGap& b) { return a.time - a.bound > b.time - b.bound; };
  std::stable_sort(sections.begin(), sections.end(), more);
  if (sections.size() > slow_sections_listed) sections.resize(slow_sections_listed);
  return sections;
}

class CoarseFineProblem final : public MotionProblem {
 public:
  CoarseFineProblem(Contour input, const CoarseFineMachine& machine, const ContourPlanning& planning,
                    const RedundancyOptions& options, Progress progress)
      : machine_(machine),
        planning_(planning),
        options_(options),
        progress_(progress),
        head_(summed(machine)),
        coarse_axes_(coarse_limits(machine)),
        fine_axes_(fine_limits(machine)),
        coarse_machine_{coarse_axes_, machine.cycle_time} {
    if (planning.stop_at_mode_change) stop_at_mode_changes(input);
    given_ = std::make_shared<const Contour>(std::move(input));
    moving_ = std::min(machine.axes.size(), given_->dimension);
  }

  static constexpr double planned = 0.7, verified = 0.85;  // where the stages end

  void plan() override {
    choose_contour();
    raise_bound();
    RedundancyTask task{driven_.path.moving, driven_.contour,     machine_,           driven_.path.feeds,
                        driven_.path.rests,  driven_.path.dwells, driven_.bound.value};
    task.machine.axes.resize(moving_);
    RedundancyOptions options = options_;
    options.corner_angle = planning_.corner_angle;
    choice_.emplace(std::move(task), options, progress_.part(bounded(), planned));
    if (!take_next()) choice_->refuse();
  }

  bool plan_otherwise() override {
    choice_->reject(duration(), verdict_);
    if (take_next()) return true;
    choice_->refuse_beyond_range();
    return false;
  }

  double duration() const override { return result_.head->duration() * stretch_; }

  void slow(double factor) override {
    const std::vector<double> still(machine_.axes.size() - moving_, driven_.contour->height);
    factor_ = factor * stretch_;
    cycles_factor_ = factor;
    plan_.head = std::make_shared<const PathMotion>(driven_.path.path, result_.head->law().slowed(factor_));
    plan_.coarse = std::make_shared<const FittedMotion>(result_.coarse, factor_, plan_.head->law(), still,
                                                        machine_.limited_order() - 1);
  }

  Verification verify() override {
    const double between = planned + 0.5 * (verified - planned);
    VerifierInput head{*driven_.path.path, head_, plan_.head->law(), driven_.path.feeds_to_verify, driven_.path.rests};
    head.corner_angle = planning_.corner_angle;
    head.order = machine_.limited_order();
    Verification verdict = verify_motion(head, progress_.part(planned, between));
    CoarseFineToVerify split{*driven_.path.path, plan_.head->law(), *plan_.coarse, coarse_axes_, fine_axes_};
    split.order = machine_.limited_order();
    split.cycle_time = machine_.cycle_time;
    verdict.add(coarse_fine_checks(split, progress_.part(between, verified)));
    std::vector<bool> centred;
    for (const CoarseFineAxis& axis : machine_.axes) centred.push_back(axis.centred);
    verdict.add(centre_checks(*plan_.head, *plan_.coarse, fine_axes_, centred));
    verdict_ = verdict;
    return verdict;
  }

  bool correct(const Verification& verdict) override {
    const double more = slower(verdict);
    if (more == 1) return false;
    stretch_ = factor_ * more;  // stretch of what was verified, whole cycles included
    return true;
  }

  std::shared_ptr<const Motion> motion() override {
    if (std::optional<std::string> note = choice_->quicker_coarse_axes(duration()))
      result_.notes.push_back(*std::move(note));
    return plan_.head;
  }

  std::unique_ptr<SetpointSource> setpoints(std::size_t cycles) override {
    return std::make_unique<CoarseFineSetpoints>(plan_.head, plan_.coarse, *driven_.contour, head_, cycles);
  }

  Rows row_checks(const SetpointSource& setpoints, const Verification&) override {
    Rows rows{{}, 3};
    rows.checks.push_back(
        path_row_check({*driven_.path.path, head_, plan_.head->law(), setpoints, driven_.contour.get()}));
    rows.checks.push_back(motion_row_check({*plan_.coarse, coarse_machine_, setpoints, "coarse"}));
    rows.checks.push_back(sum_row_check({setpoints, head_.axes, coarse_axes_, fine_axes_}));
    return rows;
  }

  std::vector<Check> more_checks() override {
    std::vector<Check> list;
    if (!given_->rests.empty())
      list.push_back(rest_check(*given_, *driven_.contour, plan_.head->law(), progress_.part(1, 1)));
    if (blended())
      for (Check& check : tube_checks(*given_, *driven_.contour, planning_.blend_tolerance, progress_.part(1, 1)))
        list.push_back(std::move(check));
    return list;
  }

  Bound bound() override {
    bound_chains();
    return driven_.bound;
  }

  CoarseFinePlan report(MotionPlan found) {
    ContourPlan& plan = plan_.contour;
    plan.duration = found.duration;
    plan.setpoints = std::move(found.setpoints);
    plan.verification = std::move(found.verification);
    plan.bound = std::move(found.bound);
    const TimeLaw& sampled = plan_.head->law();
    plan.path = driven_.contour;
    plan.notes = driven_.contour->notes;
    plan.notes.insert(plan.notes.end(), notes_.begin(), notes_.end());
    note_still_axes(*driven_.contour, head_, plan);
    plan.notes.insert(plan.notes.end(), result_.notes.begin(), result_.notes.end());
    plan.path_length = driven_.contour->path.length();
    plan.iterations = result_.iterations;
    plan.pieces = sampled.pieces().size();
    report_blocks(*driven_.contour, {sampled, cycles_factor_}, plan);
    report_joints(*driven_.contour, moving_, {sampled, cycles_factor_}, planning_.corner_angle, plan,
                  progress_.part(1, 1));
    plan.slow_lines = slow_lines(*plan_.head, head_, driven_.path.feeds, {}, slow_lines_listed, progress_.part(1, 1));
    std::vector<SectionGap> sections;
    plan.sections =
        section_gaps(*driven_.path.path, sampled, cycles_factor_, driven_.sections, progress_.part(1, 1), &sections);
    plan_.slow_sections = slowest(std::move(sections));
    plan_.fastest = result_.fastest;
    plan_.energy = acceleration_energy(*plan_.coarse);
    for (double& energy : plan_.energy) energy *= std::pow(cycles_factor_, 3);
    ProgressScope scope(progress_.part(1, 1), "report");
    plan_.rms = rms_accelerations(*plan_.head, *plan_.coarse, scope);
    for (const AxisLimits& axis : coarse_axes_)
      plan_.peak_coarse_acceleration.push_back(value(quantity::axis, 2, axis.name));
    plan_.trades = std::move(result_.trades);
    plan_.passes = std::move(result_.passes);
    if (!plan_.passes.empty() && plan_.passes.back().peaks.empty()) plan_.passes.back().peaks = peaks();
    for (const SlowedSegment& s : result_.slowed) {
      const Segment& segment = driven_.contour->path[s.segment];
      plan_.slowed.push_back({segment.source(), segment.length(), s.feed});
    }
    plan_.slowed_count = std::max(plan_.slowed.size(), result_.slowed_count);
    plan_.certified = result_.certified;
    plan_.gave_way = choice_->gave_way(duration());
    plan_.coarse_jerk_limited = result_.coarse_jerk_limited;
    plan_.lags = std::move(result_.lags);
    return std::move(plan_);
  }

 private:
  /// A contour that may be driven, with its bound and those of its sections for the head under the summed limits.
  struct Driven {
    std::shared_ptr<const Contour> contour;
    PathPlanning path;
    Bound bound;
    std::vector<SectionBound> sections;
  };

  // Ends of the stages in the job's progress.
  double chosen() const { return blended() ? 0.3 : 0.0; }
  double bounded() const { return chosen() + 0.05; }
  bool blended() const { return planning_.corner_mode == CornerMode::blend; }

  /// Takes the rounded contour, or the given one with stops at its corners if its bound is less.
  void choose_contour() {
    ContourPlanning planning = planning_;
    planning.method = machine_.limited_order() == 3 ? PlanningMethod::jerk_limited : PlanningMethod::time_optimal;
    const double rounded = 0.5 * chosen();
    const PreparedContour prepared =
        prepare_contour(given_, head_limits(machine_), planning, progress_.part(0, rounded));
    moving_head_ = head_, moving_coarse_ = coarse_axes_, moving_fine_ = fine_axes_;
    moving_head_.axes.resize(moving_), moving_coarse_.resize(moving_), moving_fine_.resize(moving_);
    const auto drive = [&](const std::shared_ptr<const Contour>& contour, Progress progress) {
      driven_ = {contour, path_planning(prepared, contour, planning), {}, {}};
      driven_.bound = lower_bound(head_task(), planning.corner_angle, progress, &driven_.sections);
    };
    if (!prepared.rounded) return drive(given_, progress_.part(chosen(), bounded()));
    drive(prepared.rounded, progress_.part(rounded, chosen()));
    ProgressScope scope(progress_.part(chosen(), chosen()), "planning");
    const auto axes = prepared.axes->along(given_).moving;
    const StoppingTime stopping(*given_, *axes, moving_head_, planning.corner_angle);
    if (driven_.bound.value <= given_->dwell() + stopping.least(0, given_->path.size(), scope)) return;
    Driven other = std::exchange(driven_, {});
    drive(given_, progress_.part(chosen(), bounded()));
    if (driven_.bound.value < other.bound.value)
      notes_.emplace_back("driven as given, with stops at its corners: rounded it would be slower");
    else
      driven_ = std::move(other);
  }

  void raise_bound() {
    driven_.bound.basis += ", limits of coarse and fine axes summed";
    const StrokeGain gain = raise_by_stroke({head_task(), moving_coarse_, moving_fine_}, driven_.sections,
                                            progress_.part(bounded(), bounded()));
    driven_.bound.value += gain.duration;
    if (gain.sections > 0)
      driven_.bound.basis += "; the way of the coarse axes in " + std::to_string(gain.sections) + " sections";
  }

  PathTask head_task() const {
    return {*driven_.path.moving, moving_head_, driven_.path.feeds, driven_.path.rests, driven_.path.dwells};
  }

  /// Adds the gain of chains of sections (stroke_chains.hpp) where sections take longer than their bounds. A motion
  /// that is slower on purpose gives no indication where to look.
  void bound_chains() {
    const bool fastest =
        options_.method == RedundancyMethod::joint && options_.smoothness == 0 && options_.stretch <= 1;
    if (!fastest) return;
    const std::vector<double> times = section_times(plan_.head->law(), 1, driven_.sections);
    const double gain =
        gain_of_chains({head_task(), moving_coarse_, moving_fine_}, driven_.sections, times, progress_.part(1, 1));
    if (!(gain > 0)) return;
    driven_.bound.value += gain;
    driven_.bound.basis += "; sections with their neighbours";
  }

  /// Takes the next plan of the list. Returns false, leaving the plan at hand, if there is none.
  bool take_next() {
    if (!choice_->next()) return false;
    result_ = std::move(choice_->plan());
    stretch_ = 1;
    return true;
  }

  double value(const Quantity& quantity, int order, const std::string& axis) {
    const Check* check = plan_.contour.verification.find(quantity, order, axis);
    return check == nullptr ? 0 : check->value;
  }

  /// Reports the figures of the motion that is sampled, as verified.
  std::vector<RedundancyPeaks> peaks() {
    std::vector<RedundancyPeaks> list;
    for (const CoarseFineAxis& one : machine_.axes) {
      const std::string coarse = one.name + "c", fine = one.name + "f";
      list.push_back({value(quantity::stroke, 0, fine), value(quantity::axis, 1, coarse),
                      value(quantity::axis, 2, coarse), value(quantity::axis, 1, fine),
                      value(quantity::axis, 2, fine)});
    }
    return list;
  }

  const CoarseFineMachine& machine_;
  const ContourPlanning& planning_;
  const RedundancyOptions& options_;
  Progress progress_;
  Machine head_;  // what head, coarse and fine axes are held to
  std::vector<AxisLimits> coarse_axes_, fine_axes_;
  std::shared_ptr<const Contour> given_;
  Driven driven_;
  std::size_t moving_ = 0;
  std::vector<std::string> notes_;
  Machine moving_head_;  // the axes that move, from which bounds follow
  std::vector<AxisLimits> moving_coarse_, moving_fine_;
  Machine coarse_machine_;
  std::optional<PlanChoice> choice_;
  RedundancyResult result_;
  Verification verdict_;                   // on the plan at hand
  double stretch_ = 1;                     // on top of what the planner found
  double factor_ = 1, cycles_factor_ = 1;  // that the motion was slowed by, and the part of it for whole cycles
  CoarseFinePlan plan_;
};

}  // namespace

std::vector<AxisLimits> coarse_limits(const CoarseFineMachine& machine) {
  std::vector<AxisLimits> list;
  for (const CoarseFineAxis& axis : machine.axes) list.push_back(stage(axis.coarse, axis.name + "c"));
  return list;
}

std::vector<AxisLimits> fine_limits(const CoarseFineMachine& machine) {
  std::vector<AxisLimits> list;
  for (const CoarseFineAxis& axis : machine.axes) {
    list.push_back(stage(axis.fine, axis.name + "f"));
    if (!(axis.stroke > 0)) list.back() = stage({}, axis.name + "f");
    list.back().highest = std::max(axis.stroke, no_stroke);
    list.back().lowest = -list.back().highest;
  }
  return list;
}

CoarseFinePlan plan_coarse_fine(Contour contour, const CoarseFineMachine& machine, const ContourPlanning& planning,
                                const RedundancyOptions& options, Progress progress) {
  CoarseFineProblem problem(std::move(contour), machine, planning, options, progress);
  PipelineOptions pipeline{machine.cycle_time, planning.max_setpoints, max_corrections};
  return problem.report(plan_motion(problem, pipeline, progress.part(CoarseFineProblem::verified, 1)));
}

}  // namespace bahnwerk
