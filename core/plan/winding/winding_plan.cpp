#include "core/plan/winding/winding_plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "core/base/progress_part.hpp"
#include "core/motion/feed/curvature_feed.hpp"
#include "core/motion/setpoints/needle_setpoints.hpp"
#include "core/plan/winding/link_timer.hpp"
#include "core/plan/winding/wire_length.hpp"
#include "core/verify/law/total_jerk.hpp"
#include "core/verify/setpoints/curvature_checks.hpp"
#include "core/verify/setpoints/difference_checks.hpp"
#include "core/verify/setpoints/needle_checks.hpp"
#include "core/winding/fill.hpp"
#include "core/winding/needle/part_obstacles.hpp"
#include "core/winding/path/quick_links.hpp"

namespace bahnwerk {
namespace {

using winding::FixedPiece;
using winding::RotorPart;
using winding::StatorPart;

// Of the longest step: each setpoint is nearer to its own place than to those of its neighbours.
constexpr double most_lag = 0.5;
constexpr double clearance_tolerance = 0.001;  // mm
// Where the stages end, as shares of the whole job.
constexpr double fitted = 0.03, laid = 0.05, linked = 0.2, cleared = 0.25, reached = 0.3, planned = 0.97;

InvalidInput fault(std::vector<std::string> place, std::string message) {
  return InvalidInput(std::vector<InputFault>{{std::move(place), std::move(message)}});
}

class Planner {
 public:
  Planner(const WindingRequest& request, Progress& progress) : request_(request), progress_(progress) {}

  WindingPlan run() {
    std::visit([&](const auto& part) { lay(part); }, request_.part);
    progress_.report("link", laid);
    plan_.path = linked_by(request_.links.objective);
    if (request_.minimum_time) quicken();
    const std::vector<BezierPiece> curves = plan_.path.curves();
    plan_.tool = std::make_shared<const PosePath>(pose_path(curves));
    plan_.path_length = plan_.tool->tool.length();
    progress_.report("clearance", linked);
    plan_.clearance = clear(curves, cleared);
    progress_.report("machine", cleared);
    try {
      plan_.machine = machine_path(plan_.tool->tool, plan_.tool->orientation, request_.configurations);
      move();
    } catch (const UnreachablePose& pose) {
      throw placed(pose);
    } catch (const FeedTooFast& feed) {
      throw placed(feed);
    }
    tell();
    return std::move(plan_);
  }

 private:
  template <class Part>
  void lay(const Part& part) {
    const winding::Slot slot = winding::checked_slot(part);
    std::vector<winding::LayingRegions> regions;
    for (const winding::Coil& coil : request_.coils) regions.push_back(winding::coil_regions(part, slot, coil));
    ProgressPart laying(progress_, "layout", 0, fitted);
    plan_.layout = winding::needle(regions.front(), request_.wire.radius(), slot.tension_point, laying);
    const std::size_t most = plan_.layout[0].wires.size();
    if (most == 0) throw fault({"wire"}, "does not fit into the slot");
    if (request_.turns > most)
      throw fault({"coil", "turns"}, "need " + std::to_string(request_.turns) +
                                         " places; the layout of this wire has " + std::to_string(most));
    plan_.turns =
        winding::turns_of(regions, plan_.layout, request_.turns > 0 ? request_.turns : most, request_.wire.radius());
    if (request_.law == FeedLaw::bspline && plan_.turns.size() > max_spline_turns)
      throw fault({"feed", "law"}, too_many_spline_turns(plan_.turns.size()));
    ProgressPart supporting(progress_, "support points", fitted, laid);
    plan_.support = support(part, supporting);
  }
  std::vector<FixedPiece> support(const StatorPart& part, Progress& progress) const {
    return winding::support_points(part, request_.coils, plan_.turns, needle_model(), progress);
  }
  std::vector<FixedPiece> support(const RotorPart& part, Progress& progress) const {
    return winding::support_points(part, plan_.turns, needle_model(), progress);
  }
  winding::NeedleModel needle_model() const {
    winding::NeedleModel model = request_.model;
    model.shape = request_.needle, model.clearance = request_.least_clearance;
    return model;
  }

