// Words of a line other than its motion: M words, dwells, words of printers.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/contour/gcode/interpreter.hpp"

namespace bahnwerk::gcode {
namespace {

constexpr const char* printer_text =
    "words of printers (E, M82, M104, G29 …) skipped: only the head's motion is planned";

}  // namespace

/// The dwell's time is P, in other dialects X, U, F or S, which is then no coordinate, feed or speed. It is always in
/// seconds: the dialects that mean milliseconds use these words, too.
void Interpreter::dwell_time(const Line& line) {
  if (dwell_) return fault("two dwells (G4) in one line");
  dwell_ = 0;  // no time is given: the motion only stops
  for (const char letter : std::string_view("PXUFS"))
    if (takes(line, letters({&letter, 1}))) {
      dwell_ = line[letter];
      break;
    }
  if (!line.has('P') && line.any(letters("YZ"))) fault("a dwell takes no coordinates: give its time with P");
}

/// Dwells after the line's switches and before its motion.
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
      clockwise_ = m == 3 || (m == 5 && clockwise_);
      return switched(spindle_, m != 5, uses_spindle_);
    case 6:
      return tool_change(line);
    case 7:
    case 8:
    case 9:
      mist_ = m == 7 || (m == 8 && mist_);
      flood_ = m == 8 || (m == 7 && flood_);
      return;
    case 19:
      takes(line, letters("RPQ"));
      return note(key_m + 19, line, "orientation of the spindle (M19) ignored");
    case 48:
    case 49:
      return;
    case 50:
    case 51:
    case 52:
    case 53:
      takes(line, letters("P"));
      return note(key_m + 50, line,
                  "overrides, adaptive feed, feed stop (M50 … M53) ignored: F is taken as it is written");
    case 61:
      if (takes(line, letters("Q")) && line['Q'] >= 0 && line['Q'] <= 999'999)
        tool_ = current_tool_ = static_cast<int>(line['Q']);
      return note(key_m + 6, line, "tool change (M6, M61) ignored");
    case 66:
      takes(line, letters("PELQ"));
      return note(key_m + 66, line, "wait for an input (M66) ignored");
    case 67:
    case 68:
      takes(line, letters("EQ"));
      return note(key_m + 67, line, "analog output (M67, M68) ignored: it does not switch the tool");
    case 70:
    case 71:
    case 72:
      return;  // mode_words() has read the word
    case 73:
      return line.any(letters("PQRS")) ? printer_word(line, letters("PQRST")) : void();
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
      return foreign_m(line, m);
  }
}

/// The words of this code are its own (Lines), whatever they are.
void Interpreter::foreign_m(const Line& line, int m) {
  unknown_m_ = true;
  if (printer_m(whole_m(m))) {
    const char* effect = printer_effect(whole_m(m));
    if (effect == nullptr) return note(key_printer, line, printer_text);
    return note(key_m + whole_m(m), line, (m_name(whole_m(m)) + " " + effect).c_str());
  }
  const bool words = line.foreign != 0 || line.text;
  const int key = key_m + (m < 0 ? 100'000 - m : m);
  note(key, line, (m_name(m) + " is not known and ignored" + (words ? ", what follows it too" : "")).c_str());
}

/// The machine decides where the head changes its tool; an active motion does not take coordinates there.
void Interpreter::tool_change(const Line& line) {
  current_tool_ = tool_;
  const auto last = line.g.begin() + static_cast<std::ptrdiff_t>(line.g_count);
  if ((line.behind_m6 & letters("XYZIJKR")) != 0 && std::none_of(line.g.begin(), last, takes_words))
    return fault("coordinates behind a tool change (M6): program the move in a line of its own, or with its G word");
  note(key_m + 6, line, "tool change (M6) ignored");
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

/// The other letters of this code are its own: M201 X500 moves nothing.
void Interpreter::printer_word(const Line& line, std::uint32_t words) {
  takes(line, words);
  note(key_printer, line, printer_text);
}

}  // namespace bahnwerk::gcode
