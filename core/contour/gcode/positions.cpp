// The program's zero (G54 … G59.3, G10, G52, G92), points of the machine (G28, G30, G53), and the side of the contour
// on which the cutter moves (G40, G41, G42).
#include <cmath>

#include "core/contour/gcode/interpreter.hpp"

namespace bahnwerk::gcode {
namespace {

constexpr std::uint32_t axes = letters("XYZ");
constexpr char axis_letters[] = "XYZ";

std::uint32_t bit(std::size_t axis) { return letters({axis_letters + axis, 1}); }

std::uint32_t axes_of(const Line& line) {
  std::uint32_t list = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (line.has(axis_letters[k])) list |= bit(k);
  return list;
}

constexpr const char* left_out =
    "move to a point of the machine (G28, G30, G53) left out, the document does not say where that is; between other "
    "moves the head stops and goes on from where it stood";
constexpr const char* before =
    "move to a point of the machine (G28, G30, G53) left out: where the head stands before the first move is not known";

}  // namespace

/// The coordinates of the line where they are given, `otherwise` elsewhere.
Vec Interpreter::named(const Line& line, Vec otherwise, Vec origin) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (line.has(axis_letters[k])) otherwise[k] = line[axis_letters[k]] * unit_ + origin[k];
  return otherwise;
}

void Interpreter::select_work_offset(const Line& line, int tenfold) {
  const std::size_t index = work_offset_index(tenfold);
  change_origin([&] { offsets_.select(index); });
  if (!offsets_.known(index) && (index != 0 || options_.gives_offsets()))
    note(tenfold, line, ("the work offset " + name(tenfold) + " is not in the document: taken as zero").c_str());
}

/// Executes words that take the coordinates of the line for something other than its motion.
void Interpreter::settings(const Line& line) {
  if (!setting_) return;
  switch (meaning(*setting_).action) {
    case Action::local_offset:
      takes(line, axes);
      return change_origin([&] { offsets_.set_local(named(line, offsets_.local(), {})); });
    case Action::set_position:
      return set_position(line);
    case Action::set_data:
      return set_data(line);
    default:
      return;  // a motion: carried out in its turn
  }
}

/// Executes G92: the head stands at these coordinates.
void Interpreter::set_position(const Line& line) {
  if (!takes(line, axes)) {
    if (!line.any(letters("EABCUVW"))) fault("G92 needs the coordinates of where the head stands");
    return;  // the line names an extruder alone
  }
  const Vec at = mover_.position();
  if (mover_.started()) {
    const Vec free = at - offsets_.work(offsets_.active());
    Vec local = offsets_.local();
    for (std::size_t k = 0; k < 3; ++k)
      if (line.has(axis_letters[k])) local[k] = free[k] - line[axis_letters[k]] * unit_;
    return offsets_.set_local(local);
  }
  stand_at(line, offsets_.origin());
}

/// Nothing has moved yet: the contour begins here.
void Interpreter::stand_at(const Line& line, Vec origin) {
  const Vec place = named(line, mover_.position(), origin);
  if (!in_range(place)) return;
  if (line.has('X') && line.has('Y'))
    mover_.start(place);
  else
    mover_.place(place);
}

/// G10 L2: a work offset; L20: the one with which the head stands at these coordinates.
void Interpreter::set_data(const Line& line) {
  if (!takes(line, letters("L"))) {
    if (line.any(letters("PRXYZ")) && !line.has('S'))
      return fault("G10 without L: only L2 and L20, work offsets, are supported");
    return printer_word(line);  // their G10 retracts the filament
  }
  takes(line, axes | letters("P"));
  const double form = line['L'], number = line.has('P') ? line['P'] : 0;
  if (form != 2 && form != 20) return fault("G10: only L2 and L20, work offsets, are supported");
  if (takes(line, letters("R")) && line['R'] != 0) return fault("G10: the coordinates cannot be rotated (R)");
  if (!(number >= 0 && number <= work_offsets && number == std::floor(number)))
    return fault("G10: P names a work offset, 1 (G54) to 9 (G59.3), or 0 for the one in force");
  const std::size_t index = number == 0 ? offsets_.active() : static_cast<std::size_t>(number) - 1;
  Vec work = offsets_.work(index);
  const Vec free = mover_.position() - offsets_.local();
  // The head's position counts here before the first move, not the zero.
  if (form == 20 && !mover_.started()) return stand_at(line, work + offsets_.local());
  for (std::size_t k = 0; k < 3; ++k)
    if (line.has(axis_letters[k]))
      work[k] = form == 2 ? line[axis_letters[k]] * unit_ : free[k] - line[axis_letters[k]] * unit_;
  change_origin([&] { offsets_.set_work(index, work); });
}

/// Executes G28 and G30: by way of the given coordinates, for the axes that have one or for all.
void Interpreter::reference_point(const Line& line, const std::optional<Vec>& point) {
  const bool some = takes(line, axes);
  const std::uint32_t list = some ? axes_of(line) : axes;
  if (line.bare) {
    note(key_printer, line, "words of printers (E, M82, M104, G29 …) skipped: only the head's motion is planned");
    takes(line, ~0U);
  }
  if (!point || !mover_.started()) return leave(line, list, point.has_value());
  if (some && !line.bare)
    if (const auto way = target(line)) rapid_to(*way);
  Vec to = mover_.position();
  for (std::size_t k = 0; k < 3; ++k)
    if ((list & bit(k)) != 0) to[k] = (*point)[k];
  rapid_to(to);
}

