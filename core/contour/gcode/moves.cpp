// The motion words of a line: target and type of the motion.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/contour/gcode/interpreter.hpp"

namespace bahnwerk::gcode {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr double largest = 1e9;  // mm
constexpr int max_turns = 1000;  // largest number of turns of one helix

}  // namespace

/// A vector of lengths in the program's units; `x` and `y` name its letters in X and Y.
Vec Interpreter::offset(const Line& line, char x, char y) const {
  return {line.has(x) ? line[x] * unit_ : 0, line.has(y) ? line[y] * unit_ : 0, 0};
}

bool Interpreter::in_range(Vec at) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::abs(at[k]) <= largest) continue;
    fault(std::string("the coordinate ") + "XYZ"[k] + " is beyond 1e9 mm");
    return false;
  }
  return true;
}

std::optional<Vec> Interpreter::target(const Line& line) {
  Vec to = mover_.position();
  const Vec origin = offsets_.origin();
  takes(line, letters("XYZ"));
  for (std::size_t k = 0; k < 3; ++k) {
    const char letter = "XYZ"[k];
    if (!line.has(letter)) continue;
    to[k] = line[letter] * unit_ + (absolute_ ? origin[k] : to[k]);
    moved_ |= letters({&letter, 1});
  }
  return in_range(to) ? std::optional(to) : std::nullopt;
}

void Interpreter::move(const Line& line) {
  if (setting_) {
    const Action action = meaning(*setting_).action;
    if (action == Action::machine_coordinates) machine_coordinates(line);
    if (action == Action::reference_point) reference_point(line, *setting_ == 280 ? g28_ : g30_);
    return;
  }
  const std::uint32_t own = motion_ == Action::cubic                                  ? letters("XYZIJPQ")
                            : motion_ == Action::quadratic                            ? letters("XYZIJ")
                            : motion_ == Action::arc_cw || motion_ == Action::arc_ccw ? letters("XYZIJKR")
                                                                                      : letters("XYZ");
  if (!line.any(own & ~used_)) {
    if (motion_ == Action::cycle && starts_cycle_) fault("a canned cycle needs X, Y or Z");
    return;
  }
  if (motion_ == Action::no_motion) {
    takes(line, own);
    if (!sound_) return;
    return fault("coordinates without a motion: none of G0 … G3, G5, G5.1 is in force");
  }
  if (initial_)
    note(key_initial, line,
         motion_ == Action::rapid
             ? "coordinates before any motion word: taken as G0, as GRBL begins (initial_motion of the document)"
             : "coordinates before any motion word: taken as G1 (initial_motion of the document)");
  if (away_ != 0) return come_back(line);
  if (motion_ != Action::cubic) last_handle_.reset();
  // After a fault in the line only the place is tracked.
  if (motion_ == Action::rapid || motion_ == Action::line || !sound_) return straight(line);
  if (motion_ == Action::cycle) return cycle(line);
  if (motion_ == Action::arc_cw || motion_ == Action::arc_ccw) return arc(line);
  spline(line);
}

/// Sets mode and feed of a move that is no G0, of so many mm; returns false if it has none.
bool Interpreter::feeds(const Line& line, double length) {
  if (!fed_ && inverse_time_) {
    fault("a move in inverse time (G93) needs its own F");
    return false;
  }
  if (!fed_ && feed_lost_) {
    fault("no feed after G94: F of inverse time (G93) holds no longer, program F per minute");
    return false;
  }
  if (!fed_) note(key_no_feed, line, "a move other than G0 without F: only the axes limit its speed");
  double feed = feed_;
  if (inverse_time_) {
    feed = length > 0 ? length * feed_ : unlimited;
    fed_ = false;  // the feed holds for this move only
  }
  mover_.use(spindle_ && output_ ? Mode::cut : Mode::position, feed);
  return true;
}

void Interpreter::rapid_to(Vec to) {
  mover_.use(Mode::position, unlimited);
  mover_.line(to);
}

void Interpreter::straight(const Line& line) {
  const auto to = target(line);
  if (!to) return;
  if (motion_ == Action::rapid) {
    mover_.use(Mode::position, unlimited);
    if (!mover_.started() && absolute_ && line.has('X') && line.has('Y')) return mover_.start(*to);
  } else if (sound_ && !feeds(line, norm(*to - mover_.position()))) {
    return;
  }
  mover_.line(*to, line.any(letters("XY")));
}

