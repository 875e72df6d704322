#pragma once
/// Names and units of checks as people read them. The header does not depend on JSON, so that tests of core can use it.
#include <array>
#include <cstddef>
#include <cstdio>
#include <string>

#include "core/base/verification.hpp"
#include "core/machine/limits.hpp"

namespace bahnwerk::api {

namespace text {

/// Returns the name of a check without its subject.
inline std::string general_name(const Checked& what, double limit) {
  if (what.quantity == quantity::axis && what.order == 0) return "range";
  std::string name;
  for (const char letter : what.quantity.name) {
    char number[32];
    std::snprintf(number, sizeof number, "%.10g", limit);
    if (letter == '%' || letter == '#')
      name += letter == '%' ? derivative_name(what.order) : number;
    else
      name += letter;
  }
  return name;
}

}  // namespace text

/// Returns the name of a check, such as "velocity x" or "path velocity (feed 400)"; `limit` is part of some names. The
/// subject follows the name if each axis or layout has such a check, and precedes it if it denotes a group of axes.
inline std::string check_name(const Checked& what, double limit) {
  const std::string name = text::general_name(what, limit);
  if (name.empty() || what.subject.empty()) return name + what.subject;
  return what.quantity.each ? name + ' ' + what.subject : what.subject + ' ' + name;
}

inline std::string check_name(const Check& check) { return check_name(check, check.limit); }

/// Returns what a check is about.
inline const char* check_group(const Checked& what) {
  switch (what.quantity.group) {
    case CheckGroup::limit:
      return "limit";
    case CheckGroup::geometry:
      return "geometry";
    case CheckGroup::continuity:
      return "continuity";
    case CheckGroup::setpoints:
      return "setpoints";
    case CheckGroup::bound:
      return "bound";
  }
  return "";
}

/// Returns the unit of a check, such as "mm/s²": the unit of order 0 divided by a power of the independent variable's.
inline std::string check_unit(const Checked& what) {
  constexpr std::array per{"", "/s", "/s²", "/s³", "/s⁴"};
  return what.unit + per.at(static_cast<std::size_t>(what.order));
}

}  // namespace bahnwerk::api
