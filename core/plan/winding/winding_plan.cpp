#include "core/plan/winding/winding_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <span>
#include <utility>

#include "core/base/number_text.hpp"
#include "core/base/progress.hpp"
#include "core/motion/feed/curvature_feed.hpp"
#include "core/motion/setpoints/needle_setpoints.hpp"
#include "core/numeric/bisection.hpp"
#include "core/plan/trial.hpp"
#include "core/plan/winding/bend_reach.hpp"
#include "core/plan/winding/coil_passes.hpp"
#include "core/plan/winding/laid_coils.hpp"
#include "core/plan/winding/link_timer.hpp"
#include "core/plan/winding/needle_support.hpp"
#include "core/plan/winding/onward_progress.hpp"
#include "core/plan/winding/path_clearance.hpp"
#include "core/plan/winding/wire_length.hpp"
#include "core/verify/law/total_jerk.hpp"
#include "core/verify/setpoints/curvature_checks.hpp"
#include "core/verify/setpoints/difference_checks.hpp"
#include "core/verify/setpoints/needle_checks.hpp"
#include "core/verify/worst.hpp"
#include "core/winding/fill.hpp"
#include "core/winding/path/quick_links.hpp"

namespace bahnwerk {
namespace {

using winding::FixedPiece;
using winding::RotorPart;
using winding::StatorPart;

// Resolution relative to the longest step: each setpoint is nearer to its own place than to those of its neighbours.
constexpr double most_lag = 0.5;
// mm or deg, largest deviation of an axis' setpoint from the motion, from the inverse of the arc length and rounding.
constexpr double rounding_of_rows = 1e-10;
// Links that share only the tangent cause steps of an axis' acceleration at joints, by at most jerk · cycle time
// (core/motion/grid/sections.hpp). A third difference of setpoints is the mean of the jerk weighted by the quadratic
// B-spline over three cycles, whose peak is 3/(4 T), so a step contributes up to 3/4 of the limit in addition to the
// jerk itself. With this share of the limit both together keep it.
constexpr double share_beside_steps = 1 / 1.75;
// Ends of the stages, as shares of the whole job.
constexpr double laid = 0.05, linked = 0.2, cleared = 0.25, reached = 0.3, planned = 0.97;

class Planner {
 public:
  Planner(const WindingRequest& request, Progress progress) : request_(request), onward_(progress) {}

  WindingPlan run() {
    lay_coils(request_, laid_, progress_);
    const std::vector<std::optional<double>> swivels = tried_swivels(request_);
    std::optional<double> clearest = swivels.front();
    if (swivels.size() > 1) {
      double most = -unlimited;
      std::optional<WindingPlan> refused;
      std::vector<FixedPiece> before;
      for (const std::optional<double>& swivel : swivels) {
        // A smaller swivel may have a plan; without any, the reason is found again below.
        auto plan = trial([&]() -> std::optional<WindingPlan> {
          support(swivel);
          if (same_poses(plan_.support, before)) return std::nullopt;
          before = plan_.support;
          find_path();
          const double found = plan_.clearance.minimum;
          if (!(found < request_.least_clearance)) return moved();
          if (found > most) most = found, clearest = swivel;
          return std::nullopt;
        });
        if (!plan || !*plan) continue;
        if ((*plan)->motion.verification.passed) return **std::move(plan);
        if (!refused) refused = *std::move(plan);
      }
      if (refused) return std::move(*refused);
    }
    support(clearest);
    find_path();
    return moved();
  }

 private:
  /// Begins a plan whose needle swivels by at most this angle, with its support points.
  void support(const std::optional<double>& swivel) {
    plan_ = WindingPlan();
    plan_.layout = laid_.layout, plan_.windable = laid_.windable, plan_.turns = laid_.turns;
    winding::NeedleModel model = request_.model;
    model.pivot_limit = swivel;
    const Progress supporting = progress_.part(coils_laid, laid).named("support points");
    auto found = needle_support(request_, plan_.turns, model, supporting);
    if (!found) throw Infeasible(in_words(found.reason()));
    plan_.support = *std::move(found);
    check_depth(request_, plan_.support);
  }

