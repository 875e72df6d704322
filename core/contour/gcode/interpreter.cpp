#include "core/contour/gcode/interpreter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bahnwerk::gcode {
namespace {

constexpr double inch = 25.4;  // mm

std::string m_name(int m) {
  std::string text(1, 'M');
  return text += std::to_string(m);
}

constexpr const char* printer_text =
    "words of printers (E, M82, M104, G29 …) skipped: only the head's motion is planned";

/// Words of printers' firmware that a machine tool does not know.
bool printer_m(int m) {
  return m == 17 || m == 18 || m == 73 || (m >= 82 && m <= 85) || m == 92 || (m >= 104 && m <= 119) ||
         (m >= 140 && m <= 150) || (m >= 190 && m <= 192) || (m >= 200 && m <= 229) || (m >= 240 && m <= 360) ||
         (m >= 400 && m <= 429) || (m >= 500 && m <= 605) || (m >= 851 && m <= 928);
}

}  // namespace

Interpreter::Interpreter(const GcodeOptions& options, bool flat, Progress& progress)
    : options_(options),
      progress_(progress),
      mover_(flat),
      offsets_(options.work_offsets),
      unit_(options.inch ? inch : 1),
      feed_(options.feed),
      fed_(std::isfinite(options.feed)),
      switch_output_(options.output) {
  mover_.place(offsets_.origin());
}

void Interpreter::fault(const std::string& message) {
  sound_ = false;
  mover_.builder().fault({}, message);
}

bool Interpreter::takes(const Line& line, std::uint32_t mask) {
  used_ |= mask;
  return line.any(mask);
}

bool Interpreter::execute(const Line& line) {
  ContourBuilder& builder = mover_.builder();
  builder.at_line(line.number);
  used_ = 0;
  dwell_.reset();
  sound_ = true;
  setting_.reset();
  request_ = {};
  ends_ = unknown_m_ = starts_cycle_ = false;
  if (line.slash)
    note(key_slash, line, options_.block_delete ? "left out by block delete (/)" : "carried out in spite of its /");
  if (!line.fault.empty()) fault(line.fault);
  if (!line.empty()) {
    g_words(line);
    settings(line);
    feed(line);
    m_words(line);
    dwell(line);
    move(line);
    leftovers(line);
  }
  if (builder.segments() > options_.max_segments) {
    fault("more than " + std::to_string(options_.max_segments) + " segments are not accepted");
    return false;
  }
  return !ends_ && !builder.full();
}

void Interpreter::g_words(const Line& line) {
  std::uint32_t groups = 0;
  for (std::size_t i = 0; i < line.g_count; ++i) {
    const Group group = meaning(line.g[i]).group;
    const std::uint32_t bit = group == Group::none ? 0 : 1U << static_cast<unsigned>(group);
    if ((groups & bit) != 0)
      fault(name(line.g[i]) + " contradicts another G word of the line");
    else
      g_word(line, line.g[i]);
    groups |= bit;
  }
}

