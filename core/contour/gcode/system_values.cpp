// Values of the control for programs: numbered parameters from #5021 on, and predefined names.
#include <algorithm>
#include <array>

#include "core/contour/gcode/interpreter.hpp"

namespace bahnwerk::gcode {
namespace {

constexpr std::string_view machine_values[] = {"_a",
                                               "_b",
                                               "_c",
                                               "_u",
                                               "_v",
                                               "_w",
                                               "_abs_a",
                                               "_abs_b",
                                               "_abs_c",
                                               "_abs_u",
                                               "_abs_v",
                                               "_abs_w",
                                               "_vmajor",
                                               "_vminor",
                                               "_task",
                                               "_remap_level",
                                               "_feed_hold",
                                               "_adaptive_feed",
                                               "_speed_override",
                                               "_feed_override",
                                               "_current_pocket",
                                               "_selected_pocket"};

}  // namespace

double Interpreter::motion_number() const {
  switch (motion_) {
    case Action::rapid:
      return 0;
    case Action::line:
      return 10;
    case Action::arc_cw:
      return 20;
    case Action::arc_ccw:
      return 30;
    case Action::cubic:
      return 50;
    case Action::quadratic:
      return 51;
    case Action::cycle:
      return 10.0 * cycle_.code;
    default:
      return 800;
  }
}

/// Positions and offsets as RS274NGC (3.2.1) and LinuxCNC number them: offsets in mm, positions and the cutter's
/// diameter in the program's units.
std::optional<double> Interpreter::system_parameter(int number) const {
  const auto of = [&](int first, Vec at) { return at[static_cast<std::size_t>(number - first)]; };
  const auto within = [&](int first) { return number >= first && number < first + 3; };
  if (within(5021)) return of(5021, mover_.position()) / unit_;
  if (within(5161)) return of(5161, g28_.value_or(Vec{}));
  if (within(5181)) return of(5181, g30_.value_or(Vec{}));
  if (number == 5210) return offsets_.shifted() ? 1 : 0;
  if (within(5211)) return of(5211, offsets_.local());
  if (number == 5220) return static_cast<double>(offsets_.active() + 1);
  if (number == 5400) return tool_;
  if (within(5420)) return of(5420, mover_.position() - offsets_.origin()) / unit_;
  if (const auto cutter = options_.cutter_radius.find(tool_); number == 5410 && cutter != options_.cutter_radius.end())
    return 2 * cutter->second / unit_;
  constexpr int first_work = 5221, apart = 20, last_work = 5390, rotation = 9;
  if (number < first_work || number > last_work) return std::nullopt;
  const int index = (number - first_work) / apart, first = first_work + apart * index;
  if (number == first + rotation) return 0;
  return within(first) ? std::optional(of(first, offsets_.work(static_cast<std::size_t>(index)))) : std::nullopt;
}

std::optional<double> Interpreter::predefined(std::string_view name) const {
  const Vec at = mover_.position(), here = (at - offsets_.origin()) / unit_;
  const bool spindle = uses_spindle_ && spindle_;
  const double side = mover_.on() ? (mover_.aside() > 0 ? 410 : 420) : 400;
  const auto offset = static_cast<double>(offsets_.active());
  const std::pair<std::string_view, double> values[] = {
      {"_x", here.x},
      {"_y", here.y},
      {"_z", here.z},
      {"_abs_x", at.x / unit_},
      {"_abs_y", at.y / unit_},
      {"_abs_z", at.z / unit_},
      {"_metric", unit_ == 1},
      {"_imperial", unit_ != 1},
      {"_absolute", absolute_},
      {"_incremental", !absolute_},
      {"_ijk_absolute_mode", absolute_centres_},
      {"_inverse_time", inverse_time_},
      {"_units_per_minute", !inverse_time_},
      {"_units_per_rev", 0},
      {"_feed", fed_ ? feed_ * 60 / (inverse_time_ ? 1 : unit_) : 0},
      {"_rpm", speed_},
      {"_motion_mode", motion_number()},
      {"_plane", plane_ == Plane::xy   ? 170
                 : plane_ == Plane::zx ? 180
                                       : 190},
      {"_ccomp", side},
      {"_coord_system", offset < 6 ? 540 + 10 * offset : 585 + offset},
      {"_tool_offset", tool_length_},
      {"_retract_old_z", cycle_.back_to_start},
      {"_retract_r_plane", !cycle_.back_to_start},
      {"_spindle_on", spindle},
      {"_spindle_cw", spindle && clockwise_},
      {"_spindle_rpm_mode", 1},
      {"_spindle_css_mode", 0},
      {"_lathe_diameter_mode", 0},
      {"_lathe_radius_mode", 1},
      {"_mist", mist_},
      {"_flood", flood_},
      {"_current_tool", current_tool_},
      {"_selected_tool", selected_tool_},
  };
  const auto found = std::find_if(std::begin(values), std::end(values), [&](const auto& v) { return v.first == name; });
  return found == std::end(values) ? std::nullopt : std::optional(found->second);
}

bool Interpreter::of_the_machine(std::string_view name) const {
  return name.substr(0, 5) == "_ini[" || name.substr(0, 5) == "_hal[" ||
         std::find(std::begin(machine_values), std::end(machine_values), name) != std::end(machine_values);
}

}  // namespace bahnwerk::gcode