  /// Finds the path through the support points, its clearance, and that of the machine.
  void find_path() {
    progress_.report("link", laid);
    plan_.path = linked_by(request_.links.objective);
    if (request_.minimum_time) quicken();
    plan_.tool = std::make_shared<const PosePath>(pose_path(plan_.path.curves()));
    plan_.path_length = plan_.tool->tool.length();
    progress_.report("clearance", linked);
    const PathClearance clearance = clear(plan_.path, cleared);
    plan_.clearance = clearance.least, plan_.nearest = clearance.nearest;
    progress_.report("machine", cleared);
    try {
      plan_.machine = machine_path(tool_path(), plan_.tool->orientation, request_.configurations);
    } catch (const UnreachablePose& pose) {
      throw placed(pose);
    }
  }

  /// Returns the plan with its motion.
  WindingPlan moved() {
    try {
      move();
    } catch (const UnreachablePose& pose) {
      throw placed(pose);
    } catch (const FeedTooFast& feed) {
      throw placed(feed);
    }
    report();
    return std::move(plan_);
  }

  winding::NeedlePath linked_by(LinkObjective objective) {
    const Progress linking = progress_.part(laid, linked).named("link");
    auto path = linked_path(request_, plan_.support, objective, linking);
    if (!path) throw Infeasible(in_words(path.reason(), plan_.support));
    return *std::move(path);
  }

  /// Replaces the smoothest links by those that take the least time, if the whole path takes less with them.
  void quicken() {
    const PosePath tool = pose_path(plan_.path.curves());
    const auto followed = trial([&] { return machine_path(tool.tool, tool.orientation, request_.configurations); });
    if (!followed) return;  // the fault is reported with its place when the path is final
    const std::shared_ptr<const Kinematics>& machine = followed->kinematics;
    const LinkTimer timer(*machine, request_.along, request_.cycle_time, progress_);
    const winding::NeedlePath substitute = linked_by(LinkObjective::control_distance);
    const Progress timing = progress_.part(linked, linked).named("link");
    const winding::QuickLinks quick = winding::quick_links(
        plan_.support, plan_.path, substitute, request_.links,
        [&](std::span<const BezierPiece> pieces) { return timer(pieces); }, timing);
    // Links are searched with the time-optimal law; the path is then chosen by the time with the requested feed.
    LinkTimes times{timed(plan_.path), timed(substitute), timed(quick.path), quick.changed, LinkChoice::curvature};
    const double allowed = std::min(request_.least_clearance, clear(plan_.path, linked).least.minimum);
    double least = times.curvature;
    const auto take = [&](double time, const winding::NeedlePath& path, LinkChoice choice) {
      if (!(time < least) || !within_ranges(path, machine) || clear(path, linked).least.minimum < allowed) return;
      plan_.path = path, times.taken = choice, least = time;
    };
    take(times.control_distance, substitute, LinkChoice::control_distance);
    take(times.minimum_time, quick.path, LinkChoice::minimum_time);
    plan_.link_times = times;
  }
  static bool within_ranges(const winding::NeedlePath& path, const std::shared_ptr<const Kinematics>& machine) {
    const PosePath tool = pose_path(path.curves());
    return bool(trial([&] { return machine_path(tool.tool, tool.orientation, {machine}); }));
  }

  /// This stage covers the job's progress from `linked` to `to`.
  PathClearance clear(const winding::NeedlePath& path, double to) {
    const Progress clearing = progress_.part(linked, to).named("clearance");
    return path_clearance(request_, plan_.support, path, clearing);
  }

