// The G words of a line: modes at once, motions when their turn comes.
#include <algorithm>

#include "core/contour/gcode/interpreter.hpp"

namespace bahnwerk::gcode {
namespace {

constexpr double inch = 25.4;  // mm

/// Returns whether the word is incompatible with cutter radius compensation, which is one move late.
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

/// G70 and G71 as older controls have them, where the document says so.
int Interpreter::translated(int tenfold) const {
  if (!options_.g70_g71_units || (tenfold != 700 && tenfold != 710)) return tenfold;
  return tenfold == 700 ? 200 : 210;
}

/// G5 P, G5.1 Q and G8 P of Fanuc's controls: how far they look ahead.
bool Interpreter::look_ahead(const Line& line, int tenfold) {
  const bool is = tenfold == 50   ? line.has('P') && !line.any(letters("XYZIJQ"))
                  : tenfold == 51 ? line.has('Q') && !line.any(letters("IJ"))
                                  : tenfold == 80 && line.has('P');
  if (!is) return false;
  if (tenfold == 51)
    for (const char axis : std::string_view("XYZABC"))
      if (line.has(axis) && line[axis] == 0) takes(line, letters({&axis, 1}));
  takes(line, letters("PQR"));
  note(key_look_ahead, line,
       "look-ahead of a control (G5 P, G5.1 Q, G8 P) ignored: the planning of the job looks ahead anyway");
  return true;
}

void Interpreter::g_words(const Line& line) {
  std::uint32_t groups = 0;
  for (std::size_t i = 0; i < line.g_count; ++i) {
    const int code = translated(line.g[i]);
    if (look_ahead(line, code)) continue;
    const Group group = meaning(code).group;
    const std::uint32_t bit = group == Group::none ? 0 : 1U << static_cast<unsigned>(group);
    if ((groups & bit) != 0)
      fault(name(line.g[i]) + " contradicts another G word of the line");
    else if (mover_.on() && unfit_for_compensation(code))
      fault(name(line.g[i]) + " while cutter radius compensation is on: switch it off (G40) before");
    else
      g_word(line, code);
    groups |= bit;
    if (group == Group::motion) initial_ = false;
  }
}

/// Words of scaling and mirroring, which are never active, are ignored. Lathes have other words G50.
void Interpreter::cancel(const Line& line, int tenfold) {
  if (tenfold == 501) return void(takes(line, letters("XYZIJK")));  // the axes that are no longer mirrored
  const auto last = line.g.begin() + static_cast<std::ptrdiff_t>(line.g_count);
  if (line.any(letters("XYZUW")) && std::none_of(line.g.begin(), last, takes_words))
    fault("G50 with coordinates, as lathes set their zero, is not supported: use G92");
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
        cycle_ = {tenfold / 10, {}, {}, {}, {}, {}, cycle_.back_to_start, cycle_.start_level};
      motion_ = code.action;
      starts_cycle_ = true;
      break;
    case Action::retract_to_start:
    case Action::retract_to_r:
      cycle_.back_to_start = code.action == Action::retract_to_start;
      break;
    case Action::per_minute:
    case Action::inverse_time:
      if (inverse_time_ == (code.action == Action::inverse_time)) break;
      inverse_time_ = !inverse_time_;
      fed_ = false;
      feed_lost_ = !inverse_time_;
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
      takes(line, letters("PQE"));
      note(640, line, code.text);
      break;
    case Action::tool_length:
      takes(line, letters("H"));
      tool_length_ = true;
      if (tenfold == 431) takes(line, letters("XYZIJK"));  // G43.1 has the lengths themselves
      note(430, line, code.text);
      break;
    case Action::store_reference:
      if (mover_.started())
        (tenfold == 281 ? g28_ : g30_) = mover_.position();
      else
        fault(name(tenfold) + ": where the head stands is unknown before the first move");
      break;
    case Action::cancel:
      cancel(line, tenfold);
      break;
    case Action::nothing:
      if (tenfold == 490) takes(line, letters("H")), tool_length_ = false;
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

}  // namespace bahnwerk::gcode