void Interpreter::g_word(const Line& line, int tenfold) {
  const Code code = meaning(tenfold);
  switch (code.action) {
    case Action::rapid:
    case Action::line:
    case Action::arc_cw:
    case Action::arc_ccw:
    case Action::cubic:
    case Action::quadratic:
      motion_ = code.action;
      cycle_.start_level.reset();
      break;
    case Action::no_motion:
      if (std::none_of(line.g.begin(), line.g.begin() + static_cast<std::ptrdiff_t>(line.g_count),
                       [](int other) { return meaning(other).group == Group::motion; }))
        motion_ = code.action, cycle_.start_level.reset();
      break;
    case Action::plane_xy:
      use_plane(Plane::xy);
      break;
    case Action::plane_zx:
      use_plane(Plane::zx);
      break;
    case Action::plane_yz:
      use_plane(Plane::yz);
      break;
    case Action::inch:
      unit_ = inch;
      break;
    case Action::millimetre:
      unit_ = 1;
      break;
    case Action::absolute:
    case Action::incremental:
      absolute_ = code.action == Action::absolute;
      break;
    case Action::absolute_centres:
    case Action::incremental_centres:
      absolute_centres_ = code.action == Action::absolute_centres;
      break;
    case Action::cycle:
      if (motion_ != Action::cycle || cycle_.code != tenfold / 10)
        cycle_ = {tenfold / 10, {}, {}, {}, {}, cycle_.back_to_start, cycle_.start_level};
      motion_ = code.action;
      starts_cycle_ = true;
      break;
    case Action::retract_to_start:
    case Action::retract_to_r:
      cycle_.back_to_start = code.action == Action::retract_to_start;
      break;
    case Action::per_minute:
    case Action::inverse_time:
      if (inverse_time_ != (code.action == Action::inverse_time)) fed_ = false;
      inverse_time_ = code.action == Action::inverse_time;
      break;
    case Action::dwell:
      dwell_time(line);
      break;
    case Action::work_offset:
      select_work_offset(line, tenfold);
      break;
    case Action::reset_position:
      change_origin([&] { offsets_.clear_local(tenfold == 922); });
      break;
    case Action::restore_position:
      change_origin([&] { offsets_.restore_local(); });
      break;
    case Action::local_offset:
    case Action::set_position:
    case Action::set_data:
    case Action::reference_point:
    case Action::machine_coordinates:
      if (setting_)
        fault(name(tenfold) + " contradicts " + name(*setting_) + " in the same line");
      else
        setting_ = tenfold;
      break;
    case Action::compensation_off:
      break;
    case Action::compensation_left:
    case Action::compensation_right:
      fault(name(tenfold) + ": " + code.text);
      break;
    case Action::printer:
      printer_word(line);
      break;
    case Action::path_control:
      takes(line, letters("PQ"));
      note(640, line, code.text);
      break;
    case Action::tool_length:
      note(430, line, code.text);
      break;
    case Action::nothing:
      break;
    case Action::refuse:
      fault(name(tenfold) + ": " + code.text);
      break;
  }
}

void Interpreter::use_plane(Plane plane) {
  if (plane != plane_) cycle_.start_level.reset();
  plane_ = plane;
}

/// Its time is P, in other dialects X, U, F or S; then it is no coordinate, feed or speed. Always seconds: the dialects
/// that mean milliseconds write the same words.
void Interpreter::dwell_time(const Line& line) {
  if (dwell_) return fault("two dwells (G4) in one line");
  dwell_ = 0;  // none given: it only stops
  for (const char letter : std::string_view("PXUFS"))
    if (takes(line, letters({&letter, 1}))) {
      dwell_ = line[letter];
      break;
    }
  if (!line.has('P') && line.any(letters("YZ"))) fault("a dwell takes no coordinates: give its time with P");
}

/// Behind the line's switches and before its motion.
void Interpreter::dwell(const Line& line) {
  if (!dwell_) return;
  if (!(*dwell_ >= 0 && *dwell_ <= longest_rest)) return fault("a dwell (G4) lasts between 0 and 86400 s");
  rest_here(*dwell_);
  note(key_dwell, line, "");
}

/// It is part of the cut if the tool is on; where nothing switches the tool, if what moves is no G0.
void Interpreter::rest_here(double seconds) {
  const bool on = spindle_ && output_, moves = motion_ != Action::rapid && motion_ != Action::no_motion;
  dwelt_ += seconds;
  mover_.dwell(on && (moves || uses_spindle_ || uses_output_) ? Mode::cut : Mode::position, seconds);
}

void Interpreter::feed(const Line& line) {
  if (!line.has('F') || (used_ & letters("F")) != 0) return;
  const double value = line['F'];
  if (!(value > 0)) return fault("the feed F must be greater than zero");
  feed_ = value * (inverse_time_ ? 1 : unit_) / 60;
  fed_ = true;
}

void Interpreter::m_words(const Line& line) {
  for (std::size_t i = 0; i < line.m_count; ++i) m_word(line, line.m[i]);
  if (line.has('S') && line['S'] == 0 && (used_ & letters("S")) == 0 && uses_spindle_ && spindle_)
    note(key_zero_power, line, "S0 does not switch the tool off, M5 does");
}

void Interpreter::switched(bool& pair, bool on, bool& used) {
  if (on && !used) mover_.first_switch(), used = true;
  if (used) pair = on;  // a program that only ever switches off has no switch
}

