#include "server/routes/pages/result_html.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "api/result_units.hpp"
#include "server/pages/shell.hpp"
#include "server/routes/pages/json_members.hpp"

namespace bahnwerk::server {
namespace {

using nlohmann::ordered_json;
using Checks = std::vector<const ordered_json*>;

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

/// Returns a share like percent(), a small one with its first digit: "0.00002 %".
std::string fine_percent(double share) {
  const double value = share * 100;
  if (value >= 0.01) return percent(share);
  if (!(value >= 1e-8)) return "0 %";
  return formatted(value, std::chars_format::fixed, static_cast<int>(std::ceil(-std::log10(value)))) + " %";
}

/// Returns a member's name as a page shows it.
std::string shown_name(const std::string& key, const Texts& text) {
  std::string name = key;
  std::replace(name.begin(), name.end(), '_', ' ');
  return escape_html(text.find("figures." + key, name));
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

std::string check_name(const ordered_json& check, const Texts& text) {
  const ordered_json& given = member(check, "name");
  if (!given.is_string()) return shown_value(given, text);
  std::string name = text.name(given.get<std::string>());
  // "path velocity (feed 400)" has a word behind the axis' place.
  constexpr std::string_view feed = "(feed ";
  if (const std::size_t at = name.find(feed); at != name.npos)
    name.replace(at, feed.size(), "(" + text.name("feed") + " ");
  return escape_html(name);
}

std::string check_row(const ordered_json& check, const Texts& text) {
  const auto use = use_of(check), at = number_at(check, "at");
  const std::string name = check_name(check, text);
  return "<tr><th scope=\"row\">" + name + "</th><td class=\"k\">" + (use ? bar(*use, name, text) : "–") +
         (passed(check) ? ""
                        : " <strong class=\"state failed\">" + escape_html(text("job.check_failed")) + "</strong>") +
         "</td><td class=\"n k\">" + with_unit(member(check, "value"), member(check, "unit"), text) +
         "</td><td class=\"n k\">" + with_unit(member(check, "limit"), member(check, "unit"), text) +
         "</td><td class=\"n k\"" + (at ? " data-at=\"" + ordered_json(*at).dump() + "\"" : "") +
         (at ? " data-unit=\"" + shown_value(member(check, "at_unit"), text) + "\"" : "") + ">" +
         with_unit(member(check, "at"), member(check, "at_unit"), text) + "</td></tr>\n";
}

std::string check_head(const Texts& text) {
  const auto head = [&](const char* key, bool right) {
    return std::string(right ? "<th scope=\"col\" class=\"n\">" : "<th scope=\"col\">") + escape_html(text(key)) +
           "</th>";
  };
  return "<thead><tr>" + head("job.check", false) + head("job.use", false) + head("job.value", true) +
         head("job.limit", true) + head("job.at", true) + "</tr></thead>\n";
}

std::string check_table(const Checks& checks, const Texts& text) {
  std::string rows;
  for (const ordered_json* check : checks) rows += check_row(*check, text);
  return "<div class=\"scroll\" tabindex=\"0\"><table class=\"checks\">" + check_head(text) + "<tbody>" + rows +
         "</tbody></table></div>\n";
}

/// Returns the checks of all groups but the limits, folded, with a body per group.
std::string folded(const std::vector<std::pair<std::string, Checks>>& groups, const Texts& text) {
  const ordered_json* most = nullptr;
  double largest = -1;
  std::size_t count = 0;
  std::string bodies;
  for (const auto& [group, checks] : groups) {
    count += checks.size();
    bodies += "<tbody><tr><th colspan=\"5\" scope=\"rowgroup\" class=\"group\">" +
              escape_html(text.find("job.group_" + group, group)) + "</th></tr>\n";
    for (const ordered_json* check : checks) {
      if (const auto use = use_of(*check); use && *use > largest) {
        largest = *use;
        most = check;
      }
      bodies += check_row(*check, text);
    }
    bodies += "</tbody>";
  }
  std::string summary =
      escape_html(count == 1 ? text("job.exact_one") : text("job.exact", {{"n", std::to_string(count)}}));
  if (most)
    summary += ", " + escape_html(text("job.largest_use")) + " " + percent(largest, text) + " (" +
               check_name(*most, text) + ")";
  return "<details><summary>" + summary + "</summary>\n<div class=\"scroll\" tabindex=\"0\"><table class=\"checks\">" +
         check_head(text) + bodies + "</table></div></details>\n";
}

}  // namespace

std::string bar(double share, const std::string& name, const Texts& text) {
  return "<meter max=\"1\" " + std::string(share > 1 ? "low=\"0.1\" high=\"0.9\" optimum=\"0\" " : "") +
         "aria-label=\"" + name + "\" value=\"" + formatted(share, std::chars_format::fixed, 4) + "\"></meter> " +
         percent(share, text);
}

std::string with_unit(const ordered_json& value, const ordered_json& unit, const Texts& text) {
  const std::string name = unit.is_string() ? unit.get<std::string>() : std::string();
  return shown_value(value, text) + (name.empty() || name == "1" || value.is_null() ? "" : " " + escape_html(name));
}

std::string shown_value(const ordered_json& value, const Texts& text) {
  if (value.is_number_float()) return text.number(number(value.get<double>()));
  if (value.is_string()) return escape_html(value.get<std::string>());
  if (value.is_null()) return "–";
  std::string list;
  if (value.is_object()) {
    for (const auto& [key, entry] : value.items())
      list += (list.empty() ? "" : ", ") + shown_name(key, text) + " " + shown_value(entry, text);
    return list;
  }
  if (value.is_array()) {
    for (const ordered_json& entry : value) list += (list.empty() ? "" : "<br>") + shown_value(entry, text);
    return list;
  }
  if (value.is_boolean()) return escape_html(text(value.get<bool>() ? "job.yes" : "job.no"));
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

std::string duration_label(double seconds, const Texts& text) { return text.number(duration_label(seconds)); }

std::string percent(double share) {
  const double value = share * 100;
  if (value == 0) return "0 %";
  if (std::abs(value) < 0.01) return "&lt; 0.01 %";
  const bool whole = std::abs(value) >= 9.95 || value != value;
  return whole ? formatted(value, std::chars_format::fixed, 0) + " %"
               : formatted(value, std::chars_format::general, 2) + " %";
}

std::string percent(double share, const Texts& text) { return text.number(percent(share)); }

std::string figures(const ordered_json& object, const std::string& kind, std::string_view part, const Texts& text) {
  if (!object.is_object()) return "";
  std::string rows;
  for (const auto& [key, value] : object.items()) {
    const std::string unit = value.is_number() || value.is_object() ? api::result_unit(kind, part, key) : std::string();
    rows += "<tr><th scope=\"row\">" + shown_name(key, text) + "</th><td>" + shown_value(value, text);
    if (!unit.empty()) rows.append(" ").append(unit);
    rows += "</td></tr>\n";
  }
  return "<table class=\"figures\">\n" + rows + "</table>\n";
}

std::string verification(const ordered_json& verdict, const Texts& text) {
  const ordered_json& checks = member(verdict, "checks");
  if (!checks.is_array()) return "";
  Checks failed, limits;
  std::vector<std::pair<std::string, Checks>> others;
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
  std::string html =
      "<h2>" +
      escape_html(text(verdict.value("passed", false) ? "job.verification_passed" : "job.verification_failed")) +
      "</h2>\n";
  if (!failed.empty()) html += check_table(failed, text);
  if (!limits.empty()) html += check_table(limits, text);
  if (!others.empty()) html += folded(others, text);
  return html;
}

std::string bound_sentence(const ordered_json& result, const Texts& text) {
  const ordered_json &bound = member(result, "bound"), &basis = member(bound, "basis");
  const auto gap = number_at(bound, "gap");
  if (!gap) return "";
  const std::string gain = text.number(fine_percent(*gap / (1 + *gap))), more = text.number(fine_percent(*gap));
  std::string sentence;
  if (const auto duration = number_at(bound, "duration"))
    sentence = text("job.bound_duration", {{"bound", text.number(number(*duration))}}) + " " +
               text("job.bound_gain", {{"gain", gain}});
  else if (const auto count = number_at(bound, "count"))
    sentence = text("job.bound_count", {{"bound", number(*count)}}) + " " + text("job.bound_more", {{"gain", more}});
  else if (const auto objective = number_at(bound, "objective"))
    sentence = text("job.bound_objective", {{"bound", text.number(number(*objective))}}) + " " +
               text("job.bound_gain", {{"gain", gain}});
  else
    return "";
  // "&lt;" of small shares is HTML already.
  const std::size_t less = sentence.find("&lt;");
  if (less != sentence.npos) sentence.replace(less, 4, "<");
  std::string html = "<p>" + escape_html(sentence) + "</p>\n<p>" +
                     bar(1 / (1 + std::max(0.0, *gap)), escape_html(text("job.bound_gauge")), text) +
                     " <span class=\"soft\">" + escape_html(text("job.bound_gauge")) + "</span></p>\n";
  if (basis.is_string())
    html += "<p class=\"soft\">" + escape_html(text("job.basis")) + " <span lang=\"en\">" + shown_value(basis, text) +
            "</span></p>\n";
  return html;
}

}  // namespace bahnwerk::server
