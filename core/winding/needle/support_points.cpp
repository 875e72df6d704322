#include "core/winding/needle/support_points.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/progress_scope.hpp"
#include "core/winding/needle/channel.hpp"
#include "core/winding/needle/rotor_obstacles.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double pi = std::numbers::pi;
// mm: margin of a moved tip beyond the required clearance, because links and lines come slightly nearer; and its
// accuracy.
constexpr double margin = 0.1, lack_exact = 1e-3;
constexpr std::size_t units_per_tip = 400;  // units of work for progress, per tip with its distances

double nearest_turn(double angle, double to) { return to + std::remainder(angle - to, 2 * pi); }

/// Returns the direction of unit length; none without a distance.
std::optional<Vec3> direction(Vec3 from, Vec3 to) {
  const Vec3 way = to - from;
  const double length = norm(way);
  if (!(length > 1e-9)) return std::nullopt;
  return (1 / length) * way;
}

void check(const NeedleModel& model) {
  std::vector<InputFault> faults;
  if (model.pivot_limit && !(*model.pivot_limit >= 0 && *model.pivot_limit < pi / 2))
    faults.push_back({{"needle", "pivot_limit"}, "is not from 0° to less than 90°"});
  if (!(model.change_radius >= 0)) faults.push_back({{"needle", "change_radius"}, "is not a number of 0 or more"});
  if (!(model.change_height >= 0)) faults.push_back({{"needle", "change_height"}, "is not a number of 0 or more"});
  if (!faults.empty()) throw InvalidInput(faults);
}

/// Collects pieces with continuous angles.
class Pieces {
 public:
  explicit Pieces(const NeedleModel& model) : model_(model) {}
  void add(FixedPiece piece) {
    piece.begin.pose.phi = list_.empty() ? piece.begin.pose.phi : run_on(piece.begin.pose.phi);
    piece.end.pose.phi = piece.shape == FixedPiece::Shape::arc ? piece.begin.pose.phi + piece.sweep
                                                               : nearest_turn(piece.end.pose.phi, piece.begin.pose.phi);
    list_.push_back(piece);
    if (piece.kind == FixedPiece::Kind::coil_change) return;
    for (const SupportPoint* s : {&piece.begin, &piece.end}) {
      farthest_ = std::max(farthest_, std::hypot(s->pose.tip.x, s->pose.tip.y));
      highest_ = std::max(highest_, s->pose.tip.z);
    }
  }
  /// Inserts an arc between each two coils, above and outside all other pieces.
  std::vector<FixedPiece> with_changes() && {
    std::vector<FixedPiece> pieces = std::move(list_);
    list_.clear();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (i > 0 && pieces[i].coil != pieces[i - 1].coil) add(change(pieces[i - 1], pieces[i]));
      add(pieces[i]);
    }
    return std::move(list_);
  }

 private:
  double run_on(double phi) const { return nearest_turn(phi, list_.back().end.pose.phi); }
  FixedPiece change(const FixedPiece& from, const FixedPiece& to) const {
    FixedPiece arc = from;
    arc.kind = FixedPiece::Kind::coil_change;
    arc.shape = FixedPiece::Shape::arc;
    arc.begin = from.end;
    const double begin = azimuth(from.end.pose.tip), radius = farthest_ + model_.change_radius,
                 height = highest_ + model_.change_height;
    arc.sweep = std::remainder(azimuth(to.begin.pose.tip) - begin, 2 * pi);
    arc.end = arc.begin;
    const auto at = [&](double angle) { return radius * radial(angle) + Vec3{0, 0, height}; };
    arc.begin.pose.tip = at(begin);
    arc.end.pose.tip = at(begin + arc.sweep);
    return arc;
  }
  const NeedleModel& model_;
  std::vector<FixedPiece> list_;
  double farthest_ = 0, highest_ = 0;
};