void Interpreter::m_word(const Line& line, int m) {
  const auto with = [&](int other) {
    return std::find(line.m.begin(), line.m.begin() + static_cast<std::ptrdiff_t>(line.m_count), other) !=
           line.m.begin() + static_cast<std::ptrdiff_t>(line.m_count);
  };
  switch (m) {
    case 0:
    case 1:
    case 60:
      return note(key_m, line, "stop (M0, M1) ignored");
    case 2:
    case 30:
      ends_ = true;
      return;
    case 3:
    case 4:
    case 5:
      if (m == 5 && (with(3) || with(4))) return fault("M5 contradicts another M word of the line");
      return switched(spindle_, m != 5, uses_spindle_);
    case 6:
      return note(key_m + 6, line, "tool change (M6) ignored");
    case 7:
    case 8:
    case 9:  // coolant
    case 48:
    case 49:  // overrides
      return;
    case 62:
    case 63:
    case 64:
    case 65: {
      const int output = takes(line, letters("P")) ? static_cast<int>(line['P']) : 0;
      if (!switch_output_) switch_output_ = output;
      if (output != *switch_output_)
        return note(key_output, line, "another output than the tool's switch ignored (M62 … M65)");
      const bool on = m == 62 || m == 64;
      if (!on && (with(62) || with(64))) return fault("an output cannot be switched on and off in one line");
      return switched(output_, on, uses_output_);
    }
    case 97:
      return fault("M97 is not supported: M98 and O words call subprograms");
    case 98:
      return call(line);
    case 99:
      request_.back = true;
      return;
    default:
      if (printer_m(m)) return printer_word(line);
      unknown_m_ = true;
      return note(key_m + m, line, (m_name(m) + " is not known and ignored").c_str());
  }
}

void Interpreter::call(const Line& line) {
  takes(line, letters("PL"));
  constexpr double most = 1e8;
  const double program = line.has('P') ? line['P'] : -1, repeats = line.has('L') ? line['L'] : 1;
  if (!(program >= 0 && program <= most && program == std::floor(program)))
    return fault("M98 needs the number of a subprogram, P");
  if (!(repeats >= 0 && repeats <= most && repeats == std::floor(repeats)))
    return fault("M98: how often, L, must be a whole number");
  request_.program = static_cast<int>(program);
  request_.repeats = static_cast<std::size_t>(repeats);
}

/// Its other letters are its own: M201 X500 moves nothing.
void Interpreter::printer_word(const Line& line) {
  takes(line, ~0U);
  note(key_printer, line, printer_text);
}

/// Words that the line's motion has no use for are mistakes, but whatever an unknown M word may want.
void Interpreter::leftovers(const Line& line) {
  if (!sound_) return;
  if (line.has('E')) note(key_printer, line, printer_text);
  if (line.has('O') && mover_.started()) return fault("another program begins before this one ends (M2, M30)");
  for (const char letter : std::string_view("ABCUVW"))
    if (line.has(letter) && (used_ & letters({&letter, 1})) == 0)
      return fault(std::string("the ") + (letter < 'D' ? "rotary" : "second linear") + " axis " + letter +
                   " is not supported: only X, Y and Z are");
  if (unknown_m_) return;
  for (const char letter : std::string_view("XYZIJKRPQL"))
    if (line.has(letter) && (used_ & letters({&letter, 1})) == 0)
      return fault(std::string("the letter ") + letter + " has no meaning here");
}

void Interpreter::refuse(const Line& line, const std::string& why) {
  mover_.builder().at_line(line.number);
  fault(why);
}

void Interpreter::end(const Line& line) {
  note(key_endless, line, "M99 would begin the program anew, without end: read once");
  ends_ = true;
}

void Interpreter::unset_parameters(const Parameters::Unset& unset) {
  if (unset.count == 0) return;
  const std::string text = "the parameter #" + std::to_string(unset.number) + " was read before it was set: taken as 0";
  notes_.add(key_unset, unset.line, text.c_str(), unset.count);
}

void Interpreter::rest(const Line& line) { note(key_rest, line, "what follows the end of the program is not read"); }

Contour Interpreter::finish() {
  Contour contour = mover_.finish();
  char dwelt[120];
  std::snprintf(dwelt, sizeof dwelt, "dwell (G4), %.6g s in all: its time was taken as seconds", dwelt_);
  notes_.complete(key_dwell, dwelt);
  for (std::string& text : notes_.texts()) contour.notes.push_back(std::move(text));
  return contour;
}

}  // namespace bahnwerk::gcode
