#include "core/contour/gcode/moves/compensation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/errors.hpp"
#include "core/geometry/curve/arc.hpp"

namespace bahnwerk::gcode {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double tangent = 1e-4;   // rad: a corner this flat is none
constexpr double shortest = 2e-6;  // mm: what is shorter is no arc

Vec flat(Vec v) { return {v.x, v.y, 0}; }
bool same_place(Vec a, Vec b) { return a.x == b.x && a.y == b.y; }

}  // namespace

void Compensation::begin(double aside) {
  programmed_ = position();
  last_.reset();
  first_.reset();
  aside_ = aside;
  state_ = State::leads_in;
  lead_.reset();
}

void Compensation::end() {
  if (!on()) return;
  const bool led = last_.has_value();
  if (lead_ && !led) drive(flat(*lead_), lead_->z, lead_manner_);
  flush();
  state_ = led ? State::leads_out : State::off;
}

void Compensation::fault(std::size_t line, const char* message) {
  ContourBuilder& builder = mover_.builder();
  const std::size_t now = builder.line();
  builder.at_line(line);
  builder.fault({}, message);
  builder.at_line(now);
}

void Compensation::first_switch() {
  if (off()) return mover_.first_switch();
  happens({Event::Kind::first_switch, manner(), 0});
}

void Compensation::dwell(Mode mode, double seconds) {
  if (off()) return mover_.dwell(mode, seconds);
  Manner how = manner();
  how.mode = mode;
  happens({Event::Kind::dwell, how, seconds});
}

/// Stores an event until the pending move is written; without one it happens at once.
void Compensation::happens(const Event& event) {
  events_.push_back(event);
  if (state_ == State::leads_out || (!last_ && !lead_)) happen();
}

void Compensation::offset(Vec to, bool across) {
  const Vec from = std::exchange(programmed_, to);
  const bool returns = state_ == State::leads_out && across;  // the cutter is beside the place where it should be
  if (same_place(from, to) && !returns) {
    if (from.z != to.z) happens({Event::Kind::height, manner(), to.z});
    return;
  }
  if (state_ == State::leads_out) return lead_out(to);
  if (!last_ && !lead_) {
    lead_ = to;
    lead_manner_ = manner();
    return;
  }
  add({offset_line(from, to, aside_), manner(), to.z, 0});
}

void Compensation::offset(Vec to, Vec centre, ArcMove how) {
  if (const auto halves = halves_of_arc(programmed_, to, centre, how)) {
    offset(halves->middle, halves->first, how);
    how.turns = 1;
    return offset(to, halves->second, how);
  }
  const Vec from = std::exchange(programmed_, to);
  const Manner here = manner();
  if (state_ == State::leads_out) {
    fault(here.line, "the first move behind G40 must be straight: it leads out");
    return lead_out(to);
  }
  try {
    // The arc is that of the program without compensation, rounding of the centre included.
    const Arc arc = Arc::through(flat(from), flat(to), flat(centre), {0, 0, 1}, how.counter_clockwise, how.tolerance);
    const double sense = how.counter_clockwise ? 1 : -1;
    const double sweep = std::abs(arc.sweep()) + turn * static_cast<double>(how.turns - 1);
    if (!last_ && !lead_) return lead_in(to, sense * left_of(flat(to) - arc.centre()), sense);
    const auto piece = offset_arc({from, to, arc.centre(), sense, sweep}, aside_, slack);
    if (piece) return add({*piece, here, to.z, how.tolerance});
    fault(here.line, "the arc is narrower than the cutter (G41, G42): it would be gouged");
  } catch (const InvalidInput& e) {
    fault(here.line, e.what());
  }
  if (same_place(from, to)) return;
  if (last_ || lead_) return add({offset_line(from, to, aside_), here, to.z, 0});
  lead_ = to;  // the arc has no length
  lead_manner_ = here;
}

void Compensation::spline(Vec to, Vec first, std::optional<Vec> second) {
  if (off()) return mover_.spline(to, first, second);
  fault(mover_.builder().line(), "the first move behind G40 must be straight: it leads out");
  offset(to, true);
}

/// Writes the pending move, since the next one is known; that one is then pending.
void Compensation::add(Move move) {
  const std::size_t now = mover_.builder().line();
  if (!last_)
    lead_in(move);
  else
    corner(move);
  if (!first_) first_ = move.piece;
  last_ = move;
  mover_.builder().at_line(now);
}

