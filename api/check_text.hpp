#pragma once
/// Names and units of checks as people read them. The header does not depend on JSON, so that tests of core can use it.
#include <array>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/verification.hpp"

namespace bahnwerk::api {

namespace text {

inline const char* derivative(int order) {
  constexpr std::array names{"position", "velocity", "acceleration", "jerk", "snap"};
  return names.at(static_cast<std::size_t>(order));
}

inline std::string feed_name(double feed) {
  char text[64];
  std::snprintf(text, sizeof text, "path velocity (feed %.10g)", feed);
  return text;
}

/// Returns the name of a check without its subject.
inline std::string general_name(const Checked& what, double limit) {
  const std::string of = derivative(what.order);
  using enum CheckedQuantity;
  switch (what.quantity) {
    case named:
      return {};
    case axis:
      return what.order == 0 ? "range" : of;
    case path:
      return "path " + of;
    case feed:
      return feed_name(limit);
    case joint_step:
      return of + " step at joints";
    case corner_rest:
      return "corner rest";
    case cusp_rest:
      return "cusp rest";
    case start_rest:
      return "start at rest";
    case end_rest:
      return "end at rest";
    case continuity:
      return "continuity of " + of;
    case time_continuity:
      return "continuity of time";
    case duration:
      return "duration";
    case bound:
      return "bound";
    case segments:
      return "pieces within segments";
    case forward:
      return "forward motion";
    case coverage:
      return "path covered";
    case path_distance:
      return "distance from contour";
    case arc_length:
      return "arc length";
    case block_order:
      return "blocks out of order";
    case deviation:
      return "deviation from contour";
    case dwell:
      return "dwell";
    case stroke:
      return "stroke";
    case centred_start:
      return "centred at start";
    case centred_end:
      return "centred at end";
    case chord_error:
      return "chord error";
    case half_speed_feed:
      return "half-speed feed";
    case tip_position:
      return "forward kinematics " + of;
    case tip_angle:
      return "forward kinematics angle";
    case clearance:
      return "needle clearance";
    case pull:
      return "wire pull";
    case slack:
      return "wire slack";
    case wire_overlap:
      return "overlap beyond what is allowed";
    case boundary_overlap:
      return "overlap with the boundary";
    case wires_missing:
      return "wires missing";
    case rows_count:
      return "setpoints count";
    case rows_time:
      return "setpoints time";
    case rows_path:
      return "setpoints path";
    case rows_speed:
      return "setpoints speed";
    case rows_forward:
      return "setpoints forward";
    case rows:
      return "setpoints " + of;
    case rows_end:
      return "setpoints end";
    case rows_end_rest:
      return "setpoints end at rest";
    case rows_labels:
      return "setpoints mode and block";
    case rows_sum:
      return std::string("setpoints sum") +
             std::array{"", " of velocities", " of accelerations"}.at(static_cast<std::size_t>(what.order));
    case rows_stroke:
      return "setpoints stroke";
    case rows_fine:
      return "setpoints fine " + of;
    case rows_pose:
      return "setpoints pose";
    case axis_differences:
      return "setpoint " + of;
    case path_differences:
      return "setpoint path " + of;
  }
  return {};
}

/// Tells whether each of several subjects (axes, layouts) has a check of this kind; otherwise a subject denotes a group
/// of axes.
inline bool one_of_several(CheckedQuantity quantity) {
  using enum CheckedQuantity;
  switch (quantity) {
    case axis:
    case stroke:
    case centred_start:
    case centred_end:
    case wire_overlap:
    case boundary_overlap:
    case wires_missing:
    case axis_differences:
      return true;
    default:
      return false;
  }
}

}  // namespace text

/// Returns the name of a check, such as "velocity x" or "path velocity (feed 400)"; `limit` is part of some names. The
/// subject follows the name if each axis or layout has such a check, and precedes it if it denotes a group of axes.
inline std::string check_name(const Checked& what, double limit) {
  const std::string name = text::general_name(what, limit);
  if (name.empty() || what.subject.empty()) return name + what.subject;
  return text::one_of_several(what.quantity) ? name + ' ' + what.subject : what.subject + ' ' + name;
}

inline std::string check_name(const Check& check) { return check_name(check, check.limit); }

namespace text {

/// Returns the group of a check that one kind alone has, by the words that its name begins with.
inline const char* group_of_named(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, const char*>, 8> groups{{{"continuity", "continuity"},
                                                                            {"table", "setpoints"},
                                                                            {"setpoints", "setpoints"},
                                                                            {"bound", "bound"},
                                                                            {"objective", "bound"},
                                                                            {"cam", "geometry"},
                                                                            {"deviation", "geometry"},
                                                                            {"points", "geometry"}}};
  for (const auto& [words, group] : groups)
    if (name.starts_with(words)) return group;
  return "limit";
}

}  // namespace text

/// Returns what a check is about: `limit` (a limit of the document is held), `geometry` (the path, the layout),
/// `continuity` (of the motion, with its rests), `setpoints` (the rows are those of the motion) or `bound`.
inline const char* check_group(const Checked& what) {
  using enum CheckedQuantity;
  switch (what.quantity) {
    case named:
      return text::group_of_named(what.subject);
    case axis:
    case path:
    case feed:
    case dwell:
    case stroke:
    case chord_error:
    case half_speed_feed:
    case pull:
    case slack:
      return "limit";
    case joint_step:
    case corner_rest:
    case cusp_rest:
    case start_rest:
    case end_rest:
    case continuity:
    case time_continuity:
    case duration:
    case forward:
    case centred_start:
    case centred_end:
      return "continuity";
    case segments:
    case coverage:
    case path_distance:
    case arc_length:
    case block_order:
    case deviation:
    case tip_position:
    case tip_angle:
    case clearance:
    case wire_overlap:
    case boundary_overlap:
    case wires_missing:
      return "geometry";
    case bound:
      return "bound";
    case rows_count:
    case rows_time:
    case rows_path:
    case rows_speed:
    case rows_forward:
    case rows:
    case rows_end:
    case rows_end_rest:
    case rows_labels:
    case rows_sum:
    case rows_stroke:
    case rows_fine:
    case rows_pose:
    case axis_differences:
    case path_differences:
      return "setpoints";
  }
  return "limit";
}

/// Returns the unit of a check, such as "mm/s²": the unit of order 0 divided by a power of the independent variable's.
inline std::string check_unit(const Checked& what) {
  constexpr std::array per{"", "/s", "/s²", "/s³", "/s⁴"};
  return what.unit + per.at(static_cast<std::size_t>(what.order));
}

}  // namespace bahnwerk::api