  winding::NeedlePath linked_by(LinkObjective objective) {
    winding::LinkOptions options = request_.links;
    options.objective = objective;
    const auto* stator = std::get_if<StatorPart>(&request_.part);
    ProgressPart linking(progress_, "link", laid, linked);
    if (stator == nullptr) return winding::needle_path(plan_.support, false, options, linking);
    const winding::PostPassage posts(*stator, request_.coils, request_.tool, request_.needle, request_.least_clearance);
    return winding::needle_path(plan_.support, true, options, linking, &posts);
  }

  /// Replaces the smoothest links by those that take the least time, if the whole path takes less with them.
  void quicken() {
    const std::vector<BezierPiece> smooth = plan_.path.curves();
    const PosePath tool = pose_path(smooth);
    std::shared_ptr<const Kinematics> machine;
    try {
      machine = machine_path(tool.tool, tool.orientation, request_.configurations).kinematics;
    } catch (const UnreachablePose&) {
      return;  // told with its place when the path is final
    }
    const LinkTimer timer(*machine, request_.along, request_.cycle_time, progress_);
    const winding::NeedlePath substitute = linked_by(LinkObjective::control_distance);
    ProgressPart timing(progress_, "link", linked, linked);
    const winding::QuickLinks quick = winding::quick_links(
        plan_.support, plan_.path, substitute, request_.links,
        [&](std::span<const BezierPiece> pieces) { return timer(pieces); }, timing);
    LinkTimes times{timer.exact(smooth), timer.exact(substitute.curves()), timer.exact(quick.path.curves()),
                    quick.changed, LinkChoice::curvature};
    const double allowed = std::min(request_.least_clearance, clear(smooth, linked).minimum);
    double least = times.curvature;
    const auto take = [&](double time, const winding::NeedlePath& path, LinkChoice choice) {
      if (!(time < least) || !within_ranges(path, machine) || clear(path.curves(), linked).minimum < allowed) return;
      plan_.path = path, times.taken = choice, least = time;
    };
    take(times.control_distance, substitute, LinkChoice::control_distance);
    take(times.minimum_time, quick.path, LinkChoice::minimum_time);
    plan_.link_times = times;
  }
  static bool within_ranges(const winding::NeedlePath& path, const std::shared_ptr<const Kinematics>& machine) {
    try {
      const PosePath tool = pose_path(path.curves());
      machine_path(tool.tool, tool.orientation, {machine});
      return true;
    } catch (const UnreachablePose&) {
      return false;
    }
  }

  /// Which takes from `linked` to `to` of the job.
  winding::Clearance clear(const std::vector<BezierPiece>& curves, double to) {
    return std::visit([&](const auto& part) { return clear(part, curves, to); }, request_.part);
  }
  /// Coil by coil, with what stands in the way while that is wound.
  template <class Part>
  winding::Clearance clear(const Part& part, const std::vector<BezierPiece>& curves, double to) {
    const winding::Slot slot = winding::checked_slot(part);
    winding::Clearance nearest;
    nearest.minimum = unlimited;
    const auto& pieces = plan_.path.pieces;
    for (std::size_t begin = 0; begin < pieces.size();) {
      const std::size_t coil = coil_of(pieces[begin], plan_.support);
      std::size_t end = begin;
      while (end < pieces.size() && coil_of(pieces[end], plan_.support) == coil) ++end;
      const winding::PartObstacles all = obstacles(part, slot, request_.coils[coil]);
      const auto done = [&](std::size_t piece) {
        return linked + (to - linked) * static_cast<double>(piece) / static_cast<double>(pieces.size());
      };
      ProgressPart clearing(progress_, "clearance", done(begin), done(end));
      winding::Clearance least = winding::clearance(std::span(curves).subspan(begin, end - begin), request_.needle,
                                                    all.list(), clearance_tolerance, clearing);
      least.move += begin;
      if (least.minimum < nearest.minimum)
        nearest = least, plan_.nearest = all.list().empty() ? "" : all.name(least.obstacle);
      begin = end;
    }
    return nearest;
  }
  winding::PartObstacles obstacles(const StatorPart& part, const winding::Slot& slot, winding::Coil coil) const {
    return winding::part_obstacles(part, slot, request_.tool, {coil});
  }
  static winding::PartObstacles obstacles(const RotorPart& part, const winding::Slot& slot, winding::Coil) {
    return winding::part_obstacles(part, slot);
  }

