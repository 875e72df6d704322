#include "core/plan/coarse_fine/coarse_fine_plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/progress_scope.hpp"
#include "core/motion/setpoints/cycles.hpp"
#include "core/plan/coarse_fine/coarse_fine_setpoints.hpp"
#include "core/plan/coarse_fine/fitted_motion.hpp"
#include "core/plan/contour/contour_report.hpp"
#include "core/plan/contour/posed_contour.hpp"
#include "core/plan/setpoint_count.hpp"
#include "core/redundant/energy.hpp"
#include "core/verify/geometry/tube.hpp"
#include "core/verify/law/rest_check.hpp"
#include "core/verify/redundant/centre_checks.hpp"
#include "core/verify/redundant/coarse_fine_checks.hpp"
#include "core/verify/redundant/stroke_bound.hpp"
#include "core/verify/redundant/stroke_chains.hpp"
#include "core/verify/redundant/sum_checks.hpp"
#include "core/verify/setpoints/motion_setpoint_checks.hpp"
#include "core/verify/setpoints/setpoint_checks.hpp"
#include "core/verify/verifier.hpp"

namespace bahnwerk {
namespace {

constexpr double largest_excess = 1e-4;  // of a limit, that counts as rounding
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

/// How much longer everything has to last so that limits hold which are exceeded by rounding; 1: nothing helps.
double slower(const Verification& verification) {
  double factor = 1;
  for (const Check& check : verification.checks) {
    if (check.passed) continue;
    const bool scales = check.name.starts_with("velocity ") || check.name.starts_with("acceleration ") ||
                        check.name.starts_with("jerk ") || check.name.starts_with("path velocity");
    if (!scales || !(check.value < check.limit * (1 + largest_excess))) return 1;
    factor = std::max(factor, check.value / check.limit);
  }
  return factor > 1 ? factor * (1 + 1e-12) : 1;
}

/// Those that lose most time against their bounds, first.
std::vector<SectionGap> slowest(std::vector<SectionGap> sections) {
  std::erase_if(sections, [](const SectionGap& s) { return !(s.gap > slow_section); });
  const auto more = [](const SectionGap& a, const SectionGap& b) { return a.time - a.bound > b.time - b.bound; };
  std::stable_sort(sections.begin(), sections.end(), more);
  if (sections.size() > slow_sections_listed) sections.resize(slow_sections_listed);
  return sections;
}

class Pipeline {
 public:
  Pipeline(Contour input, const CoarseFineMachine& machine, const ContourPlanning& planning,
           const RedundancyOptions& options, Progress& progress)
      : machine_(machine),
        planning_(planning),
        options_(options),
        progress_(progress),
        head_(summed(machine)),
        coarse_axes_(coarse_limits(machine)),
        fine_axes_(fine_limits(machine)) {
    if (planning.stop_at_mode_change) stop_at_mode_changes(input);
    given_ = std::make_shared<const Contour>(std::move(input));
    moving_ = std::min(machine.axes.size(), given_->dimension);
  }

  CoarseFinePlan run() {
    pose();
    bound();
    if (!tried(options_, bounded()) && !otherwise()) throw Infeasible(why_not_);
    check_setpoints();
    report();
    return std::move(plan_);
  }

 private:
  // Where the stages end.
  double posed() const { return blended() ? 0.3 : 0.0; }
  double bounded() const { return posed() + 0.05; }
  static constexpr double planned = 0.7, verified = 0.85;
  bool blended() const { return planning_.corner_mode == CornerMode::blend; }

  void pose() {
    ContourPlanning planning = planning_;
    planning.method = machine_.limits_jerk() ? PlanningMethod::jerk_limited : PlanningMethod::time_optimal;
    PosedContour posed_contour = pose_contour(given_, head_limits(machine_), planning, progress_, 0, posed());
    contour_ = std::move(posed_contour.driven);
    path_ = std::move(posed_contour.path);
    path_.planned.reset();
  }

  void bound() {
    moving_head_ = head_, moving_coarse_ = coarse_axes_, moving_fine_ = fine_axes_;
    moving_head_.axes.resize(moving_), moving_coarse_.resize(moving_), moving_fine_.resize(moving_);
    const PathTask head = head_task();
    Bound& bound = plan_.contour.bound;
    const double between = posed() + 0.8 * (bounded() - posed());
    bound = lower_bound(head, planning_.corner_angle, progress_, posed(), between, &section_bounds_);
    bound.basis += ", limits of coarse and fine axes summed";
    const StrokeGain gain =
        raise_by_stroke({head, moving_coarse_, moving_fine_, between, bounded()}, section_bounds_, progress_);
    bound.duration += gain.duration;
    if (gain.sections > 0)
      bound.basis += "; the way of the coarse axes in " + std::to_string(gain.sections) + " sections";
  }