  /// Builds the problem of the motion along a path, which belongs to `tool` and `machine`.
  PathPlanning planning_of(const winding::NeedlePath& path, const Path& tool, const MachinePath& machine) const {
    PathPlanning planning;
    planning.path = planning.moving = machine.axes;
    const std::size_t n = tool.size();
    const CurvatureFeedLimits curvature{request_.chord_tolerance, request_.cycle_time, request_.half_speed_curvature,
                                        request_.along.velocity};
    planning.feeds = planning.feeds_to_verify = curvature_feeds(tool, curvature);
    planning.rests = std::vector<bool>(n + 1, false);
    planning.rests.front() = planning.rests.back() = true;
    planning.options.along = request_.along;
    planning.options.profile = request_.profile;
    planning.method =
        method_row(request_.law == FeedLaw::bspline ? PlanningMethod::spline : request_.feed, planning.options);
    planning.machine = held_limits({machine.kinematics->axes(), request_.cycle_time}, planning.method);
    // The feed on straight pieces limits the speed; it is not a required feed.
    if (!(request_.half_speed_curvature < unlimited) && request_.along.velocity < unlimited)
      planning.options.feed = request_.along.velocity;
    for (std::size_t i = 0; i < n; ++i) planning.options.shares.push_back(path.pieces[tool[i].source()].share);
    planning.max_setpoints = request_.max_setpoints;
    planning.shown = NeedleSetpoints::shown(planning.machine);
    // A required constant feed is not slowed; the differences of its setpoints tell whether it is possible.
    const bool given = request_.feed == PlanningMethod::constant && planning.options.feed > 0;
    if (request_.links.continuity < 2 && !given) planning.jerk_share = share_beside_steps;
    return planning;
  }

  /// Returns the duration of the whole path with the requested feed, s; infinite if that is impossible.
  double timed(const winding::NeedlePath& path) {
    const PosePath tool = pose_path(path.curves());
    const auto duration = trial([&] {
      const MachinePath machine = machine_path(tool.tool, tool.orientation, request_.configurations);
      PathPlanning planning = planning_of(path, tool.tool, machine);
      planning.only_duration = true;
      return plan_along(planning, progress_.part(linked, linked)).duration;
    });
    return duration ? *duration : unlimited;
  }

  std::shared_ptr<const Path> tool_path() const { return {plan_.tool, &plan_.tool->tool}; }

  void move() {
    PathPlanning planning = planning_of(plan_.path, plan_.tool->tool, plan_.machine);
    const auto wire =
        std::make_shared<const WireRun>(plan_.tool, winding::anchors(plan_.path.pieces, plan_.support, plan_.turns),
                                        request_.model.pull, request_.tension);
    planning.setpoints = [&](const std::shared_ptr<const PathMotion>& motion, std::size_t cycles) {
      return std::make_unique<NeedleSetpoints>(
          motion, plan_.machine.axes, planning.machine,
          WireForces{
              [wire](std::size_t segment, double u, const LawState& law) { return wire->brake(segment, u, law); },
              [wire, motion](double from, double to) { return wire->tension(*motion, from, to); }},
          NeedleSetpoints::Options{cycles, interpolate(motion, cycles), request_.frame});
    };
    if (request_.interpolator != Interpolator::exact) planning.lag = most_lag;
    RowCheck* needle = nullptr;
    const WireRows* wire_rows = nullptr;
    planning.row_checks = [&](const PathMotion& motion, const SetpointSource& setpoints, const Verification& verdict) {
      RowChecks list;
      list.push_back(needle_row_check({*plan_.machine.axes, *plan_.machine.kinematics, setpoints, planning.shown}));
      needle = list.back().get();
      auto rows = std::make_unique<WireRows>(*wire, setpoints, motion, request_.tension.permitted);
      wire_rows = rows.get();
      list.push_back(std::move(rows));
      DifferenceInput differences{setpoints, planning.machine, planning.shown, verdict};
      differences.rounding = rounding_of_rows;
      if (request_.interpolator != Interpolator::exact) differences.feed_tolerance = request_.feed_tolerance;
      list.push_back(difference_row_check(differences));
      list.push_back(coil_slot_row_check(coil_passes(request_, plan_, setpoints)));
      return list;
    };
    plan_.motion = plan_along(planning, progress_.part(reached, planned));
    Verification& verdict = plan_.motion.verification;
    verdict.add(needle->checks());
    verdict.add(curvature_checks({*plan_.machine.axes, plan_.motion.motion->law(), request_.cycle_time,
                                  request_.chord_tolerance, request_.half_speed_curvature, request_.along.velocity},
                                 progress_.part(planned, planned)));
    plan_.wire = wire_rows->figures();
    for (const auto& rows : std::exchange(plan_.motion.row_checks, {}))
      if (rows.get() != needle) verdict.add(rows->checks());
  }

