#pragma once
/// From a slot, a coil and a machine to the motion of the needle: layouts, turns, support points, path, machine axes,
/// time law, setpoints [Herrmann chapter 4].
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/named.hpp"
#include "core/motion/axes/machine_path.hpp"
#include "core/motion/feed/constant_feed.hpp"
#include "core/motion/interpolation/interpolation.hpp"
#include "core/plan/path_plan.hpp"
#include "core/plan/winding/pose_path.hpp"
#include "core/plan/winding/wire_run.hpp"
#include "core/winding/laying/needle.hpp"
#include "core/winding/laying/windable.hpp"
#include "core/winding/needle/clearance.hpp"
#include "core/winding/needle/support_points.hpp"
#include "core/winding/part/turns.hpp"
#include "core/winding/path/needle_path.hpp"
#include "core/winding/wire.hpp"

namespace bahnwerk {

class Progress;

/// How fast the needle goes along its path.
inline constexpr Named<PlanningMethod> feed_methods[] = {
    {PlanningMethod::natural, "natural"},                  // every link evenly in its own parameter [Herrmann 3.3.1]
    {PlanningMethod::constant, "constant"},                // from rest to one speed and back to rest [3.3.1]
    {PlanningMethod::critical_points, "critical_points"},  // one speed per piece of the path, changes between [4.4.2]
    {PlanningMethod::jerk_limited, "optimised"}};          // least time under all limits [4.4.3]

/// How `optimised` finds its law: by the convex problem, or for comparison as the source does it [4.4.3].
enum class FeedLaw { convex, bspline };
inline constexpr Named<FeedLaw> feed_laws[] = {{FeedLaw::convex, "convex"}, {FeedLaw::bspline, "bspline"}};
/// The largest number of turns, of all coils together, that bspline plans: it takes seconds for each.
inline constexpr std::size_t max_spline_turns = 4;
std::string too_many_spline_turns(std::size_t turns);  ///< what a document's author is told

/// Whose links a path has.
enum class LinkChoice { curvature, control_distance, minimum_time };
inline constexpr Named<LinkChoice> link_choices[] = {{LinkChoice::curvature, "curvature"},
                                                     {LinkChoice::control_distance, "control_distance"},
                                                     {LinkChoice::minimum_time, "minimum_time"}};

struct WindingRequest {
  std::variant<winding::StatorPart, winding::RotorPart> part;
  winding::Wire wire;
  std::vector<winding::Coil> coils;  ///< in the order in which they are wound, one at least
  std::size_t turns = 0;             ///< of each coil; 0: as many as the slot takes
  std::size_t parallel = 1;          ///< wires in hand: every turn lays as many
  winding::ProducibleOptions hold;   ///< what holds a wire that was laid
  winding::NeedleModel model;
  winding::TensionModel tension;  ///< its force is model.pull's
  double bears = 0;               ///< the pull at which the wire breaks, N
  winding::NeedleShape needle;
  double swivel_length = unlimited;  ///< from the swivel's axis to the needle's tip, mm
  winding::ToolPost tool;            ///< of a stator's winding tools
  double least_clearance = 0;        ///< that the needle has to keep, mm
  winding::LinkOptions links;
  /// β and weights of the links by the time that the machine takes, from those of `links` on
  /// (core/winding/path/quick_links.hpp).
  bool minimum_time = false;
  /// The machine: one, or one for each way in which its arm can reach a pose.
  std::vector<std::shared_ptr<const Kinematics>> configurations;
  double cycle_time = 0.002;                           ///< s
  PlanningMethod feed = PlanningMethod::jerk_limited;  ///< one of feed_methods
  FeedLaw law = FeedLaw::convex;                       ///< of jerk_limited
  /// How the feed changes with methods constant and critical_points.
  SpeedProfile profile = SpeedProfile::double_s;
  Limits along;                        ///< of the needle along its path: feed mm/s, tangential acceleration, jerk
  double feed_tolerance = 0.004;       ///< fraction by which setpoints of an interpolator may exceed along.velocity
  double chord_tolerance = unlimited;  ///< mm, of the path from the chords between setpoints
  double half_speed_curvature = unlimited;  ///< 1/mm, at which half of along.velocity is allowed
  double temperature = 20;                  ///< °C, of the coil's resistance
  Interpolator interpolator = Interpolator::exact;
  double max_setpoints = 20'000'000;
  std::optional<PoseFrame> frame = {};  ///< of the setpoints' poses
};

/// What links by time gain: durations of the whole path with the feed that was asked for, s. The least of them is
/// taken, but for paths that come nearer to what the needle must not touch than the smoothest does and the request
/// allows.
struct LinkTimes {
  double curvature = 0, control_distance = 0, minimum_time = 0;
  std::size_t changed = 0;  ///< links that are not the smoothest, of the path with quick links
  LinkChoice taken = LinkChoice::curvature;
};

struct WindingPlan {
  winding::NeedleLayout layout;              ///< of all four regions: as many wires as the slot takes
  winding::Windable windable;                ///< the verdict on the layout: its first 400 wires, and all that are wound
  std::vector<winding::Turn> turns;          ///< of all coils
  std::vector<winding::FixedPiece> support;  ///< the support points are their ends
  winding::NeedlePath path;
  std::optional<LinkTimes> link_times;   ///< of minimum_time
  winding::Clearance clearance;          ///< its `move`: index in path.pieces
  std::string nearest;                   ///< the obstacle there, such as "stack"
  std::shared_ptr<const PosePath> tool;  ///< the same as a path; source() of a segment: index in path.pieces
  MachinePath machine;
  PathPlan motion;         ///< its verification is the whole plan's: clearance and forward kinematics, too
  double path_length = 0;  ///< mm
  double wire_length = 0;  ///< mm, of all wires of all coils: through the middle of their places
  double resistance = 0;   ///< Ω, of all coils in series
  double fastest = 0;      ///< mm/s, of the needle along its path
  /// Its jerk: the largest along the path, and in space with when [(4.80)], mm/s³, s.
  struct Jerk {
    double along = 0, total = 0, at = 0;
  } jerk;
  double strokes_per_minute = 0;             ///< wires in hand by the mean time of a turn [Herrmann (2.3)]
  std::vector<double> turn_begins;           ///< s, when each turn begins
  WireFigures wire;                          ///< of the setpoints
  std::vector<FeedFluctuation> fluctuation;  ///< of all `interpolators`, in their order
};

/// Says in which turn and where a pose of the needle's path is out of the machine's reach.
struct UnreachableTurn : UnreachablePose {
  UnreachableTurn(const UnreachablePose& place, const std::string& what, const winding::FixedPiece& piece)
      : UnreachablePose(what, place.path_length, place.pose),
        coil(piece.coil),
        turn(piece.turn),
        region(piece.region) {}
  std::size_t coil, turn, region;
};

/// Says in which turn and where a constant feed that was asked for breaks a limit.
struct FeedTooFastAtTurn : FeedTooFast {
  FeedTooFastAtTurn(const FeedTooFast& feed, const std::string& text, const winding::FixedPiece& piece)
      : FeedTooFast(text, feed.limit, feed.asked), coil(piece.coil), turn(piece.turn), region(piece.region) {}
  std::size_t coil, turn, region;
};

/// Returns the needle's path length at parameter `v` of a piece, mm.
double tool_length(const Path& tool, std::size_t piece, double v);

/// Throws InvalidInput naming members of the kind's document (part, coil, machine, path, feed, pull, needle);
/// Infeasible; FeedTooFastAtTurn; UnreachableTurn; Stopped. Cost: some ms per turn and machine.
WindingPlan plan_winding(const WindingRequest& request, Progress& progress);

}  // namespace bahnwerk
