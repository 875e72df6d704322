#include "server/routes/result_html.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "api/setpoints/result_units.hpp"
#include "server/pages/shell.hpp"

namespace bahnwerk::server {
namespace {

using nlohmann::ordered_json;

std::string formatted(double value, std::chars_format format, int digits) {
  std::array<char, 400> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, format, digits).ptr;
  return {text.data(), end};
}

/// Returns a number with six significant digits; the exact value is in the result.
std::string number(double value) {
  if (std::abs(value) >= 1e6 || (value != 0 && std::abs(value) < 1e-4))
    return formatted(value, std::chars_format::scientific, 3);
  return formatted(value, std::chars_format::general, 6);
}

/// Returns a member's name as a page shows it.
std::string shown_name(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return escape_html(name);
}

std::optional<double> number_at(const ordered_json& object, const char* name) {
  if (!object.is_object()) return std::nullopt;
  const auto found = object.find(name);
  return found != object.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

const ordered_json& member(const ordered_json& object, const char* name) {
  static const ordered_json none;
  if (!object.is_object()) return none;
  const auto found = object.find(name);
  return found != object.end() ? *found : none;
}

/// Returns a bar that is full at 1, with its share. Beyond 1 it has the colour of what is far from the optimum.
std::string bar(double share) {
  return "<meter max=\"1\" " + std::string(share > 1 ? "low=\"0.1\" high=\"0.9\" optimum=\"0\" " : "") + "value=\"" +
         formatted(share, std::chars_format::fixed, 4) + "\"></meter> " + percent(share);
}

bool passed(const ordered_json& check) { return check.value("passed", false); }

/// Returns value / limit, or its inverse where the limit is the least permitted value: a check that passed has at most
/// 1. nullopt: one of them is 0, and the other is not.
std::optional<double> use_of(const ordered_json& check) {
  const auto value = number_at(check, "value"), limit = number_at(check, "limit");
  if (!value || !limit) return std::nullopt;
  if (*value == 0) return passed(check) ? std::optional(0.0) : std::nullopt;
  if (*limit == 0) return std::nullopt;
  const double use = std::abs(*value / *limit), inverse = 1 / use;
  return passed(check) ? std::min(use, inverse) : std::max(use, inverse);
}

std::string with_unit(const ordered_json& value, const ordered_json& unit) {
  const std::string text = unit.is_string() ? unit.get<std::string>() : std::string();
  return shown_value(value) + (text.empty() || text == "1" || value.is_null() ? "" : " " + escape_html(text));
}

std::string check_table(const std::vector<const ordered_json*>& checks) {
  std::string text =
      "<div class=\"scroll\"><table><thead><tr><th>check</th><th>use</th><th class=\"n\">value</th><th "
      "class=\"n\">limit</th><th class=\"n\">at</th></tr></thead>\n";
  for (const ordered_json* check : checks) {
    const auto use = use_of(*check);
    text += "<tr><td>" + shown_value(member(*check, "name")) + "</td><td class=\"k\">" + (use ? bar(*use) : "–") +
            (passed(*check) ? "" : " <strong>failed</strong>") + "</td><td class=\"n k\">" +
            with_unit(member(*check, "value"), member(*check, "unit")) + "</td><td class=\"n k\">" +
            with_unit(member(*check, "limit"), member(*check, "unit")) + "</td><td class=\"n k\">" +
            with_unit(member(*check, "at"), member(*check, "at_unit")) + "</td></tr>\n";
  }
  return text + "</table></div>\n";
}

std::string folded(std::string_view group, const std::vector<const ordered_json*>& checks) {
  const ordered_json* most = nullptr;
  double largest = -1;
  for (const ordered_json* check : checks)
    if (const auto use = use_of(*check); use && *use > largest) {
      largest = *use;
      most = check;
    }
  std::string text = "<details><summary>" + escape_html(group) + ": " + std::to_string(checks.size()) +
                     (checks.size() == 1 ? " check" : " checks") + " passed";
  if (most) text += ", largest use " + percent(largest) + " (" + shown_value(member(*most, "name")) + ")";
  return text + "</summary>\n" + check_table(checks) + "</details>\n";
}

}  // namespace

std::string shown_value(const ordered_json& value) {
  if (value.is_number_float()) return number(value.get<double>());
  if (value.is_string()) return escape_html(value.get<std::string>());
  if (value.is_null()) return "–";
  std::string list;
  if (value.is_object()) {
    for (const auto& [key, entry] : value.items())
      list += (list.empty() ? "" : ", ") + shown_name(key) + " " + shown_value(entry);
    return list;
  }
  if (value.is_array()) {
    for (const ordered_json& entry : value) list += (list.empty() ? "" : "<br>") + shown_value(entry);
    return list;
  }
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  return escape_html(value.dump());
}

std::string duration_label(double seconds) {
  if (seconds < 59.9995) return formatted(seconds, std::chars_format::fixed, 3) + " s";
  if (seconds < 599.995) return formatted(seconds, std::chars_format::fixed, 2) + " s";
  const double rounded = std::round(seconds);
  const double minutes = std::floor(rounded / 60), hours = std::floor(minutes / 60);
  const auto whole = [](double value) { return formatted(value, std::chars_format::fixed, 0); };
  return hours > 0 ? whole(hours) + " h " + whole(minutes - 60 * hours) + " min"
                   : whole(minutes) + " min " + whole(rounded - 60 * minutes) + " s";
}

std::string percent(double share) {
  const double value = share * 100;
  if (value == 0) return "0 %";
  if (std::abs(value) < 0.01) return "&lt; 0.01 %";
  const bool whole = std::abs(value) >= 9.95 || value != value;
  return whole ? formatted(value, std::chars_format::fixed, 0) + " %"
               : formatted(value, std::chars_format::general, 2) + " %";
}

std::string verdict_line(const ordered_json& result) {
  const ordered_json &verdict = member(result, "verification"), &summary = member(result, "summary");
  if (!verdict.is_object()) return "";
  const bool verified = verdict.value("passed", false);
  std::string text = "<p class=\"lead\"><strong class=\"state " + std::string(verified ? "succeeded" : "failed") +
                     "\">" + (verified ? "verified" : "not verified") + "</strong>";
  if (!verified) {
    std::string names;
    for (const ordered_json& check : member(verdict, "checks"))
      if (!passed(check)) names += (names.empty() ? " failed: " : ", ") + shown_value(member(check, "name"));
    text += names;
  }
  text += " · " + escape_html(result.value("kind", ""));
  auto duration = number_at(summary, "duration");
  if (!duration) duration = number_at(summary, "cycle_duration");
  if (duration) text += " · duration <strong>" + duration_label(*duration) + "</strong>";
  if (const auto count = number_at(summary, "count")) text += " · count <strong>" + number(*count) + "</strong>";
  if (const auto gap = number_at(member(result, "bound"), "gap"))
    text += " · gap to the bound <strong>" + percent(*gap) + "</strong>";
  return text + "</p>\n";
}

std::string figures(const ordered_json& object, const std::string& kind, std::string_view part) {
  if (!object.is_object()) return "";
  std::string rows;
  for (const auto& [key, value] : object.items()) {
    const std::string unit = value.is_number() || value.is_object() ? api::result_unit(kind, part, key) : std::string();
    rows += "<tr><th>" + shown_name(key) + "</th><td>" + shown_value(value);
    if (!unit.empty()) rows.append(" ").append(unit);
    rows += "</td></tr>\n";
  }
  return "<table>\n" + rows + "</table>\n";
}

std::string largest_limits(const ordered_json& limits) {
  constexpr std::size_t shown = 3;
  std::vector<const ordered_json*> list;
  for (const ordered_json& limit : member(limits, "limits"))
    if (limit.value("share", 0.0) > 0) list.push_back(&limit);
  // States without a limit, such as dwell, have no unit.
  const bool limited = std::any_of(list.begin(), list.end(),
                                   [](const ordered_json* limit) { return member(*limit, "unit").is_string(); });
  if (!limited) return "";
  std::stable_sort(list.begin(), list.end(), [](const ordered_json* a, const ordered_json* b) {
    return a->value("share", 0.0) > b->value("share", 0.0);
  });
  list.resize(std::min(list.size(), shown));
  std::string text =
      "<h2>What limits the motion</h2>\n<div class=\"scroll\"><table><thead><tr><th>limit</th><th>share of the time"
      "</th><th class=\"n\">time</th><th class=\"n\">permitted</th></tr></thead>\n";
  for (const ordered_json* limit : list) {
    const double share = limit->value("share", 0.0);
    const ordered_json& value = member(*limit, "value");
    const bool by_block = limit->contains("intervals");
    const std::string name = limit->value("name", "");
    text += "<tr><td>" + escape_html(name) + (name == "ahead" ? " (no limit is met)" : "") + "</td><td class=\"k\">" +
            bar(share) + "</td><td class=\"n k\">" + duration_label(limit->value("time", 0.0)) +
            "</td><td class=\"n k\">" + (by_block ? "by block" : with_unit(value, member(*limit, "unit"))) +
            "</td></tr>\n";
  }
  return text + "</table></div>\n";
}

std::string slowest_blocks(const ordered_json& blocks) {
  const ordered_json& list = member(blocks, "blocks");
  if (!list.is_array() || list.empty()) return "";
  const std::string by = blocks.value("by", "block");
  const bool program = by == "line";
  const auto lost = member(blocks, "lost");
  std::string text = "<h2>Slowest " + escape_html(by) +
                     "s</h2>\n<p>Lost against the feed: " + duration_label(number_at(lost, "to_feed").value_or(0)) +
                     "; in positioning, against the velocities of the axes: " +
                     duration_label(number_at(lost, "to_axes").value_or(0)) +
                     ".</p>\n<div class=\"scroll\"><table><thead><tr><th class=\"n\">" + escape_html(by) + "</th>" +
                     (program ? "<th>text</th>" : "<th>mode</th>") +
                     "<th class=\"n\">time</th><th class=\"n\">lost</th><th>limit</th></tr></thead>\n";
  for (const ordered_json& entry : list)
    text += "<tr><td class=\"n\">" + shown_value(member(entry, by.c_str())) + "</td><td class=\"line\">" +
            (program ? "<code>" + shown_value(member(entry, "text")) + "</code>" : shown_value(member(entry, "mode"))) +
            "</td><td class=\"n k\">" + duration_label(entry.value("time", 0.0)) + "</td><td class=\"n k\">" +
            duration_label(entry.value("lost", 0.0)) + "</td><td>" + shown_value(member(entry, "limit")) +
            (member(entry, "limit").is_null() ? "" : " " + percent(entry.value("limit_share", 0.0))) + "</td></tr>\n";
  return text + "</table></div>\n";
}

std::string verification(const ordered_json& verdict) {
  const ordered_json& checks = member(verdict, "checks");
  if (!checks.is_array()) return "";
  std::vector<const ordered_json*> failed, limits;
  std::vector<std::pair<std::string, std::vector<const ordered_json*>>> others;
  for (const ordered_json& check : checks) {
    const std::string group = check.value("group", "other");
    if (!passed(check)) {
      failed.push_back(&check);
    } else if (group == "limit") {
      limits.push_back(&check);
    } else {
      auto found = std::find_if(others.begin(), others.end(), [&](const auto& each) { return each.first == group; });
      if (found == others.end()) found = others.insert(found, {group, {}});
      found->second.push_back(&check);
    }
  }
  std::string text =
      "<h2>Verification: " + std::string(verdict.value("passed", false) ? "passed" : "failed") + "</h2>\n";
  if (!failed.empty()) text += check_table(failed);
  if (!limits.empty()) text += check_table(limits);
  for (const auto& [group, list] : others) text += folded(group, list);
  return text;
}

}  // namespace bahnwerk::server