  void move() {
    PathPlanning planning;
    planning.path = planning.moving = plan_.machine.axes;
    planning.machine = {plan_.machine.kinematics->axes(), request_.cycle_time};
    const std::size_t n = plan_.tool->tool.size();
    const CurvatureFeedLimits curvature{request_.chord_tolerance, request_.cycle_time, request_.half_speed_curvature,
                                        request_.along.velocity};
    planning.feeds = planning.feeds_to_verify = curvature_feeds(plan_.tool->tool, curvature);
    planning.rests = std::vector<bool>(n + 1, false);
    planning.rests.front() = planning.rests.back() = true;
    planning.method = request_.law == FeedLaw::bspline ? PlanningMethod::spline : request_.feed;
    planning.options.along = request_.along;
    planning.options.profile = request_.profile;
    // The speed that is allowed where the path is straight limits a feed, it is none.
    if (!(request_.half_speed_curvature < unlimited) && request_.along.velocity < unlimited)
      planning.options.feed = request_.along.velocity;
    for (std::size_t i = 0; i < n; ++i)
      planning.options.shares.push_back(plan_.path.pieces[plan_.tool->tool[i].source()].share);
    planning.max_setpoints = request_.max_setpoints;
    planning.shown = NeedleSetpoints::shown(planning.machine);
    const auto wire =
        std::make_shared<const WireRun>(plan_.tool, winding::anchors(plan_.path.pieces, plan_.support, plan_.turns),
                                        request_.model.pull, request_.tension);
    planning.setpoints = [&](const std::shared_ptr<const PathMotion>& motion, std::size_t cycles) {
      return std::make_unique<NeedleSetpoints>(
          motion, plan_.machine.axes, planning.machine, cycles,
          [wire](std::size_t segment, double u, const LawState& law) { return wire->brake(segment, u, law); },
          interpolate(motion, cycles));
    };
    if (request_.interpolator != Interpolator::exact) planning.lag = most_lag;
    planning.from = reached, planning.to = planned;
    plan_.motion = plan_along(planning, progress_);
    for (Check& check : needle_checks(
             {*plan_.machine.axes, *plan_.machine.kinematics, *plan_.motion.setpoints, planning.shown}, progress_))
      plan_.motion.verification.add(std::move(check));
    for (Check& check :
         curvature_checks({*plan_.machine.axes, plan_.motion.motion->law(), request_.cycle_time,
                           request_.chord_tolerance, request_.half_speed_curvature, request_.along.velocity, planned},
                          progress_))
      plan_.motion.verification.add(std::move(check));
    plan_.wire = wire->figures(*plan_.motion.setpoints, *plan_.motion.motion, progress_);
    for (Check& check : wire_checks(plan_.wire, request_.tension.permitted))
      plan_.motion.verification.add(std::move(check));
    if (request_.interpolator == Interpolator::exact) return;
    for (Check& check : difference_checks(
             {*plan_.motion.setpoints, planning.machine, planning.shown, plan_.motion.verification}, progress_))
      plan_.motion.verification.add(std::move(check));
  }

