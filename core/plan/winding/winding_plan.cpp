#include "core/plan/winding/winding_plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "core/motion/setpoints/needle_setpoints.hpp"
#include "core/plan/winding/wire_length.hpp"
#include "core/verify/setpoints/needle_checks.hpp"
#include "core/winding/fill.hpp"
#include "core/winding/needle/part_obstacles.hpp"

namespace bahnwerk {
namespace {

using winding::FixedPiece;
using winding::RotorPart;
using winding::StatorPart;

constexpr double clearance_tolerance = 0.001;  // mm
// Where the stages end, as shares of the whole job.
constexpr double laid = 0.05, linked = 0.2, cleared = 0.25, reached = 0.3, planned = 0.97;

InvalidInput fault(std::vector<std::string> place, std::string message) {
  return InvalidInput(std::vector<InputFault>{{std::move(place), std::move(message)}});
}

class Planner {
 public:
  Planner(const WindingRequest& request, Progress& progress) : request_(request), progress_(progress) {}

  WindingPlan run() {
    std::visit([&](const auto& part) { lay(part); }, request_.part);
    progress_.report("link", laid);
    plan_.path = winding::needle_path(plan_.support, std::holds_alternative<StatorPart>(request_.part), request_.links,
                                      progress_);
    std::vector<BezierPiece> curves;
    for (const winding::NeedlePiece& piece : plan_.path.pieces) curves.push_back(piece.curve);
    plan_.tool = std::make_shared<const PosePath>(pose_path(curves));
    plan_.path_length = plan_.tool->tool.length();
    progress_.report("clearance", linked);
    std::visit([&](const auto& part) { clear(part, curves); }, request_.part);
    progress_.report("machine", cleared);
    try {
      plan_.machine = machine_path(plan_.tool->tool, plan_.tool->orientation, request_.configurations);
      move();
    } catch (const UnreachablePose& pose) {
      throw placed(pose);
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
    plan_.layout = winding::needle(regions.front(), request_.wire.radius(), slot.tension_point, progress_);
    const std::size_t most = plan_.layout[0].wires.size();
    if (most == 0) throw fault({"wire"}, "does not fit into the slot");
    if (request_.turns > most)
      throw fault({"coil", "turns"}, "need " + std::to_string(request_.turns) +
                                         " places; the layout of this wire has " + std::to_string(most));
    plan_.turns =
        winding::turns_of(regions, plan_.layout, request_.turns > 0 ? request_.turns : most, request_.wire.radius());
    plan_.support = support(part);
  }
  std::vector<FixedPiece> support(const StatorPart& part) const {
    return winding::support_points(part, request_.coils, plan_.turns, request_.model);
  }
  std::vector<FixedPiece> support(const RotorPart& part) const {
    return winding::support_points(part, plan_.turns, request_.model);
  }

  /// Coil by coil, with what stands in the way while that is wound.
  template <class Part>
  void clear(const Part& part, const std::vector<BezierPiece>& curves) {
    const winding::Slot slot = winding::checked_slot(part);
    plan_.clearance.minimum = unlimited;
    const auto& pieces = plan_.path.pieces;
    for (std::size_t begin = 0; begin < pieces.size();) {
      const std::size_t coil = plan_.support[pieces[begin].fixed].coil;
      std::size_t end = begin;
      while (end < pieces.size() && plan_.support[pieces[end].fixed].coil == coil) ++end;
      const winding::PartObstacles all = obstacles(part, slot, request_.coils[coil]);
      winding::Clearance least = winding::clearance(std::span(curves).subspan(begin, end - begin), request_.needle,
                                                    all.list(), clearance_tolerance, progress_);
      least.move += begin;
      if (least.minimum < plan_.clearance.minimum)
        plan_.clearance = least, plan_.nearest = all.list().empty() ? "" : all.name(least.obstacle);
      begin = end;
    }
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
    planning.feeds = planning.feeds_to_verify = std::vector<double>(n, unlimited);
    planning.rests = std::vector<bool>(n + 1, false);
    planning.rests.front() = planning.rests.back() = true;
    planning.method = request_.feed == FeedMethod::natural ? PlanningMethod::natural : PlanningMethod::jerk_limited;
    planning.options.along = request_.along;
    for (std::size_t i = 0; i < n; ++i)
      planning.options.shares.push_back(plan_.path.pieces[plan_.tool->tool[i].source()].share);
    planning.max_setpoints = request_.max_setpoints;
    planning.shown = NeedleSetpoints::shown(planning.machine);
    planning.setpoints = [&](const std::shared_ptr<const PathMotion>& motion, std::size_t cycles) {
      return std::make_unique<NeedleSetpoints>(motion, plan_.machine.axes, planning.machine, cycles,
                                               request_.model.pull.force);
    };
    planning.from = reached, planning.to = planned;
    plan_.motion = plan_along(planning, progress_);
    for (Check& check : needle_checks(
             {*plan_.machine.axes, *plan_.machine.kinematics, *plan_.motion.setpoints, planning.shown}, progress_))
      plan_.motion.verification.add(std::move(check));
  }

  /// Where on the path: which fixed piece, or the one that a link starts from.
  const FixedPiece& piece_at(double s) const {
    const Path& tool = plan_.tool->tool;
    return plan_.support[plan_.path.pieces[tool[tool.find(s)].source()].fixed];
  }
  UnreachableTurn placed(const UnreachablePose& pose) const {
    const FixedPiece& piece = piece_at(pose.path_length >= 0 ? pose.path_length : 0);
    return {pose,
            "turn " + std::to_string(piece.turn + 1) + " of coil " + std::to_string(piece.coil + 1) + ", at or after " +
                winding::region_in_words(piece.region) + ": " + pose.what(),
            piece};
  }

  void tell() {
    plan_.wire_length = winding::wire_length(request_.part, request_.coils, plan_.turns);
    plan_.resistance = winding::resistance_per_metre(request_.wire, 1, request_.temperature) * plan_.wire_length / 1000;
    plan_.strokes_per_minute = 120 * static_cast<double>(plan_.turns.size()) / plan_.motion.duration;
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

WindingPlan plan_winding(const WindingRequest& request, Progress& progress) {
  if (request.coils.empty()) throw fault({"coil"}, "no coil to wind");
  return Planner(request, progress).run();
}

}  // namespace bahnwerk
