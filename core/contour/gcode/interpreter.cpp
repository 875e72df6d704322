#include "core/contour/gcode/interpreter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bahnwerk::gcode {
namespace {

constexpr double inch = 25.4;  // mm

}  // namespace

Interpreter::Interpreter(const GcodeOptions& options, bool flat, Progress progress)
    : options_(options),
      progress_(progress),
      mover_(flat),
      offsets_(options.work_offsets),
      unit_(options.inch ? inch : 1),
      absolute_centres_(options.absolute_centres),
      feed_(options.feed),
      fed_(std::isfinite(options.feed)),
      switch_output_(options.output),
      g28_(options.g28),
      g30_(options.g30) {
  motion_ = options.initial_motion == GcodeMotion::rapid ? Action::rapid : Action::line;
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
  if (!line.controller.empty()) controller_line(line);
  if (!line.empty()) {
    mode_words(line);
    g_words(line);
    settings(line);
    compensate(line);
    feed(line);
    m_words(line);
    dwell(line);
    move(line);
    tool_words(line);
    leftovers(line);
    if (inverse_time_) fed_ = false;  // F holds for its own line
  }
  if (builder.segments() > options_.max_segments) {
    fault("more than " + std::to_string(options_.max_segments) + " segments are not accepted");
    return false;
  }
  return !ends_ && !builder.full();
}

void Interpreter::feed(const Line& line) {
  if (!line.has('F') || (used_ & letters("F")) != 0) return;
  const double value = line['F'];
  if (!(value > 0)) return fault("the feed F must be greater than zero");
  feed_ = value * (inverse_time_ ? 1 : unit_) / 60;
  fed_ = true;
  feed_lost_ = false;
}

/// Speeds, and numbers of tool offsets that no word of the line uses: without G41 or G43 these have no effect.
void Interpreter::tool_words(const Line& line) {
  if (line.has('S') && (used_ & letters("S")) == 0) speed_ = line['S'];
  if (line.has('H') && (used_ & letters("H")) == 0) {
    const auto any = [&](auto holds) {
      return std::any_of(line.g.begin(), line.g.begin() + static_cast<std::ptrdiff_t>(line.g_count), holds);
    };
    if (any([](int g) { return g == 150; }))
      return fault(
          "G15 H, a work offset of Okuma's controls, is not supported: use G54 to G59.3, with offsets of the document");
    if (any([](int g) { return meaning(g).action == Action::work_offset; }))
      return fault("H beside a work offset, a tool's length as Okuma's controls have it, is not supported: use G43 H");
  }
  if (!line.has('D') || (used_ & letters("D")) != 0) return;
  const auto cutter = options_.cutter_radius.find(static_cast<int>(line['D']));
  const bool same = cutter != options_.cutter_radius.end() && std::abs(cutter->second) == std::abs(mover_.aside());
  if (mover_.on() && !same)
    return fault("D while cutter radius compensation is on: to change it, switch it off (G40) before");
  if (line['D'] < 0 || line['D'] != std::floor(line['D']))
    fault("D is the number of a cutter, a whole one, and stands beside G41 or G42");
}

/// Words that the line's motion has no use for are mistakes, but whatever an unknown M word may want.
void Interpreter::leftovers(const Line& line) {
  if (!sound_) return;
  if (line.has('E') && (used_ & letters("E")) == 0) printer_word(line, letters("E"));
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
  note(key_endless, line, "M99 would repeat the program without end: it is read once");
  ends_ = true;
}

void Interpreter::end_before_subprogram(const Line& line) {
  note(key_main_end, line, "the main program ends before its subprogram, without M30");
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
