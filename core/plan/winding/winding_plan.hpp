#pragma once
/// The plan of a winding, from slot, coil and machine to the needle's motion: layouts, turns, support points, path,
/// machine axes, time law, setpoints [Herrmann chapter 4].
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/named.hpp"
#include "core/base/progress.hpp"
#include "core/base/unreachable_at.hpp"
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

/// The methods for the feed along the needle's path.
inline constexpr Named<PlanningMethod> feed_methods[] = {
    {PlanningMethod::natural, "natural"},    // every link is passed evenly in its own parameter [Herrmann 3.3.1]
    {PlanningMethod::constant, "constant"},  // the motion goes from rest to one speed and back to rest [3.3.1]
    {PlanningMethod::critical_points, "critical_points"},  // one speed per piece of the path, changes between [4.4.2]
    {PlanningMethod::jerk_limited, "optimised"}};          // least time under all limits [4.4.3]

/// The algorithm of `optimised`: the convex problem, or for comparison that of the source [4.4.3].
enum class FeedLaw { convex, bspline };
inline constexpr Named<FeedLaw> feed_laws[] = {{FeedLaw::convex, "convex"}, {FeedLaw::bspline, "bspline"}};
/// The largest number of turns, of all coils together, that bspline plans: it takes seconds for each.
inline constexpr std::size_t max_spline_turns = 4;
std::string too_many_spline_turns(std::size_t turns);  ///< message for the document's author

/// Criterion by which the links of a path were chosen.
enum class LinkChoice { curvature, control_distance, minimum_time };
inline constexpr Named<LinkChoice> link_choices[] = {{LinkChoice::curvature, "curvature"},
                                                     {LinkChoice::control_distance, "control_distance"},
                                                     {LinkChoice::minimum_time, "minimum_time"}};

struct WindingRequest {
  std::variant<winding::StatorPart, winding::RotorPart> part;
  winding::Wire wire;
  std::vector<winding::Coil> coils;  ///< coils in the order in which they are wound, at least one
  std::size_t turns = 0;             ///< turns of each coil; 0: as many as the slot takes
  std::size_t parallel = 1;          ///< wires in hand: every turn lays as many
  winding::ProducibleOptions hold;   ///< friction and tolerance that hold a laid wire
  winding::NeedleModel model;
  winding::TensionModel tension;  ///< tension model; its force is that of model.pull
  double bears = 0;               ///< N, breaking force of the wire
  winding::NeedleShape needle;
  double swivel_length = unlimited;  ///< length from the swivel's axis to the needle's tip, mm
  winding::ToolPost tool;            ///< posts of a stator's winding tools
  double least_clearance = 0;        ///< mm, least clearance that the needle has to keep
  winding::LinkOptions links;
  /// Whether β and weights of the links minimise the machine's time, starting with those of `links`
  /// (core/winding/path/quick_links.hpp).
  bool minimum_time = false;
  /// The machine, one entry for each configuration in which its arm can reach a pose.
  std::vector<std::shared_ptr<const Kinematics>> configurations;
  double cycle_time = 0.002;                           ///< s
  PlanningMethod feed = PlanningMethod::jerk_limited;  ///< feed method, one of feed_methods
  FeedLaw law = FeedLaw::convex;                       ///< algorithm of jerk_limited
  /// Speed profile of feed changes for the methods constant and critical_points.
  SpeedProfile profile = SpeedProfile::double_s;
  Limits along;                   ///< limits of the needle along its path: feed mm/s, tangential acceleration, jerk
  double feed_tolerance = 0.004;  ///< fraction by which setpoints of an interpolator may exceed along.velocity
  double chord_tolerance = unlimited;       ///< mm, of the path from the chords between setpoints
  double half_speed_curvature = unlimited;  ///< 1/mm, at which half of along.velocity is allowed
  double temperature = 20;                  ///< °C, of the coil's resistance
  Interpolator interpolator = Interpolator::exact;
  double max_setpoints = 20'000'000;
  std::optional<PoseFrame> frame = {};  ///< frame of the setpoints' poses
};

