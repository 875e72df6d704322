#pragma once
/// From a slot, a coil and a machine to the motion of the needle: layouts, turns, support points, path, machine axes,
/// time law, setpoints [Herrmann chapter 4].
#include <cstddef>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/named.hpp"
#include "core/base/progress.hpp"
#include "core/motion/axes/machine_path.hpp"
#include "core/plan/path_plan.hpp"
#include "core/plan/winding/pose_path.hpp"
#include "core/winding/laying/needle.hpp"
#include "core/winding/needle/clearance.hpp"
#include "core/winding/needle/support_points.hpp"
#include "core/winding/part/turns.hpp"
#include "core/winding/path/needle_path.hpp"
#include "core/winding/wire.hpp"

namespace bahnwerk {

/// How fast the needle goes along its path.
enum class FeedMethod {
  natural,   ///< every link evenly in its own parameter [Herrmann 3.3.1]
  optimised  ///< least time under all limits [Herrmann 4.4]
};
inline constexpr Named<FeedMethod> feed_methods[] = {{FeedMethod::natural, "natural"},
                                                     {FeedMethod::optimised, "optimised"}};

struct WindingRequest {
  std::variant<winding::StatorPart, winding::RotorPart> part;
  winding::Wire wire;
  std::vector<winding::Coil> coils;  ///< in the order in which they are wound, one at least
  std::size_t turns = 0;             ///< of each coil; 0: as many as the slot takes
  winding::NeedleModel model;
  winding::NeedleShape needle;
  winding::ToolPost tool;      ///< of a stator's winding tools
  double least_clearance = 0;  ///< that the needle has to keep, mm
  winding::LinkOptions links;
  /// The machine: one, or one for each way in which its arm can reach a pose.
  std::vector<std::shared_ptr<const Kinematics>> configurations;
  double cycle_time = 0.002;  ///< s
  FeedMethod feed = FeedMethod::optimised;
  Limits along;             ///< of the needle along its path: feed mm/s, tangential acceleration, jerk
  double temperature = 20;  ///< °C, of the coil's resistance
  double max_setpoints = 20'000'000;
};

struct WindingPlan {
  winding::NeedleLayout layout;              ///< of all four regions: as many wires as the slot takes
  std::vector<winding::Turn> turns;          ///< of all coils
  std::vector<winding::FixedPiece> support;  ///< the support points are their ends
  winding::NeedlePath path;
  winding::Clearance clearance;          ///< its `move`: index in path.pieces
  std::string nearest;                   ///< the obstacle there, such as "stack"
  std::shared_ptr<const PosePath> tool;  ///< the same as a path; source() of a segment: index in path.pieces
  MachinePath machine;
  PathPlan motion;                  ///< its verification is the whole plan's: clearance and forward kinematics, too
  double path_length = 0;           ///< mm
  double wire_length = 0;           ///< mm, of all coils: through the middle of the wire's places
  double resistance = 0;            ///< Ω, of all coils in series
  double strokes_per_minute = 0;    ///< passages of the needle through slots: two per turn
  std::vector<double> turn_begins;  ///< s, when each turn begins
};

/// A pose of the needle's path out of the machine's reach: in which turn and where.
struct UnreachableTurn : UnreachablePose {
  UnreachableTurn(const UnreachablePose& place, const std::string& what, const winding::FixedPiece& piece)
      : UnreachablePose(what, place.path_length, place.pose),
        coil(piece.coil),
        turn(piece.turn),
        region(piece.region) {}
  std::size_t coil, turn, region;
};

/// Throws InvalidInput naming members of the kind's document (part, coil, machine, path, feed, pull, needle);
/// Infeasible; UnreachableTurn; Stopped. Cost: some ms per turn and machine.
WindingPlan plan_winding(const WindingRequest& request, Progress& progress);

}  // namespace bahnwerk