/// The winding head of a stator, in which the needle points along the axis towards the stack. The arc has the larger
/// radius and the larger distance from the stack of both its ends, so that the wire bends nowhere more than at these.
Expected<FixedPiece, NoSupport> head(const Passage& p, double sense, bool top, double rho, double length) {
  FixedPiece piece;
  piece.shape = FixedPiece::Shape::arc;
  const double out = top ? 1 : -1;
  const Vec3 needle{0, 0, -out};
  const std::optional<Vec3> held = direction(p.held, p.begin);
  if (!held) return NoSupport::no_distance;
  const std::optional<TipOffset> in = tip_offset(*held, needle, rho, length);
  if (!in) return NoSupport::backwards;
  const Vec3 tip = p.begin + in->offset;
  // Along the arc the wire trails horizontally: a right angle with the needle.
  const double lead = length + rho, radius = std::max(std::hypot(tip.x, tip.y), std::hypot(p.end.x, p.end.y)),
               height = out * std::max(out * tip.z, out * p.end.z + rho);
  const double between = sense * (azimuth(p.end) - azimuth(p.begin)),
               wires = between - 2 * pi * std::floor(between / (2 * pi)),
               sweep = wires + lead / radius - sense * std::remainder(azimuth(tip) - azimuth(p.begin), 2 * pi);
  if (!(sweep > 0)) return NoSupport::short_head;
  piece.sweep = sense * sweep;
  const double begin = azimuth(tip), psi = out * pi / 2;  // (4.26)
  const auto at = [&](double angle) { return radius * radial(angle) + Vec3{0, 0, height}; };
  piece.begin = {{at(begin), begin, psi}, 0, in->exit_angle};
  piece.end = {{at(begin + piece.sweep), begin + piece.sweep, psi}, 0, pi / 2};
  return piece;
}

/// A laying region in which the needle moves along a line.
struct LineRegion {
  Vec3 across;  ///< unit vector along which the wire's direction is changed for more distance
  /// Returns the support point of a wire that runs in a direction over a place.
  std::function<Expected<SupportPoint, NoSupport>(Vec3 place, Vec3 along)> leading;
  std::function<double(const NeedlePose& pose)> standing;  ///< clearance of the needle, mm
  /// Returns the clearance of the needle along a line, mm.
  std::function<double(const NeedlePose& begin, const NeedlePose& end)> between;
};

/// Computes the ends of a line in a laying region. Reports `stage_progress`. Returns why there are none.
std::optional<NoSupport> set_ends(FixedPiece& piece, const Passage& p, const LineRegion& region,
                                  const NeedleModel& model, ProgressScope& stage_progress) {
  const std::optional<Vec3> in = direction(p.held, p.begin), out = direction(p.begin, p.end);
  if (!in || !out) return NoSupport::no_distance;
  const auto over = [&](Vec3 place, Vec3 along) {
    stage_progress.work(units_per_tip);
    return region.leading(place, along);
  };
  const auto begin = [&](Vec3 along) { return over(p.begin, along); };
  const auto end = [&](Vec3 along) { return over(p.end, along); };
  /// Takes both points, if there are such.
  const auto take = [&](const Expected<SupportPoint, NoSupport>& first,
                        const Expected<SupportPoint, NoSupport>& last) -> std::optional<NoSupport> {
    if (!first) return first.reason();
    if (!last) return last.reason();
    piece.begin = *first, piece.end = *last;
    return std::nullopt;
  };
  if (const auto none = take(begin(*in), end(*out)); none || !model.shape) return none;
  // Each end has to increase its distance by what the line lacks.
  double at_begin = region.standing(piece.begin.pose), at_end = region.standing(piece.end.pose);
  for (int round = 0; round < 8; ++round) {
    const double lacking = model.clearance + margin - region.between(piece.begin.pose, piece.end.pose);
    if (!(lacking > lack_exact)) break;
    at_begin += lacking, at_end += lacking;
    if (const auto none = take(kept_clear(*in, region.across, begin, region.standing, at_begin),
                               kept_clear(*out, region.across, end, region.standing, at_end)))
      return none;
  }
  return std::nullopt;
}

}  // namespace

const char* region_in_words(std::size_t region) {
  static constexpr const char* names[] = {"the first slot", "the lower winding head", "the second slot",
                                          "the upper winding head"};
  return names[region];
}

Vec3 NeedlePose::direction() const {
  return {std::cos(phi) * std::cos(psi), std::sin(phi) * std::cos(psi), -std::sin(psi)};
}

