// Save and restore of the modes: M70 … M73.
#include "core/contour/gcode/interpreter.hpp"

namespace bahnwerk::gcode {

Modes Interpreter::modes() const {
  Modes now;
  now.unit = unit_;
  now.plane = plane_;
  now.absolute = absolute_;
  now.absolute_centres = absolute_centres_;
  now.feed = feed_;
  now.fed = fed_;
  now.feed_lost = feed_lost_;
  now.inverse_time = inverse_time_;
  now.work_offset = offsets_.active();
  now.back_to_start = cycle_.back_to_start;
  now.spindle = uses_spindle_ && spindle_;
  now.aside = mover_.on() ? mover_.aside() : 0;
  now.speed = speed_;
  return now;
}

void Interpreter::restore(const Modes& modes) {
  const bool shifts = modes.work_offset != offsets_.active();
  if (mover_.on() && modes.aside == 0) mover_.end();
  const double aside = mover_.on() ? mover_.aside() : 0;
  if (aside != modes.aside)
    return fault("the modes to restore (M72, M73) have another cutter radius compensation: program G41 or G42");
  if (mover_.on() && (shifts || modes.plane != plane_))
    return fault(
        "the modes to restore (M72, M73) have another plane or work offset while cutter radius compensation is on: "
        "switch it off (G40) before");
  unit_ = modes.unit;
  use_plane(modes.plane);
  absolute_ = modes.absolute;
  absolute_centres_ = modes.absolute_centres;
  if (modes.fed || modes.inverse_time != inverse_time_) {  // a program without feed has none to restore
    feed_ = modes.feed;
    fed_ = modes.fed;
    feed_lost_ = modes.feed_lost || (inverse_time_ && !modes.fed);
    inverse_time_ = modes.inverse_time;
  }
  if (shifts) change_origin([&] { offsets_.select(modes.work_offset); });
  cycle_.back_to_start = modes.back_to_start;
  switched(spindle_, modes.spindle, uses_spindle_);
  speed_ = modes.speed;
}

/// Takes the words that come before anything else of the line.
void Interpreter::mode_words(const Line& line) {
  for (std::size_t i = 0; i < line.m_count; ++i) {
    const int m = line.m[i];
    if (m == 73 && line.any(letters("PQRS"))) continue;  // a printer's progress
    if (m == 70 || m == 73) saved_.save(modes(), m == 73);
    if (m == 71) saved_.forget();
    if (m != 72) continue;
    if (saved_.saved())
      restore(*saved_.saved());
    else
      fault("M72 restores what M70 has saved in the same program or subprogram: nothing was");
  }
}

void Interpreter::enter_subprogram() { saved_.enter(); }

void Interpreter::leave_subprogram(const Line& line) {
  mover_.builder().at_line(line.number);
  if (const auto modes = saved_.leave()) restore(*modes);
}

}  // namespace bahnwerk::gcode