  /// Measures all interpolators, and takes the setpoints of the requested one; the exact one needs no measurement,
  /// because its places are the law's.
  std::shared_ptr<const Interpolation> interpolate(const std::shared_ptr<const PathMotion>& motion,
                                                   std::size_t cycles) {
    std::shared_ptr<const Interpolation> chosen;
    ProgressScope stage_progress(progress_.part(planned, planned), "interpolate");
    for (const auto& row : interpolators) {
      auto stepped =
          std::make_shared<const Interpolation>(motion, row.value, request_.cycle_time, cycles, stage_progress);
      plan_.fluctuation.push_back(stepped->fluctuation());
      if (row.value == request_.interpolator && row.value != Interpolator::exact) chosen = std::move(stepped);
    }
    return chosen;
  }

  /// Returns the fixed piece at a place of the path, or the one from which a link starts.
  const FixedPiece& piece_at(double s) const {
    const Path& tool = plan_.tool->tool;
    return plan_.support[plan_.path.pieces[tool[tool.find(s)].source()].fixed];
  }
  static std::string turn_in_words(const FixedPiece& piece) {
    return "turn " + std::to_string(piece.turn + 1) + " of coil " + std::to_string(piece.coil + 1) + ", at or after " +
           winding::region_in_words(piece.region);
  }
  UnreachableTurn placed(const UnreachablePose& pose) {
    const FixedPiece& piece = piece_at(pose.path_length >= 0 ? pose.path_length : 0);
    const std::string words = turn_in_words(piece) + ": " + pose.what();
    const winding::Pull& pull = request_.model.pull;
    const double circle = winding::bend_radius(pull), least = request_.wire.outer;
    if (!(circle > least) || !reaches_with_least_bend(request_, plan_.turns, piece, progress_))
      return {pose, words, {"machine"}, piece};
    const char* const cause = circle > pull.bend_radius ? "force" : "bend_radius";
    return {pose,
            "the circle of " + number_text(circle, 4) +
                " mm in which the wire bends at the needle takes it out of the machine's reach; one of " +
                number_text(least, 4) + " mm, the least, would not: " + words,
            {"pull", cause},
            piece};
  }
  FeedTooFastAtTurn placed(const FeedTooFast& feed) const {
    const FixedPiece& piece = piece_at(feed.limit.s);
    const char* cause = feed.limit.kind == FeedLimit::Kind::segment_feed ? " (feed.chord_tolerance)" : "";
    return {feed, "feed.velocity: " + turn_in_words(piece) + ": " + feed.what() + cause, piece};
  }