/// An arc that leads in ends beside the end that the program names, in one direction with it (LinuxCNC).
void Compensation::lead_in(Vec to, Vec along, double sense) {
  const Manner here = manner();
  OffsetPiece piece;
  piece.direction_to = along / norm(along);
  piece.corner_to = flat(to);
  piece.to = piece.corner_to + aside_ * left_of(piece.direction_to);
  piece.from = piece.corner_from = flat(mover_.position());
  const Vec chord = piece.from - piece.to, aside = sense * left_of(piece.direction_to);
  const double reach = 2 * dot(chord, aside);
  if (!(reach > 0) || !(norm(chord) > slack)) {
    fault(here.line,
          "the arc that leads in (G41, G42) cannot end beside its end: its radius is too small for the cutter");
    lead_ = to, lead_manner_ = here;
    return;
  }
  piece.arc = true;
  piece.sense = sense;
  piece.radius = dot(chord, chord) / reach;
  piece.centre = piece.to + piece.radius * aside;
  const Vec spoke = piece.from - piece.centre, end = piece.to - piece.centre;
  const double angle = sense * turn_of(spoke, end);
  piece.sweep = angle > 0 ? angle : angle + turn;
  piece.length = piece.radius * piece.sweep;
  piece.direction_from = sense * left_of(spoke) / piece.radius;
  state_ = State::on;
  happen();
  last_ = Move{piece, here, to.z, 0};
}

/// Leads in to beside the beginning of the first move.
void Compensation::lead_in(const Move& next) {
  const Vec from = flat(mover_.position()), at = next.piece.corner_from, beside = next.piece.from;
  const double side = aside_ > 0 ? 1 : -1, radius = std::abs(aside_), way = norm(from - at);
  const Vec out = side * left_of(next.piece.direction_from);
  state_ = State::on;
  // Above the work the cutter moves straight.
  const bool above = std::any_of(events_.begin(), events_.end(), [&](const Event& event) {
    return event.kind == Event::Kind::height && event.value < lead_->z;
  });
  if (!above && dot(from - at, out) < radius - slack) {
    // The straight line would touch the beginning: the path is along the tangent, then round it.
    const Vec heading = way >= radius ? turned((at - from) / way, side * std::asin(radius / way)) : Vec{};
    if (way < radius) {
      fault(lead_manner_.line, "the move behind G41 or G42 leads in: it must be longer than the cutter's radius");
    } else if (side * turn_of(heading, next.piece.direction_from) > tangent) {
      fault(lead_manner_.line,
            "the move that leads in (G41, G42) comes from the wrong side: the contour would be gouged");
    } else {
      drive(at + aside_ * left_of(heading), lead_->z, lead_manner_);
      round(at, beside, lead_manner_);
    }
  }
  drive(beside, lead_->z, lead_manner_);
  lead_.reset();
  happen();
}

void Compensation::lead_out(Vec to) {
  state_ = State::off;
  const Manner here = manner_;
  const Vec at = last_->piece.corner_to;
  const double side = aside_ > 0 ? 1 : -1, radius = std::abs(aside_), way = norm(flat(to) - at);
  const Vec out = side * left_of(last_->piece.direction_to);
  const std::size_t line = mover_.builder().line();
  const Manner how{here.mode, here.feed, line};
  const bool above = mover_.position().z > last_->z;
  if (!above && dot(flat(to) - at, out) < radius - slack) {
    const Vec heading = way >= radius ? turned((flat(to) - at) / way, -side * std::asin(radius / way)) : Vec{};
    if (way < radius)
      fault(line, "the move behind G40 leads out: it must be longer than the cutter's radius");
    else if (side * turn_of(last_->piece.direction_to, heading) > tangent)
      fault(line, "the move that leads out (G40) goes to the wrong side: the contour would be gouged");
    else
      round(at, at + aside_ * left_of(heading), how);
  }
  last_.reset();
  drive(flat(to), to.z, how);
}