  /// Measures all interpolators; the one that was asked for, nothing of the exact one: its places are the law's.
  std::shared_ptr<const Interpolation> interpolate(const std::shared_ptr<const PathMotion>& motion,
                                                   std::size_t cycles) {
    std::shared_ptr<const Interpolation> chosen;
    ProgressScope scope(progress_, "interpolate", planned, planned);
    for (const auto& row : interpolators) {
      auto stepped = std::make_shared<const Interpolation>(motion, row.value, request_.cycle_time, cycles, scope);
      plan_.fluctuation.push_back(stepped->fluctuation());
      if (row.value == request_.interpolator && row.value != Interpolator::exact) chosen = std::move(stepped);
    }
    return chosen;
  }

  /// Where on the path: which fixed piece, or the one that a link starts from.
  const FixedPiece& piece_at(double s) const {
    const Path& tool = plan_.tool->tool;
    return plan_.support[plan_.path.pieces[tool[tool.find(s)].source()].fixed];
  }
  static std::string turn_in_words(const FixedPiece& piece) {
    return "turn " + std::to_string(piece.turn + 1) + " of coil " + std::to_string(piece.coil + 1) + ", at or after " +
           winding::region_in_words(piece.region);
  }
  UnreachableTurn placed(const UnreachablePose& pose) const {
    const FixedPiece& piece = piece_at(pose.path_length >= 0 ? pose.path_length : 0);
    return {pose, turn_in_words(piece) + ": " + pose.what(), piece};
  }
  FeedTooFastAtTurn placed(const FeedTooFast& feed) const {
    const FixedPiece& piece = piece_at(feed.limit.s);
    const char* cause = feed.limit.kind == FeedLimit::Kind::segment_feed ? " (feed.chord_tolerance)" : "";
    return {feed, "feed.velocity: " + turn_in_words(piece) + ": " + feed.what() + cause, piece};
  }

  void tell() {
    plan_.wire_length = winding::wire_length(request_.part, request_.coils, plan_.turns);
    plan_.resistance = winding::resistance_per_metre(request_.wire, 1, request_.temperature) * plan_.wire_length / 1000;
    plan_.strokes_per_minute = 120 * static_cast<double>(plan_.turns.size()) / plan_.motion.duration;
    plan_.fastest = peak_speed(plan_.motion.motion->law());
    for (const LawPiece& piece : plan_.motion.motion->law().pieces())
      plan_.jerk.along = std::max({plan_.jerk.along, std::abs(piece.j), std::abs(piece.at(piece.duration).j)});
    ProgressScope verifying(progress_, "verify jerk", planned, 1);
    const verify::Worst total = verify::total_jerk(plan_.tool->tool, plan_.motion.motion->law(), verifying);
    plan_.jerk.total = total.value, plan_.jerk.at = total.at;
    const Path& tool = plan_.tool->tool;
    std::optional<std::size_t> last;
    for (const LawPiece& law : plan_.motion.motion->law().pieces()) {
      const winding::NeedlePiece& piece = plan_.path.pieces[tool[law.segment].source()];
      const FixedPiece& fixed = plan_.support[piece.fixed];
      if (piece.link || fixed.kind != FixedPiece::Kind::region || fixed.region != 0 || last == piece.fixed) continue;
      last = piece.fixed;
      plan_.turn_begins.push_back(law.t0);
    }
    if (!(plan_.clearance.minimum < unlimited)) return;
    Check check{"needle clearance", "mm", request_.least_clearance, plan_.clearance.minimum, 0, false};
    check.passed = check.value >= check.limit;
    for (const LawPiece& law : plan_.motion.motion->law().pieces()) {
      if (tool[law.segment].source() < plan_.clearance.move) continue;
      check.at = law.t0;
      break;
    }
    plan_.motion.verification.add(std::move(check));
  }

  const WindingRequest& request_;
  Progress& progress_;
  WindingPlan plan_;
};

}  // namespace

std::string too_many_spline_turns(std::size_t turns) {
  return "bspline is for comparison: it plans " + std::to_string(max_spline_turns) + " turns at most, these are " +
         std::to_string(turns);
}

WindingPlan plan_winding(const WindingRequest& request, Progress& progress) {
  if (request.coils.empty()) throw fault({"coil"}, "no coil to wind");
  return Planner(request, progress).run();
}

}  // namespace bahnwerk