  PathTask head_task() const { return {*path_.moving, moving_head_, path_.feeds, path_.rests, path_.dwells}; }

  /// Where sections take longer than their bounds they may have to, together. A motion that is slower on purpose says
  /// nothing of that.
  void bound_chains() {
    const bool fastest =
        options_.method == RedundancyMethod::joint && options_.smoothness == 0 && options_.stretch <= 1;
    if (!fastest) return;
    const std::vector<double> times = section_times(plan_.head->law(), 1, section_bounds_);
    const double gain =
        gain_of_chains({head_task(), moving_coarse_, moving_fine_, 1, 1}, section_bounds_, times, progress_);
    if (!(gain > 0)) return;
    plan_.contour.bound.duration += gain;
    plan_.contour.bound.basis += "; sections with their neighbours";
  }

  void method(RedundancyOptions options, double from) {
    RedundancyTask task{path_.moving, contour_, machine_, path_.feeds, path_.rests, path_.dwells};
    task.machine.axes.resize(moving_);
    task.bound = plan_.contour.bound.duration;
    options.corner_angle = planning_.corner_angle;
    result_ = plan_redundant(task, options, progress_, from, planned);
    limit_setpoints(result_.head->duration(), machine_.cycle_time, planning_.max_setpoints);
  }

  /// False: there is no plan.
  bool tried(const RedundancyOptions& options, double from) {
    try {
      method(options, from);
    } catch (const Infeasible& e) {
      if (why_not_.empty()) why_not_ = e.what();
      return false;
    }
    slow_and_verify();
    return verification().passed || !another(options);
  }

  /// What is planned where a plan with those options did not hold its limits.
  static std::optional<RedundancyOptions> another(RedundancyOptions options) {
    options.compare = false;
    if (options.reparametrise)
      options.reparametrise = false;
    else if (options.method != RedundancyMethod::joint)
      options.method = RedundancyMethod::joint;
    else if (!options.coarse_alone)
      options.coarse_alone = true;
    else
      return std::nullopt;
    return options;
  }

  /// The motion as it was before it was timed anew, or the joint planner's, or that of the coarse axes alone.
  bool otherwise() {
    std::size_t given_up = 0;
    for (std::optional<RedundancyOptions> next = another(options_); next; next = another(*next)) {
      ++given_up;
      if (!tried(*next, planned)) continue;
      result_.fallbacks += given_up;
      if (!next->coarse_alone)
        result_.notes.push_back(
            next->method == options_.method
                ? "the motion timed anew did not hold every limit: it is as the method planned it"
                : "the method found no motion that holds every limit; the joint planner planned the contour");
      return true;
    }
    return false;
  }

  void slow_and_verify() {
    const std::vector<double> still(machine_.axes.size() - moving_, contour_->height);
    double stretch = 1;  // on top of what the method found
    for (int correction = 0;; ++correction) {
      plan_.contour.duration = result_.head->duration() * stretch;
      cycles_ = whole_cycles(plan_.contour.duration, machine_.cycle_time);
      const double factor = cycles_.factor * stretch;
      plan_.head = std::make_shared<const PathMotion>(path_.path, result_.head->law().slowed(factor));
      plan_.coarse = std::make_shared<const FittedMotion>(result_.coarse, factor, plan_.head->law(), still,
                                                          machine_.limits_jerk() ? 2 : 1);
      verify();
      const double more = slower(verification());
      if (verification().passed || correction == max_corrections || more == 1) return;
      stretch = factor * more;  // of what was verified, whole cycles included
    }
  }

  Verification& verification() { return plan_.contour.verification; }

  void verify() {
    const double between = planned + 0.5 * (verified - planned);
    VerifierInput head{*path_.path, head_, plan_.head->law(), path_.feeds_to_verify, path_.rests};
    head.corner_angle = planning_.corner_angle;
    head.check_jerk = machine_.limits_jerk();
    head.progress_from = planned, head.progress_to = between;
    verification() = verify_motion(head, progress_);
    CoarseFineToVerify split{*path_.path, plan_.head->law(), *plan_.coarse, coarse_axes_, fine_axes_};
    split.check_jerk = machine_.limits_jerk();
    split.cycle_time = machine_.cycle_time;
    split.progress_from = between, split.progress_to = verified;
    add(coarse_fine_checks(split, progress_));
    std::vector<bool> centred;
    for (const CoarseFineAxis& axis : machine_.axes) centred.push_back(axis.centred);
    add(centre_checks(*plan_.head, *plan_.coarse, fine_axes_, centred));
  }

  void add(std::vector<Check> checks) {
    for (Check& check : checks) verification().add(std::move(check));
  }

