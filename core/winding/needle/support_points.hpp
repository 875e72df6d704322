#pragma once
/// The fixed parts of the needle's path: a straight line through every slot, an arc about the part's axis behind the
/// winding tools of a stator, or a straight line along the end cap of a rotor's pole, with the needle's pose at both
/// ends [Herrmann 4.2.6, (4.24)–(4.29), 4.3]. Between them the path is free. Lengths mm, angles rad.
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/expected.hpp"
#include "core/base/progress.hpp"
#include "core/winding/needle/wire_pull.hpp"
#include "core/winding/part/turns.hpp"

namespace bahnwerk::winding {

/// φ is the azimuth in which the needle points, ψ the angle by which it points down; its direction is (cos φ cos ψ, sin
/// φ cos ψ, −sin ψ).
struct NeedlePose {
  Vec3 tip;
  double phi = 0, psi = 0;
  Vec3 direction() const;
};

/// A bar with a round end whose foremost point is the tip; in a section through its axis, a box with a rounded tip.
struct NeedleShape {
  double width = 2.6;  ///< mm
  double length = 60;  ///< distance from the tip to the holder, mm
};

struct SupportPoint {
  NeedlePose pose;
  double pivot_shift = 0;  ///< φ_DPVS: of φ against the azimuth of the tip (4.25); 0 in a rotor and in winding heads
  double exit_angle = 0;   ///< α, of the wire against the needle's axis; above 90° its tension rises [4.2.6]
};

struct FixedPiece {
  enum class Shape { line, arc };  ///< arc: about the part's axis, at one height
  enum class Kind { region, coil_change };
  Kind kind = Kind::region;
  std::size_t coil = 0, turn = 0;  ///< indices; for a change of coils those from which it starts
  std::size_t region = 0;          ///< 0 … 3; of a change 3
  Shape shape = Shape::line;
  SupportPoint begin, end;  ///< φ is continuous from piece to piece, without jumps by whole turns
  double sweep = 0;         ///< rad, sweep of an arc about the axis, counterclockwise positive
};

/// Returns the name of laying region 0 … 3 for messages: "the first slot" …
const char* region_in_words(std::size_t region);

struct NeedleModel {
  Pull pull;
  /// Pivot shift: in a stator's slot the needle swivels about the middle of the tooth opening, by at most this φ_DPVS
  /// to either side. Without it the needle points away from the stator's axis.
  std::optional<double> pivot_limit;
  /// Distance from the axis, and height, by which the needle exceeds any other piece when it passes from coil to coil.
  double change_radius = 5, change_height = 10;
  /// Shape of the needle. The tip is placed where the needle keeps `clearance`, mm, from the part, if such a place
  /// exists (core/winding/needle/channel.hpp). Without a shape the tip is on the straight wire.
  std::optional<NeedleShape> shape;
  double clearance = 0;
};

/// Why no needle lays a wire.
enum class NoSupport {
  no_distance,   ///< two laying regions have no distance: the wire between them has no direction
  short_head,    ///< a winding head is shorter than the needle's travel into it
  no_direction,  ///< no direction of the needle brings the wire to its place
  beyond_axis,   ///< in a slot the needle's tip would lie beyond the part's axis
  backwards      ///< the wire would leave the needle backwards along its axis
};

/// Returns the support points of the turns that turns_of() made from the coil_regions() of these coils. The first
/// turn's wire comes from where turns_of() holds it. Throws InvalidInput naming members of "pull" and "needle",
/// and Stopped. O(turns): some µs each, 2 ms where tips are moved.
Expected<std::vector<FixedPiece>, NoSupport> support_points(const StatorPart& part, const std::vector<Coil>& coils,
                                                            const std::vector<Turn>& turns, const NeedleModel& model,
                                                            Progress progress);
Expected<std::vector<FixedPiece>, NoSupport> support_points(const RotorPart& part, const std::vector<Turn>& turns,
                                                            const NeedleModel& model, Progress progress);

/// Returns the needle in a stator's slot: the tip from which a wire along `along` is laid at `place`, for a needle that
/// points away from the axis or, with a limit, through `pivot` as far as the limit allows. A pivot less than 1 mm
/// before the bend, or behind it, counts as 1 mm before it.
Expected<SupportPoint, NoSupport> slot_support(Vec3 place, Vec3 along, double bend_radius, double free_length,
                                               Vec3 pivot, std::optional<double> pivot_limit);

}  // namespace bahnwerk::winding