void Interpreter::arc(const Line& line) {
  const auto to = target(line);
  if (!to) return;
  ArcMove how{plane_, motion_ == Action::arc_ccw, 1, rounding()};
  if ((used_ & letters("P")) == 0 && takes(line, letters("P"))) {
    const double turns = line['P'];
    if (!(turns >= 1 && turns <= max_turns && turns == std::floor(turns)))
      fault("the number of turns P must be a whole one from 1 to " + std::to_string(max_turns));
    else
      how.turns = static_cast<std::size_t>(turns);
  }
  const bool by_centre = takes(line, letters("IJK")), by_radius = takes(line, letters("R"));
  if (by_centre && by_radius) fault("an arc has either a radius R or a centre I, J, K");
  if (!by_centre && !by_radius) fault("an arc needs a radius R or a centre I, J, K");
  if (!sound_) return mover_.line(*to);
  const char* why = nullptr;
  const auto about = by_radius ? centre_by_radius(mover_.position(), *to, line['R'] * unit_, how, why)
                               : centre(line, absolute_centres_);
  if (why != nullptr) fault(why);
  if (about && by_centre && !agrees(line, *to, *about, how)) return mover_.line(*to);
  const double length = inverse_time_ && about ? arc_length(mover_.position(), *to, *about, how) : 0;
  if (about && feeds(line, length)) return mover_.arc(*to, *about, how);
  mover_.line(*to);
}

/// Returns the allowed difference of radii of any size, mm: coordinates truncated after their fourth decimal.
double Interpreter::rounding() const { return unit_ == 1 ? 0.01 : 0.0005 * unit_; }

/// Returns whether the radii at both ends agree, as LinuxCNC demands: to 0.1 % of the radius, 0.5 mm or 0.05 in at
/// most. `how` gets the tolerance.
bool Interpreter::agrees(const Line& line, Vec to, Vec about, ArcMove& how) {
  constexpr double relative = 1e-3, wildly = 0.2;
  const double most = unit_ == 1 ? 0.5 : 0.05 * unit_;
  const RadiiOfArc radii = radii_of_arc(mover_.position(), to, about, how.plane);
  const double greater = std::max(radii.begin, radii.end), apart = std::abs(radii.begin - radii.end);
  how.tolerance = std::max(rounding(), std::min(most, relative * greater));
  if (apart <= how.tolerance) return true;
  std::string what = "the arc's radii at start and end differ by more than the tolerance";
  if (apart > wildly * greater || agrees_otherwise(line, to))
    what += absolute_centres_ ? ": is its centre relative to the start (G91.1, or arc_centers of the document)?"
                              : ": is its centre absolute (G90.1, or arc_centers \"absolute\" of the document)?";
  fault(what);
  return false;
}

/// Returns whether the radii would agree if the centre were absolute instead of relative, or relative instead of
/// absolute.
bool Interpreter::agrees_otherwise(const Line& line, Vec to) const {
  const std::size_t normal = plane_ == Plane::xy ? 2 : plane_ == Plane::zx ? 1 : 0;
  const Vec from = mover_.position(), zero = absolute_centres_ ? from : offsets_.origin();
  Vec about = from;
  for (std::size_t k = 0; k < 3; ++k) {
    if (k == normal) continue;
    if (!line.has("IJK"[k])) return false;
    about[k] = zero[k] + line["IJK"[k]] * unit_;
  }
  const RadiiOfArc radii = radii_of_arc(from, to, about, plane_);
  return std::abs(radii.begin - radii.end) <= std::max(rounding(), 1e-3 * radii.begin);
}

std::optional<Vec> Interpreter::centre(const Line& line, bool absolute) {
  const std::size_t normal = plane_ == Plane::xy ? 2 : plane_ == Plane::zx ? 1 : 0;
  const Vec origin = offsets_.origin();
  Vec centre = mover_.position();
  for (std::size_t k = 0; k < 3; ++k) {
    const char letter = "IJK"[k];
    if (k == normal) {
      if (line.has(letter) && line[letter] != 0 && !absolute)
        fault(std::string("the centre's ") + letter + " points out of the arc's plane");
    } else if (line.has(letter)) {
      centre[k] = line[letter] * unit_ + (absolute ? origin[k] : centre[k]);
    } else if (absolute) {
      fault(std::string("an absolute centre (G90.1) needs ") + letter + " too");
    }
  }
  return sound_ ? std::optional(centre) : std::nullopt;
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
  if (inverse_time_) fault("splines (G5, G5.1) have no inverse time feed (G93): program F per minute, with G94");
  if (!sound_ || !feeds(line, 0)) return mover_.line(*to);

  const Vec from = mover_.position();
  if (!cubic) return mover_.spline(*to, from + offset(line, 'I', 'J'), std::nullopt);
  const Vec begin = i ? offset(line, 'I', 'J') : -*last_handle_, end = offset(line, 'P', 'Q');
  last_handle_ = end;
  mover_.spline(*to, from + begin, *to + end);
}

}  // namespace bahnwerk::gcode