/// The least clearance of the needle over the path, interval by interval.
struct ClearanceCurve {
  std::vector<double> bounds;        ///< mm along the path, ascending; one more than intervals
  std::vector<double> least;         ///< least clearance of each interval, mm, proven to `tolerance`
  std::vector<std::size_t> nearest;  ///< obstacle of each interval, an index in `names`
  std::vector<std::string> names;    ///< names of obstacles, each once
  double tolerance = 0, enough = 0;  ///< mm; clearances of `enough` and more are not distinguished
};

/// Durations of the whole path with the requested feed, s, for links chosen by each criterion. The path with the least
/// one is taken, unless it comes nearer to obstacles than both the smoothest path and the request allow.
struct LinkTimes {
  double curvature = 0, control_distance = 0, minimum_time = 0;
  std::size_t changed = 0;  ///< number of links in the quick path that differ from the smoothest ones
  LinkChoice taken = LinkChoice::curvature;
};

struct WindingPlan {
  winding::NeedleLayout layout;              ///< layouts of all four regions with as many wires as the slot takes
  winding::Windable windable;                ///< the verdict on the layout: its first 400 wires, and all that are wound
  std::vector<winding::Turn> turns;          ///< turns of all coils
  std::vector<winding::FixedPiece> support;  ///< the support points are their ends
  winding::NeedlePath path;
  std::optional<LinkTimes> link_times;  ///< set if minimum_time was requested
  winding::Clearance clearance;         ///< least clearance; its `move` is an index in path.pieces
  ClearanceCurve clearance_curve;
  std::vector<double> clearance_times;   ///< s, when the needle passes each of its bounds
  std::string nearest;                   ///< name of the nearest obstacle, such as "stack"
  std::shared_ptr<const PosePath> tool;  ///< path.pieces as a path; source() of a segment is the index in path.pieces
  MachinePath machine;
  PathPlan motion;  ///< the motion; it has the verification of the whole plan, with clearance and forward kinematics
  double path_length = 0;  ///< mm
  double wire_length = 0;  ///< mm, of all wires of all coils: through the middle of their places
  double resistance = 0;   ///< Ω, of all coils in series
  double fastest = 0;      ///< mm/s, of the needle along its path
  /// The needle's jerk: the largest along the path, the largest in space and its time [(4.80)], mm/s³, s.
  struct Jerk {
    double along = 0, total = 0, at = 0;
  } jerk;
  double strokes_per_minute = 0;    ///< wires in hand by the mean time of a turn [Herrmann (2.3)]
  std::vector<double> turn_begins;  ///< s, when each turn begins
  /// Times, s, at which the needle is at both ends of a fixed piece.
  struct Passing {
    double begin = 0, end = 0;
  };
  std::vector<Passing> support_times;        ///< one per entry of `support`
  WireFigures wire;                          ///< figures of the wire in the setpoints
  std::vector<FeedFluctuation> fluctuation;  ///< one entry per interpolator in `interpolators`
};

/// A pose of the needle's path is out of the machine's reach; the error names its turn and region.
struct UnreachableTurn : UnreachableAt {
  UnreachableTurn(const UnreachablePose& reached, const std::string& what, std::vector<std::string> member,
                  const winding::FixedPiece& piece)
      : UnreachableAt(what, reached, std::move(member)), coil(piece.coil), turn(piece.turn), region(piece.region) {}
  std::size_t coil, turn, region;
};

/// A requested constant feed exceeds a limit; the error names turn and region.
struct FeedTooFastAtTurn : FeedTooFast {
  FeedTooFastAtTurn(const FeedTooFast& feed, const std::string& text, const winding::FixedPiece& piece)
      : FeedTooFast(text, feed.limit, feed.asked), coil(piece.coil), turn(piece.turn), region(piece.region) {}
  std::size_t coil, turn, region;
};

/// Returns the needle's path length at parameter `v` of a piece, mm.
double tool_length(const Path& tool, std::size_t piece, double v);

/// Returns the verified plan. Throws InvalidInput naming members of the kind's document (part, coil, machine, path,
/// feed, pull, needle), Infeasible, FeedTooFastAtTurn, UnreachableTurn and Stopped. Cost: some ms per turn and machine.
WindingPlan plan_winding(const WindingRequest& request, Progress progress);

}  // namespace bahnwerk