  void report() {
    const double length = winding::wire_length(request_.part, request_.coils, plan_.turns),
                 in_hand = static_cast<double>(request_.parallel);
    plan_.wire_length = in_hand * length;
    plan_.resistance =
        winding::resistance_per_metre(request_.wire, request_.parallel, request_.temperature) * length / 1000;
    plan_.strokes_per_minute = 60 * in_hand * static_cast<double>(plan_.turns.size()) / plan_.motion.duration;
    plan_.fastest = peak_speed(plan_.motion.motion->law());
    for (const LawPiece& piece : plan_.motion.motion->law().pieces())
      plan_.jerk.along = std::max({plan_.jerk.along, std::abs(piece.j), std::abs(piece.at(piece.duration).j)});
    ProgressScope verifying(progress_.part(planned, 1), "verify jerk");
    const verify::Worst total = verify::total_jerk(plan_.tool->tool, plan_.motion.motion->law(), verifying);
    plan_.jerk.total = total.value, plan_.jerk.at = total.at;
    const Path& tool = plan_.tool->tool;
    std::optional<std::size_t> last, passed;
    plan_.support_times.resize(plan_.support.size());
    for (const LawPiece& law : plan_.motion.motion->law().pieces()) {
      const winding::NeedlePiece& piece = plan_.path.pieces[tool[law.segment].source()];
      const FixedPiece& fixed = plan_.support[piece.fixed];
      if (!piece.link) {
        WindingPlan::Passing& times = plan_.support_times[piece.fixed];
        if (passed != piece.fixed) times.begin = law.t0;
        times.end = law.t0 + law.duration;
        passed = piece.fixed;
      }
      if (piece.link || fixed.kind != FixedPiece::Kind::region || fixed.region != 0 || last == piece.fixed) continue;
      last = piece.fixed;
      plan_.turn_begins.push_back(law.t0);
    }
    if (!(plan_.clearance.minimum < unlimited)) return;
    const Progress curve = progress_.part(planned, 1).named("clearance");
    plan_.clearance_curve = clearance_curve(request_, plan_.support, plan_.path, tool, curve);
    plan_.clearance_times = times_at(plan_.clearance_curve.bounds);
    // The last bound is the end of the path: there the needle is so slow that the place says little about the time.
    plan_.clearance_times.back() = plan_.motion.motion->duration();
    const double least = request_.least_clearance, found = plan_.clearance.minimum,
                 at = times_at({tool_length(tool, plan_.clearance.move, plan_.clearance.at)}).front();
    plan_.motion.verification.add(
        verify::make_check(Checked{{"needle clearance", CheckGroup::geometry}}, least, found, at, found >= least));
  }

  /// Returns the times at which the needle passes ascending places `lengths`, mm along its path, to 1e-6 of the law's
  /// piece.
  std::vector<double> times_at(const std::vector<double>& lengths) const {
    const auto& pieces = plan_.motion.motion->law().pieces();
    std::vector<double> times;
    std::size_t k = 0;
    for (const double s : lengths) {
      while (k < pieces.size() && pieces[k].at(pieces[k].duration).s < s) ++k;
      if (k == pieces.size()) {
        times.push_back(plan_.motion.motion->duration());
        continue;
      }
      const LawPiece& law = pieces[k];
      if (law.at(0).s >= s) {
        times.push_back(law.t0);
        continue;
      }
      const auto before = [&](double t) { return law.at(t).s < s; };
      times.push_back(law.t0 + bisect(0, law.duration, 1e-6 * law.duration, 100, before).high);
    }
    return times;
  }

  const WindingRequest& request_;
  OnwardProgress onward_;  // the feed is reached in several rounds
  const Progress progress_{onward_};
  WindingPlan laid_;  ///< layout, turns and verdict, which do not depend on the needle's swivel
  WindingPlan plan_;
};

}  // namespace

double tool_length(const Path& tool, std::size_t piece, double v) {
  for (std::size_t i = 0; i < tool.size(); ++i)
    if (tool[i].source() == piece && v <= tool[i].curve().end()) return tool[i].arc_length(v);
  return tool.length();
}

std::string too_many_spline_turns(std::size_t turns) {
  return "bspline is for comparison: it plans " + std::to_string(max_spline_turns) + " turns at most, these are " +
         std::to_string(turns);
}

WindingPlan plan_winding(const WindingRequest& request, Progress progress) {
  if (request.coils.empty()) throw InvalidInput(std::vector<InputFault>{{{"coil"}, "no coil to wind"}});
  return Planner(request, progress).run();
}

}  // namespace bahnwerk