Expected<std::vector<FixedPiece>, NoSupport> support_points(const StatorPart& part, const std::vector<Coil>& coils,
                                                            const std::vector<Turn>& turns, const NeedleModel& model,
                                                            Progress progress) {
  check(model);
  ProgressScope stage_progress(progress, "support points");
  const double rho = bend_radius(model.pull), length = model.pull.free_length;
  // The tooth tips are nearest to each other at this place.
  const double opening = part.heads.base_radius - part.slot.height - part.slot.tip_corner_radius;
  const Slot slot_shape = checked_slot(part);
  const StatorIron iron(part, slot_shape);
  Pieces pieces(model);
  for (const Turn& turn : turns) {
    stage_progress.now(static_cast<std::size_t>(&turn - turns.data()), turns.size());
    const Coil& coil = coils.at(turn.coil);
    for (std::size_t j = 0; j < 4; ++j) {
      const Passage& p = turn.at[j];
      FixedPiece piece;
      if (j % 2 == 1) {
        const double sense = (coil.span > 0) == (j == 1) ? 1 : -1;
        Expected<FixedPiece, NoSupport> arc = head(p, sense, j == 3, rho, length);
        if (!arc) return arc.reason();
        piece = *arc;
      } else {
        const double slot = slot_azimuth(part, coil.first + (j == 2 ? coil.span : 0));
        const OneSlot own(iron, slot);
        const Vec3 pivot = opening * radial(slot);
        LineRegion region;
        region.across = radial(slot + pi / 2);
        region.leading = [&](Vec3 place, Vec3 along) {
          return slot_support(place, along, rho, length, pivot, model.pivot_limit);
        };
        region.standing = [&](const NeedlePose& pose) {
          return slot_room(pose, pose, pose.tip.z, pose.tip.z, *model.shape, own);
        };
        region.between = [&](const NeedlePose& from, const NeedlePose& to) {
          return slot_room(from, to, 0, part.heads.stack, *model.shape, own);
        };
        if (const auto none = set_ends(piece, p, region, model, stage_progress)) return *none;
      }
      piece.coil = turn.coil, piece.turn = turn.number, piece.region = j;
      pieces.add(piece);
    }
  }
  return std::move(pieces).with_changes();
}

Expected<std::vector<FixedPiece>, NoSupport> support_points(const RotorPart& part, const std::vector<Turn>& turns,
                                                            const NeedleModel& model, Progress progress) {
  check(model);
  ProgressScope stage_progress(progress, "support points");
  const double rho = bend_radius(model.pull), length = model.pull.free_length;
  // The needle points at the axis (4.28): its tip is on the outer side of the bend, whose tangents meet at C.
  const auto leading = [&](Vec3 place, Vec3 along) -> Expected<SupportPoint, NoSupport> {
    SupportPoint found;
    double tangent = rho;
    for (int i = 0; i < 200; ++i) {
      found.pose.phi = azimuth(place + (length + tangent) * along) + pi;
      const std::optional<TipOffset> tip = tip_offset(along, radial(found.pose.phi), rho, length);
      if (!tip) return NoSupport::backwards;
      found.pose.tip = place + tip->offset;
      found.exit_angle = tip->exit_angle;
      const double next = rho * std::tan(tip->exit_angle / 2);
      if (std::abs(next - tangent) <= 1e-14 * (1 + tangent)) return found;
      tangent = i < 20 ? next : (tangent + next) / 2;
    }
    return NoSupport::no_direction;
  };
  const Slot slot_shape = checked_slot(part);
  const RotorIron iron(part, slot_shape, {});
  const std::vector<Wall> walls = cap_walls(part, slot_shape);
  Pieces pieces(model);
  for (const Turn& turn : turns) {
    stage_progress.now(static_cast<std::size_t>(&turn - turns.data()), turns.size());
    for (std::size_t j = 0; j < 4; ++j) {
      const Passage& p = turn.at[j];
      const bool slot = j % 2 == 0;
      const Vec3 middle = radial(azimuth(p.begin + p.end) + pi / 2);
      const auto pole = std::lround(azimuth(p.begin + p.end) / part.pitch()) + part.poles;
      const Wall& wall = walls[2 * (static_cast<std::size_t>(pole % part.poles)) + (j == 3)];
      const OneSlot own(iron, (std::floor(azimuth(p.begin) / part.pitch()) + 0.5) * part.pitch());
      LineRegion region;
      region.leading = leading;
      region.between = [&](const NeedlePose& from, const NeedlePose& to) {
        return slot ? slot_room(from, to, -part.heads.cap_base, part.heads.stack + part.heads.cap_base, *model.shape,
                                own)
                    : room(from, to, *model.shape, {&iron, &wall});
      };
      region.standing = [&](const NeedlePose& pose) {
        if (slot) return slot_room(pose, pose, pose.tip.z, pose.tip.z, *model.shape, own);
        // Along an end cap the needle continues to the middle of the pole.
        NeedlePose to = pose;
        to.tip = pose.tip - dot(pose.tip, middle) * middle;
        to.phi = pose.phi + std::remainder(azimuth(to.tip) - azimuth(pose.tip), 2 * pi);
        return room(pose, to, *model.shape, {&iron, &wall});
      };
      // The tip moves sideways across a slot, along the part's axis across an end cap.
      region.across = slot ? radial(azimuth(p.begin) + pi / 2) : Vec3{0, 0, 1};
      FixedPiece piece;
      if (const auto none = set_ends(piece, p, region, model, stage_progress)) return *none;
      piece.coil = turn.coil, piece.turn = turn.number, piece.region = j;
      pieces.add(piece);
    }
  }
  return std::move(pieces).with_changes();
}

}  // namespace bahnwerk::winding
