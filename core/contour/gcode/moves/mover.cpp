#include "core/contour/gcode/moves/mover.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bahnwerk::gcode {
namespace {

Vec normal(Plane plane) { return plane == Plane::xy ? Vec{0, 0, 1} : plane == Plane::zx ? Vec{0, 1, 0} : Vec{1, 0, 0}; }

/// Angle from one end of an arc to the other, rad, in (0, 2π].
double swept(Vec from, Vec to, Vec centre, Vec n, bool counter_clockwise) {
  const Vec a = from - centre, b = to - centre;
  double angle = std::atan2(dot(cross(a, b), n), dot(a - dot(a, n) * n, b - dot(b, n) * n));
  if (!counter_clockwise) angle = -angle;
  return angle > 0 ? angle : angle + 2 * std::numbers::pi;
}

}  // namespace

std::optional<Vec> centre_by_radius(Vec from, Vec to, double radius, const ArcMove& how, const char*& why) {
  const Vec n = normal(how.plane);
  const Vec way = to - from, chord = way - dot(way, n) * n;
  const double half = 0.5 * norm(chord), size = std::abs(radius);
  why = !(half > 0)                   ? "R cannot tell a full circle: its centre has to be given with I, J, K"
        : !(size > 0)                 ? "the radius R is zero"
        : half - size > how.tolerance ? "the radius R is too small: the end is further away than 2 R"
                                      : nullptr;
  if (why != nullptr) return std::nullopt;
  // The centre of a counter-clockwise arc of less than half a turn lies to the left of the chord.
  const double height = size > half ? std::sqrt((size - half) * (size + half)) : 0;
  const bool left = how.counter_clockwise == (radius > 0);
  const Vec aside = cross(n, chord) / (2 * half);
  return from + 0.5 * chord + (left ? height : -height) * aside;
}

RadiiOfArc radii_of_arc(Vec from, Vec to, Vec centre, Plane plane) {
  const Vec n = normal(plane), a = from - centre, b = to - centre;
  return {norm(a - dot(a, n) * n), norm(b - dot(b, n) * n)};
}

std::optional<ArcHalves> halves_of_arc(Vec from, Vec to, Vec centre, const ArcMove& how) {
  constexpr double least = 1e-9;  // mm, of a difference of the radii
  const Vec n = normal(how.plane);
  const auto flat = [&](Vec v) { return v - dot(v, n) * n; };
  const RadiiOfArc radii = radii_of_arc(from, to, centre, how.plane);
  const double apart = radii.begin - radii.end, chord = norm(flat(to - from));
  const double angle = swept(from, to, centre, n, how.counter_clockwise);
  if (!(angle > std::numbers::pi) || !(chord > least) || !(radii.end > least) || !(std::abs(apart) > least)) return {};
  // A single arc moves its centre by (r₁² − r₂²)/(2 chord).
  if (!(radii.begin + radii.end > 2 * chord)) return {};
  // Centres on the radii of the ends, c = d/(2 (1 + |cos θ/2|)) inwards and outwards; then both circles touch at θ/2.
  const double shift = apart / (2 * (1 + std::abs(std::cos(angle / 2))));
  const Vec out = flat(from - centre) / radii.begin, last = flat(to - centre) / radii.end;
  const double half = how.counter_clockwise ? angle / 2 : -angle / 2;
  const Vec middle = std::cos(half) * out + std::sin(half) * cross(n, out);
  ArcHalves halves;
  halves.first = centre + shift * out;
  halves.second = centre - shift * last;
  halves.middle = flat(halves.first) + (radii.begin - shift) * middle + 0.5 * (dot(from, n) + dot(to, n)) * n;
  return halves;
}

double arc_length(Vec from, Vec to, Vec centre, const ArcMove& how) {
  const Vec n = normal(how.plane), spoke = from - centre;
  const double rise = dot(to - from, n), radius = norm(spoke - dot(spoke, n) * n);
  const bool full = to - from - rise * n == Vec{};
  const double last = full ? 2 * std::numbers::pi : swept(from, to, centre, n, how.counter_clockwise);
  return std::hypot(radius * (last + static_cast<double>(how.turns - 1) * 2 * std::numbers::pi), rise);
}

void Mover::use(Mode mode, double feed) {
  if (mode == mode_ && feed == feed_) return;
  mode_ = mode;
  feed_ = feed;
  new_block_ = true;
}

void Mover::first_switch() {
  new_block_ = true;
  positioning_ = builder_.blocks();
}

void Mover::begin_block() {
  if (new_block_) builder_.block(mode_, feed_);
  new_block_ = false;
}

