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

}  // namespace

Interpreter::Interpreter(const GcodeOptions& options, bool flat)
    : options_(options),
      mover_(flat),
      unit_(options.inch ? inch : 1),
      feed_(options.feed),
      fed_(std::isfinite(options.feed)),
      switch_output_(options.output) {}

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
  ends_ = moves_machine_ = unknown_m_ = false;
  if (line.slash)
    note(key_slash, line, options_.block_delete ? "left out by block delete (/)" : "carried out in spite of its /");
  if (!line.fault.empty()) fault(line.fault);
  if (!line.empty()) {
    g_words(line);
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
      break;
    case Action::no_motion:
      if (std::none_of(line.g.begin(), line.g.begin() + static_cast<std::ptrdiff_t>(line.g_count),
                       [](int other) { return meaning(other).group == Group::motion; }))
        motion_ = code.action;
      break;
    case Action::plane_xy:
      plane_ = Plane::xy;
      break;
    case Action::plane_zx:
      plane_ = Plane::zx;
      break;
    case Action::plane_yz:
      plane_ = Plane::yz;
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
    case Action::dwell:
      dwell_time(line);
      break;
    case Action::machine_point:
      moves_machine_ = true;
      if (mover_.started() && away_ == 0) away_ = line.number;
      note(280, line, code.text);
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

/// Behind the line's switches and before its motion. It is part of the cut if the tool is on; where nothing switches
/// the tool, if what moves is no G0.
void Interpreter::dwell(const Line& line) {
  if (!dwell_) return;
  const bool on = spindle_ && output_, moves = motion_ != Action::rapid && motion_ != Action::no_motion;
  const bool cuts = on && (moves || first_spindle_ || first_output_);
  if (!(*dwell_ >= 0 && *dwell_ <= longest_rest)) return fault("a dwell (G4) lasts between 0 and 86400 s");
  dwelt_ += *dwell_;
  mover_.dwell(cuts ? Mode::cut : Mode::position, *dwell_);
  note(key_dwell, line, "");
}

void Interpreter::feed(const Line& line) {
  if (!line.has('F') || (used_ & letters("F")) != 0) return;
  const double value = line['F'];
  if (!(value > 0)) return fault("the feed F must be greater than zero");
  feed_ = value * unit_ / 60;
  fed_ = true;
}

void Interpreter::m_words(const Line& line) {
  for (std::size_t i = 0; i < line.m_count; ++i) m_word(line, line.m[i]);
  if (line.has('S') && line['S'] == 0 && (used_ & letters("S")) == 0 && first_spindle_ && spindle_)
    note(key_zero_power, line, "S0 does not switch the tool off, M5 does");
}

void Interpreter::switched(bool& pair, bool on, std::optional<std::size_t>& first) {
  if (on && !first) first = mover_.split();
  if (first) pair = on;  // a program that only ever switches off has no switch
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
      return switched(spindle_, m != 5, first_spindle_);
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
      return switched(output_, on, first_output_);
    }
    case 97:
    case 98:
    case 99:
      return fault(m_name(m) + ": subprograms are not supported");
    default:
      unknown_m_ = true;
      return note(key_m + m, line, (m_name(m) + " is not known and ignored").c_str());
  }
}

/// Words that the line's motion has no use for are mistakes, but whatever an unknown M word may want.
void Interpreter::leftovers(const Line& line) {
  if (!sound_) return;
  if (line.has('O') && mover_.started()) return fault("another program begins before this one ends (M2, M30)");
  for (const char letter : std::string_view("ABCUVW"))
    if (line.has(letter) && (used_ & letters({&letter, 1})) == 0)
      return fault(std::string("the axis ") + letter + " is not supported: only X, Y and Z are");
  if (unknown_m_) return;
  for (const char letter : std::string_view("XYZIJKRPQLE"))
    if (line.has(letter) && (used_ & letters({&letter, 1})) == 0)
      return fault(std::string("the letter ") + letter + " has no meaning here");
}

void Interpreter::rest(const Line& line) { note(key_rest, line, "what follows the end of the program is not read"); }

Contour Interpreter::finish() {
  Contour contour = mover_.finish(std::max(first_spindle_.value_or(0), first_output_.value_or(0)));
  char dwelt[120];
  std::snprintf(dwelt, sizeof dwelt, "dwell (G4), %.6g s in all: its time was taken as seconds", dwelt_);
  notes_.complete(key_dwell, dwelt);
  for (std::string& text : notes_.texts()) contour.notes.push_back(std::move(text));
  return contour;
}

}  // namespace bahnwerk::gcode