/// Executes G53: a straight move in the coordinates of the machine.
void Interpreter::machine_coordinates(const Line& line) {
  if (!takes(line, axes)) return;
  const std::uint32_t list = axes_of(line);
  const bool known = offsets_.known(offsets_.active());
  if (!known || !mover_.started()) return leave(line, list, known);
  if (motion_ != Action::rapid && motion_ != Action::line) return fault("G53 needs G0 or G1");
  if (!absolute_) return fault("G53 needs absolute coordinates (G90)");
  const Vec to = named(line, mover_.position(), {});
  if (!in_range(to)) return;
  moved_ |= list;
  if (motion_ == Action::rapid) return rapid_to(to);
  if (feeds(line, norm(to - mover_.position()))) mover_.line(to);
}

/// Records the axes of a head that moves to an unknown point. Axes that never moved are where the contour assumes them.
void Interpreter::leave(const Line& line, std::uint32_t list, bool given) {
  note(given ? key_before : key_reference, line, given ? before : left_out);
  if (!mover_.started()) return;
  if (away_ == 0) back_ = mover_.position();
  if ((list & moved_) != 0) away_line_ = line.number;
  away_ |= list & moved_;
}

/// A line that begins with $: GRBL's controllers set and do something beside the program.
void Interpreter::controller_line(const Line& line) {
  constexpr std::size_t longest = 24;
  std::string shown;
  for (const char c : line.controller.substr(0, longest)) {
    if (c <= ' ' || c > '~' || c == ';') break;
    shown += c;
  }
  if (shown.size() > 1 && (shown[1] == 'J' || shown[1] == 'j'))
    return fault("a jog ($J) moves the head beside the program: program it as a move");
  note(key_controller, line, (shown + ": a command of the controller, left out").c_str());
  if (shown.size() > 1 && (shown[1] == 'H' || shown[1] == 'h') && mover_.started()) leave(line, axes, false);
}

/// While axes are away their places are collected; when all are known again the head moves there: up, across, down, the
/// last part as the line says.
void Interpreter::come_back(const Line& line) {
  takes(line, axes);
  const std::string since =
      ": it went to a point of the machine in line " + std::to_string(away_line_) + " (G28, G30, G53)";
  for (std::size_t k = 0; k < 3; ++k) {
    if (!line.has(axis_letters[k])) continue;
    const double by = line[axis_letters[k]] * unit_;
    if (!absolute_ && (away_ & bit(k)) != 0) {
      fault(std::string("where the axis ") + axis_letters[k] + " starts is unknown" + since);
      away_ = 0;
      return;
    }
    back_[k] = by + (absolute_ ? offsets_.origin()[k] : back_[k]);
    away_ &= ~bit(k);
  }
  if (!in_range(back_)) return;
  if (motion_ != Action::rapid && (away_ != 0 || motion_ != Action::line)) {
    const char letter = (away_ & letters("X")) != 0 ? 'X' : (away_ & letters("Y")) != 0 ? 'Y' : 'Z';
    fault(away_ != 0 ? std::string("where the axis ") + letter + " stands is unknown" + since
                     : "a straight move has to bring the head back" + since);
    away_ = 0;
    return mover_.line(back_);
  }
  if (away_ != 0) return;
  const Vec from = mover_.position(), to = back_;
  mover_.dwell(Mode::position, 0);
  rapid_to(to.z > from.z ? Vec{from.x, from.y, to.z} : Vec{to.x, to.y, from.z});
  if (motion_ == Action::rapid)
    rapid_to(to);
  else if (feeds(line, norm(to - mover_.position())))
    mover_.line(to);
}

/// Returns the radius by the D number, or by that of the tool; G41.1 and G42.1 have the diameter itself.
std::optional<double> Interpreter::cutter_radius(const Line& line, bool by_diameter) {
  const bool given = takes(line, letters("D"));
  if (by_diameter) {
    if (!given) fault("G41.1 and G42.1 need the cutter's diameter D");
    return given ? std::optional(line['D'] * unit_ / 2) : std::nullopt;
  }
  const double number = given ? line['D'] : tool_;
  if (!(number >= 0 && number <= 999'999 && number == std::floor(number))) {
    fault("D is the number of a cutter, a whole one from 0 to 999999");
    return std::nullopt;
  }
  const auto at = options_.cutter_radius.find(static_cast<int>(number));
  if (at != options_.cutter_radius.end()) return at->second;
  if (given && number == 0) return 0;
  fault(given ? "the document gives no cutter_radius for D" + std::to_string(static_cast<int>(number))
              : "G41 and G42 need the number D of a cutter, or a tool T whose cutter_radius the document gives (T" +
                    std::to_string(tool_) + ")");
  return std::nullopt;
}

void Interpreter::compensate(const Line& line) {
  if (line.has('T') && line['T'] >= 0 && line['T'] <= 999'999) tool_ = static_cast<int>(line['T']);
  if (!compensation_) return;
  const Action action = meaning(*compensation_).action;
  if (action == Action::compensation_off) return mover_.end();
  const auto radius = cutter_radius(line, *compensation_ % 10 != 0);
  if (!radius) return;
  const double aside = action == Action::compensation_left ? *radius : -*radius;
  if (mover_.on()) {
    if (aside != mover_.aside()) fault("cutter radius compensation is on: to change it, switch it off (G40) before");
    return;
  }
  if (plane_ != Plane::xy) return fault("cutter radius compensation lies in the plane of G17");
  if (away_ != 0)
    return fault("where cutter radius compensation begins is unknown after a move to a point of the machine");
  if (std::abs(aside) > 0) mover_.begin(aside);
}

}  // namespace bahnwerk::gcode
