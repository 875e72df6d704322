#include "core/contour/gcode/interpreter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bahnwerk::gcode {
namespace {

constexpr double inch = 25.4;  // mm

/// What cutter radius compensation, which is one move late, cannot go along with.
bool unfit_for_compensation(int tenfold) {
  switch (meaning(tenfold).action) {
    case Action::plane_zx:
    case Action::plane_yz:
    case Action::cycle:
    case Action::cubic:
    case Action::quadratic:
    case Action::work_offset:
    case Action::local_offset:
    case Action::set_position:
    case Action::reset_position:
    case Action::restore_position:
    case Action::set_data:
    case Action::reference_point:
    case Action::machine_coordinates:
      return true;
    default:
      return false;
  }
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
  compensation_.reset();
  ends_ = unknown_m_ = starts_cycle_ = false;
  if (line.slash)
    note(key_slash, line, options_.block_delete ? "left out by block delete (/)" : "carried out in spite of its /");
  if (!line.fault.empty()) fault(line.fault);
  if (!line.empty()) {
    g_words(line);
    settings(line);
    compensate(line);
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
    else if (mover_.on() && unfit_for_compensation(line.g[i]))
      fault(name(line.g[i]) + " while cutter radius compensation is on: switch it off (G40) before");
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
    case Action::compensation_left:
    case Action::compensation_right:
      compensation_ = tenfold;
      break;
    case Action::printer:
      printer_word(line);
      break;
    case Action::path_control:
      takes(line, letters("PQ"));
      note(640, line, code.text);
      break;
    case Action::tool_length:
      if (tenfold == 431) takes(line, letters("XYZIJK"));  // G43.1 has the lengths themselves
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

void Interpreter::feed(const Line& line) {
  if (!line.has('F') || (used_ & letters("F")) != 0) return;
  const double value = line['F'];
  if (!(value > 0)) return fault("the feed F must be greater than zero");
  feed_ = value * (inverse_time_ ? 1 : unit_) / 60;
  fed_ = true;
}

/// Words that the line's motion has no use for are mistakes, but whatever an unknown M word may want.
void Interpreter::leftovers(const Line& line) {
  if (!sound_) return;
  if (line.has('E')) printer_word(line, letters("E"));
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

void Interpreter::close(const Parameters::Unset& unset) {
  mover_.end();
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
