// The motion words of a line: where it goes and how.
#include <cmath>
#include <limits>

#include "core/contour/gcode/interpreter.hpp"

namespace bahnwerk::gcode {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr double largest = 1e9;  // mm
constexpr int max_turns = 1000;  // of one helix

}  // namespace

/// A vector of lengths in the program's units; `x` and `y` name its letters in X and Y.
Vec Interpreter::offset(const Line& line, char x, char y) const {
  return {line.has(x) ? line[x] * unit_ : 0, line.has(y) ? line[y] * unit_ : 0, 0};
}

std::optional<Vec> Interpreter::target(const Line& line) {
  Vec to = mover_.position();
  takes(line, letters("XYZ"));
  for (std::size_t k = 0; k < 3; ++k) {
    const char letter = "XYZ"[k];
    if (!line.has(letter)) continue;
    to[k] = line[letter] * unit_ + (absolute_ ? 0 : to[k]);
    if (!(std::abs(to[k]) <= largest)) {
      fault(std::string("the coordinate ") + letter + " is beyond 1e9 mm");
      return std::nullopt;
    }
  }
  return to;
}

void Interpreter::move(const Line& line) {
  if (moves_machine_) {
    takes(line, letters("XYZ"));
    return;
  }
  const std::uint32_t own = motion_ == Action::rapid || motion_ == Action::line ? letters("XYZ")
                            : motion_ == Action::no_motion                      ? letters("XYZ")
                            : motion_ == Action::cubic                          ? letters("XYZIJPQ")
                            : motion_ == Action::quadratic                      ? letters("XYZIJ")
                                                                                : letters("XYZIJKR");
  if (!line.any(own & ~used_)) return;
  if (motion_ == Action::no_motion) {
    takes(line, own);
    return fault("coordinates without a motion: none of G0 … G3, G5, G5.1 is in force");
  }
  if (away_ != 0) {
    fault("the program went to a point of the machine in line " + std::to_string(away_) +
          " (G28, G30, G53): where this move starts is unknown");
    away_ = 0;
  }
  mover_.use(motion_ != Action::rapid && spindle_ && output_ ? Mode::cut : Mode::position,
             motion_ == Action::rapid ? unlimited : feed_);
  if (motion_ != Action::rapid && !fed_)
    note(key_no_feed, line, "a move other than G0 without F: only the axes limit its speed");
  if (motion_ != Action::cubic) last_handle_.reset();
  // What follows a fault in the line shall only keep track of the place.
  if (motion_ == Action::rapid || motion_ == Action::line || !sound_) return straight(line);
  if (motion_ == Action::arc_cw || motion_ == Action::arc_ccw) return arc(line);
  spline(line);
}

void Interpreter::straight(const Line& line) {
  const auto to = target(line);
  if (!to) return;
  if (!mover_.started() && motion_ == Action::rapid && absolute_ && line.has('X') && line.has('Y'))
    mover_.start(*to);
  else
    mover_.line(*to);
}

void Interpreter::arc(const Line& line) {
  const auto to = target(line);
  if (!to) return;
  ArcMove how{plane_, motion_ == Action::arc_ccw, 1, unit_ == 1 ? 0.01 : 0.0005 * unit_};
  if ((used_ & letters("P")) == 0 && takes(line, letters("P"))) {
    const double turns = line['P'];
    if (!(turns >= 1 && turns <= max_turns && turns == std::floor(turns)))
      fault("the number of turns P must be a whole one from 1 to " + std::to_string(max_turns));
    else
      how.turns = static_cast<std::size_t>(turns);
  }
  const bool centre = takes(line, letters("IJK")), radius = takes(line, letters("R"));
  if (centre && radius) fault("an arc has either a radius R or a centre I, J, K");
  if (!centre && !radius) fault("an arc needs a radius R or a centre I, J, K");
  if (!sound_) return mover_.line(*to);
  if (radius) return mover_.arc(*to, line['R'] * unit_, how);
  arc_about_centre(line, *to, how);
}

void Interpreter::arc_about_centre(const Line& line, Vec to, ArcMove how) {
  const std::size_t normal = plane_ == Plane::xy ? 2 : plane_ == Plane::zx ? 1 : 0;
  Vec centre = mover_.position();
  for (std::size_t k = 0; k < 3; ++k) {
    const char letter = "IJK"[k];
    if (k == normal) {
      if (line.has(letter) && line[letter] != 0 && !absolute_centres_)
        fault(std::string("the centre's ") + letter + " points out of the arc's plane");
    } else if (line.has(letter)) {
      centre[k] = line[letter] * unit_ + (absolute_centres_ ? 0 : centre[k]);
    } else if (absolute_centres_) {
      fault(std::string("an absolute centre (G90.1) needs ") + letter + " too");
    }
  }
  if (!sound_) return mover_.line(to);
  mover_.arc(to, centre, how);
}

void Interpreter::spline(const Line& line) {
  const bool cubic = motion_ == Action::cubic;
  const auto to = target(line);
  takes(line, cubic ? letters("IJPQ") : letters("IJ"));
  if (!to) return;
  const bool i = line.has('I'), j = line.has('J');
  if (plane_ != Plane::xy) fault("splines (G5, G5.1) lie in the plane of G17");
  if (line.has('Z')) fault("splines (G5, G5.1) keep their height: Z is not possible");
  if (cubic && i != j) fault("G5 needs both I and J, or none to go on as the last one ended");
  if (cubic && !i && !last_handle_) fault("the first G5 needs I and J");
  if (cubic && !(line.has('P') && line.has('Q'))) fault("G5 needs P and Q");
  if (!cubic && offset(line, 'I', 'J') == Vec{}) fault("G5.1 needs I or J, other than zero");
  if (!sound_) return mover_.line(*to);

  const Vec from = mover_.position();
  if (!cubic) return mover_.spline(*to, from + offset(line, 'I', 'J'), std::nullopt);
  const Vec begin = i ? offset(line, 'I', 'J') : -*last_handle_, end = offset(line, 'P', 'Q');
  last_handle_ = end;
  mover_.spline(*to, from + begin, *to + end);
}

}  // namespace bahnwerk::gcode
