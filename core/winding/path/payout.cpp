#include "core/winding/path/payout.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/winding/part/vec3.hpp"

namespace bahnwerk::winding {
namespace {

constexpr double shortest = 0.01;  // mm, of the straight wire
constexpr double straight = 1e-3;  // mm: nearer to the needle's axis the distance from it has no use as a number

bool reached(const FixedPiece& piece, const Turn& turn) { return turn.coil == piece.coil && turn.number == piece.turn; }

Anchor lying(const FixedPiece& piece, const Passage& passage) {
  Anchor anchor{.begin = passage.begin};
  if (piece.shape == FixedPiece::Shape::line) return anchor;
  const double wires = azimuth(passage.end) - azimuth(passage.begin);
  anchor.sweep = piece.sweep + std::remainder(wires - piece.sweep, 2 * std::numbers::pi);
  anchor.out = std::hypot(passage.end.x, passage.end.y) - std::hypot(passage.begin.x, passage.begin.y);
  anchor.up = passage.end.z - passage.begin.z;
  return anchor;
}

/// Returns the angle about the axis by which the wire lies on the arc, in the arc's sense, between 0 and the whole arc.
Rate lying_angle(const PoseRates& needle, const Anchor& anchor, double lead) {
  const double sense = anchor.sweep > 0 ? 1 : -1, all = std::abs(anchor.sweep);
  const double quarter = std::numbers::pi / 2, turn = 2 * std::numbers::pi;
  Rate angle = sense * (atan2(needle.y, needle.x) - Rate(azimuth(anchor.begin))) -
               Rate(lead) / sqrt(needle.x * needle.x + needle.y * needle.y);
  // The needle may begin a little behind the wire's place.
  angle.c[0] -= turn * std::floor((angle.c[0] + quarter) / turn);
  if (angle.value() <= 0) return 0.0;
  return angle.value() < all ? angle : Rate(all);
}

}  // namespace

std::vector<Anchor> anchors(const std::vector<NeedlePiece>& pieces, const std::vector<FixedPiece>& support,
                            const std::vector<Turn>& turns) {
  std::vector<Anchor> list;
  list.reserve(pieces.size());
  std::size_t at = 0;
  for (const NeedlePiece& piece : pieces) {
    const FixedPiece& fixed = support[piece.fixed];
    while (at + 1 < turns.size() && !reached(fixed, turns[at])) ++at;
    const bool change = fixed.kind == FixedPiece::Kind::coil_change;
    Anchor anchor;
    if (!piece.link) {
      anchor = change ? Anchor{.begin = turns[at].at[3].end} : lying(fixed, turns[at].at[fixed.region]);
    } else if (piece.fixed + 1 < support.size() && support[piece.fixed + 1].kind == FixedPiece::Kind::region) {
      const FixedPiece& next = support[piece.fixed + 1];
      const Turn& turn = reached(next, turns[at]) ? turns[at] : turns[std::min(at + 1, turns.size() - 1)];
      anchor = {.begin = turn.at[next.region].held, .free = change};
    } else {
      anchor = {.begin = turns[at].at[3].end};
    }
    list.push_back(anchor);
  }
  return list;
}

FreeWire free_wire(const PoseRates& needle, const Anchor& anchor, double bend_radius, double free_length) {
  Rate ax = anchor.begin.x, ay = anchor.begin.y, az = anchor.begin.z, laid;
  if (anchor.sweep != 0) {
    const Rate angle = lying_angle(needle, anchor, free_length + bend_radius);
    const double sense = anchor.sweep > 0 ? 1 : -1, all = std::abs(anchor.sweep),
                 r0 = std::hypot(anchor.begin.x, anchor.begin.y),
                 slope = std::hypot(r0 + anchor.out / 2, std::hypot(anchor.out, anchor.up) / all);
    const Rate at = Rate(azimuth(anchor.begin)) + sense * angle, radius = Rate(r0) + anchor.out / all * angle;
    ax = radius * cos(at), ay = radius * sin(at), az = az + anchor.up / all * angle;
    laid = slope * angle;
  }
  const Rate wx = ax - needle.x, wy = ay - needle.y, wz = az - needle.z;
  const Rate level = cos(needle.psi),
             along = level * (wx * cos(needle.phi) + wy * sin(needle.phi)) - wz * sin(needle.psi);
  const Rate square = wx * wx + wy * wy + wz * wz, rest = square - along * along + Rate(straight * straight);
  // Rounding may make the square of the component across the axis negative.
  const Rate across = rest.value() > 0 ? sqrt(rest) : Rate(straight);
  Rate run = square - 2 * bend_radius * across;
  if (!(run.value() > shortest * shortest)) run = Rate(shortest * shortest);
  const Rate length = sqrt(run);
  FreeWire wire;
  wire.bend = atan2(across - Rate(bend_radius), along) + atan2(Rate(bend_radius), length);
  wire.length = length + bend_radius * wire.bend + laid;
  return wire;
}

}  // namespace bahnwerk::winding