  void check_setpoints() {
    const double a = verified + 0.05, b = verified + 0.1;
    auto setpoints = std::make_unique<CoarseFineSetpoints>(plan_.head, plan_.coarse, *contour_, head_, cycles_.count);
    add(setpoint_checks({*path_.path, head_, plan_.head->law(), *setpoints, contour_.get(), verified, a}, progress_));
    Machine coarse{coarse_axes_, machine_.cycle_time};
    for (Check& check : motion_setpoint_checks(*plan_.coarse, coarse, *setpoints, progress_, a, b)) {
      check.name = "coarse " + check.name;
      verification().add(std::move(check));
    }
    add(sum_checks({*setpoints, head_.axes, coarse_axes_, fine_axes_, b, 1}, progress_));
    plan_.contour.setpoints = std::move(setpoints);
    if (!given_->rests.empty()) verification().add(rest_check(*given_, *contour_, plan_.head->law(), progress_, 1));
    if (blended()) add(tube_checks(*given_, *contour_, planning_.blend_tolerance, progress_, 1, 1));
    bound_chains();
    Bound& bound = plan_.contour.bound;
    verification().add(bound_check(bound, plan_.contour.duration));
    bound = with_gap(bound, plan_.contour.duration);
  }

  void report() {
    ContourPlan& plan = plan_.contour;
    const TimeLaw& sampled = plan_.head->law();
    plan.path = contour_;
    plan.notes = contour_->notes;
    note_still_axes(*contour_, head_, plan);
    plan.notes.insert(plan.notes.end(), result_.notes.begin(), result_.notes.end());
    plan.path_length = contour_->path.length();
    plan.iterations = result_.iterations;
    plan.pieces = sampled.pieces().size();
    report_blocks(*contour_, sampled, cycles_.factor, plan);
    report_joints(*contour_, moving_, sampled, cycles_.factor, planning_.corner_angle, plan, progress_, 1);
    plan.slow_lines = slow_lines(*plan_.head, head_, path_.feeds, {}, slow_lines_listed, progress_, 1);
    std::vector<SectionGap> sections;
    plan.sections = section_gaps(*path_.path, sampled, cycles_.factor, section_bounds_, progress_, 1, &sections);
    plan_.slow_sections = slowest(std::move(sections));
    plan_.fastest = result_.fastest;
    plan_.energy = acceleration_energy(*plan_.coarse);
    for (double& energy : plan_.energy) energy *= std::pow(cycles_.factor, 3);
    ProgressScope scope(progress_, "report", 1, 1);
    plan_.rms = rms_accelerations(*plan_.head, *plan_.coarse, scope);
    for (const AxisLimits& axis : coarse_axes_)
      plan_.peak_coarse_acceleration.push_back(value("acceleration " + axis.name));
    plan_.trades = std::move(result_.trades);
    plan_.passes = std::move(result_.passes);
    if (!plan_.passes.empty() && plan_.passes.back().peaks.empty()) plan_.passes.back().peaks = peaks();
    for (const SlowedSegment& s : result_.slowed) {
      const Segment& segment = contour_->path[s.segment];
      plan_.slowed.push_back({segment.source(), segment.length(), s.feed});
    }
    plan_.slowed_count = std::max(plan_.slowed.size(), result_.slowed_count);
    plan_.certified = result_.certified;
    plan_.fallbacks = result_.fallbacks;
    plan_.coarse_jerk_limited = result_.coarse_jerk_limited;
    plan_.lags = std::move(result_.lags);
  }

  double value(const std::string& check) {
    const auto& checks = verification().checks;
    const auto at = std::find_if(checks.begin(), checks.end(), [&](const Check& c) { return c.name == check; });
    return at == checks.end() ? 0 : at->value;
  }

  /// Of the motion that is sampled, as verified.
  std::vector<RedundancyPeaks> peaks() {
    std::vector<RedundancyPeaks> list;
    for (const CoarseFineAxis& axis : machine_.axes)
      list.push_back({value("stroke " + axis.name + "f"), value("velocity " + axis.name + "c"),
                      value("acceleration " + axis.name + "c"), value("velocity " + axis.name + "f"),
                      value("acceleration " + axis.name + "f")});
    return list;
  }

  const CoarseFineMachine& machine_;
  const ContourPlanning& planning_;
  const RedundancyOptions& options_;
  Progress& progress_;
  Machine head_;  // what head, coarse and fine axes are held to
  std::vector<AxisLimits> coarse_axes_, fine_axes_;
  std::shared_ptr<const Contour> given_, contour_;
  std::size_t moving_ = 0;
  PathPlanning path_;
  Machine moving_head_;  // of the axes that move, what bounds are made of
  std::vector<AxisLimits> moving_coarse_, moving_fine_;
  std::vector<SectionBound> section_bounds_;
  RedundancyResult result_;
  std::string why_not_;  // the method found nothing
  Cycles cycles_;
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
                                const RedundancyOptions& options, Progress& progress) {
  return Pipeline(std::move(contour), machine, planning, options, progress).run();
}

}  // namespace bahnwerk