void Mover::go(Vec to) {
  if (to.z != at_.z) climbs_ = true;
  at_ = to;
  started_ = true;
}

void Mover::place(Vec at) {
  at_ = at;
  builder_.start(placed(at));
}

void Mover::start(Vec at) {
  place(at);
  started_ = true;
}

void Mover::line(Vec to) {
  const bool still = to == at_;  // programs repeat places: that is no move
  go(to);
  if (still) return;
  begin_block();
  builder_.line(placed(to));
}

void Mover::arc(Vec to, Vec centre, ArcMove how) {
  const Vec n = normal(how.plane), from = at_;
  const double rise = dot(to - from, n);
  const bool full = to - from - rise * n == Vec{};
  const std::size_t circles = full ? how.turns : how.turns - 1;
  go(to);
  if (how.plane != Plane::xy) climbs_ = true;
  begin_block();

  constexpr double turn = 2 * std::numbers::pi;
  const double last = full ? 0 : swept(from, to, centre, n, how.counter_clockwise);
  const double pitch = circles > 0 ? rise * (turn / (static_cast<double>(circles) * turn + last)) : 0;
  for (std::size_t i = 0; i < circles; ++i) {
    // The last circle goes back to where the contour really stands, a rounding beside the program: a circle has to
    // close.
    const bool exact = full && i + 1 == circles;
    const double climb = exact ? dot(placed(to) - builder_.position(), n) : pitch;
    builder_.arc(builder_.position() + climb * n, placed(centre), how.counter_clockwise, n, how.tolerance);
  }
  if (full) return;
  if (const auto halves = halves_of_arc(builder_.position(), placed(to), placed(centre), how)) {
    builder_.arc(halves->middle, halves->first, how.counter_clockwise, n, how.tolerance);
    builder_.arc(placed(to), halves->second, how.counter_clockwise, n, how.tolerance);
  } else {
    builder_.arc(placed(to), placed(centre), how.counter_clockwise, n, how.tolerance);
  }
}

void Mover::spline(Vec to, Vec first, std::optional<Vec> second) {
  const Vec a = builder_.position(), b = placed(first), end = placed(to);
  go(to);
  begin_block();
  std::vector<std::vector<double>> rows;
  for (std::size_t k = 0; k < (a.z == 0 ? 2U : 3U); ++k) {
    // Differences of the control points, so that large coordinates cost no digits.
    const double d1 = b[k] - a[k];
    if (second) {
      const double d2 = (*second)[k] - b[k], d3 = end[k] - (*second)[k];
      rows.push_back(k == 2 ? std::vector{a.z} : std::vector{a[k], 3 * d1, 3 * (d2 - d1), d3 - 2 * d2 + d1});
    } else {
      rows.push_back(k == 2 ? std::vector{a.z} : std::vector{a[k], 2 * d1, (end[k] - b[k]) - d1});
    }
  }
  builder_.polynomial(rows);
}

void Mover::dwell(Mode mode, double seconds) {
  use(mode, feed_);
  begin_block();
  builder_.dwell(seconds);
}

/// Neighbours of one mode and feed become one block, and dwells alone join a neighbour of their mode. Blocks of nothing
/// go.
void Mover::join_blocks(Contour& contour) {
  std::vector<std::size_t> dwells(contour.blocks.size(), 0), owner(contour.blocks.size(), 0);
  for (const Rest& rest : contour.rests) ++dwells[rest.block];
  std::vector<Block> kept;
  bool still = false;  // whether the last block has dwells only
  for (std::size_t i = 0; i < contour.blocks.size(); ++i) {
    const Block& block = contour.blocks[i];
    const bool moves = block.first < block.last;
    if (moves || dwells[i] > 0) {
      if (!kept.empty() && kept.back().mode == block.mode && (still || !moves || kept.back().feed == block.feed)) {
        if (moves) kept.back().feed = block.feed;
        kept.back().last = block.last;
        still = still && !moves;
      } else {
        kept.push_back(block);
        still = !moves;
      }
    }
    owner[i] = kept.empty() ? 0 : kept.size() - 1;
  }
  for (Rest& rest : contour.rests) rest.block = owner[rest.block];
  contour.blocks = std::move(kept);
}

Contour Mover::finish() {
  Contour contour = builder_.finish();
  contour.dimension = climbs_ ? 3 : 2;
  for (std::size_t i = 0; i < std::min(positioning_, contour.blocks.size()); ++i)
    contour.blocks[i].mode = Mode::position;
  join_blocks(contour);
  return contour;
}

}  // namespace bahnwerk::gcode