/// Joins the pending move and the next one.
void Compensation::corner(Move& next) {
  Move& last = *last_;
  OffsetPiece &a = last.piece, &b = next.piece;
  const double angle = turn_of(a.direction_to, b.direction_from);
  const bool inside = angle * aside_ > 0 && std::abs(angle) < std::numbers::pi - tangent;
  if (std::abs(angle) < tangent) {
    // Both ends are where the bisector says.
    const Vec n = left_of(a.direction_to), m = left_of(b.direction_from);
    Vec at = a.corner_to + (aside_ / (1 + dot(n, m))) * (n + m);
    if (a.arc && a.radius == 0) at = a.to;
    if (b.arc && b.radius == 0) at = b.from;
    a.trim_end(dot(a.to - at, a.direction_to), at);
    b.trim_begin(dot(at - b.from, b.direction_from), at);
  } else if (inside) {
    if (const auto cut = meeting(a, b, slack)) {
      a.trim_end(cut->before, cut->at);
      b.trim_begin(cut->behind, cut->at);
    } else {
      fault(next.manner.line, "the cutter does not fit into the inside corner before this move (G41, G42): gouged");
    }
  }
  drive(last);
  happen();
  if (!inside && std::abs(angle) >= tangent) round(a.corner_to, b.from, next.manner);
}

/// Adds the move round an outside corner of the contour.
void Compensation::round(Vec corner, Vec to, const Manner& manner) {
  const Vec from = flat(mover_.position());
  const double z = mover_.position().z;
  if (norm(to - from) < shortest) return;
  mover_.use(manner.mode, manner.feed);
  mover_.builder().at_line(manner.line);
  mover_.arc({to.x, to.y, z}, {corner.x, corner.y, z}, {Plane::xy, aside_ < 0, 1, 0.01});
}

void Compensation::drive(Vec to, double z, const Manner& manner) {
  const Vec at = mover_.position();
  if (norm(to - flat(at)) < shortest && z == at.z) return;
  mover_.use(manner.mode, manner.feed);
  mover_.builder().at_line(manner.line);
  mover_.line({to.x, to.y, z});
}

void Compensation::drive(const Move& move) {
  const OffsetPiece& piece = move.piece;
  if (!piece.arc || piece.length < shortest) return drive(piece.to, move.z, move.manner);
  const double turns = piece.sweep / turn, whole = std::round(turns);
  const bool circles = whole > 0 && std::abs(turns - whole) * turn * piece.radius < shortest;
  const Vec at = mover_.position(), to = circles ? flat(at) : piece.to;
  const auto count = static_cast<std::size_t>(circles ? whole : std::floor(turns) + 1);
  mover_.use(move.manner.mode, move.manner.feed);
  mover_.builder().at_line(move.manner.line);
  mover_.arc({to.x, to.y, move.z}, {piece.centre.x, piece.centre.y, at.z},
             {Plane::xy, piece.sense > 0, count, std::max(move.tolerance, 0.01)});
}

void Compensation::happen() {
  const std::size_t now = mover_.builder().line();
  for (const Event& event : events_) {
    const Vec at = mover_.position();
    mover_.builder().at_line(event.manner.line);
    if (event.kind == Event::Kind::first_switch) {
      mover_.first_switch();
    } else if (event.kind == Event::Kind::dwell) {
      mover_.dwell(event.manner.mode, event.value);
    } else {
      mover_.use(event.manner.mode, event.manner.feed);
      mover_.line({at.x, at.y, event.value});
    }
  }
  events_.clear();
  mover_.builder().at_line(now);
}

/// Writes the last move, which no further one trims.
void Compensation::flush() {
  const std::size_t now = mover_.builder().line();
  if (last_) {
    const OffsetPiece& end = last_->piece;
    const OffsetPiece& begin = first_ ? *first_ : end;
    const double angle = turn_of(end.direction_to, begin.direction_from);
    if (norm(end.corner_to - begin.corner_from) < slack && angle * aside_ > 0 && std::abs(angle) > tangent &&
        std::abs(angle) < std::numbers::pi - tangent && norm(begin.from - end.to) > slack)
      fault(last_->manner.line,
            "the compensated contour (G41, G42) begins and ends in an inside corner, which would be "
            "gouged: begin it on a side");
    drive(*last_);
  }
  happen();
  mover_.builder().at_line(now);
}

Contour Compensation::finish() {
  end();
  return mover_.finish();
}

}  // namespace bahnwerk::gcode
