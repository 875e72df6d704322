#include "server/routes/pages/why_html.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "server/pages/shell.hpp"
#include "server/routes/pages/json_members.hpp"
#include "server/routes/pages/result_html.hpp"

namespace bahnwerk::server {
namespace {

using nlohmann::ordered_json;

/// Returns the limits, and states, that some of the time belongs to, the largest share first; nothing where no limit is
/// declared.
std::vector<const ordered_json*> by_share(const ordered_json& limits) {
  std::vector<const ordered_json*> list;
  bool declared = false;
  for (const ordered_json& limit : member(limits, "limits")) {
    // States without a limit, such as dwell, have no unit.
    declared = declared || member(limit, "unit").is_string();
    if (limit.value("share", 0.0) > 0) list.push_back(&limit);
  }
  if (!declared) return {};
  std::stable_sort(list.begin(), list.end(), [](const ordered_json* a, const ordered_json* b) {
    return a->value("share", 0.0) > b->value("share", 0.0);
  });
  return list;
}

std::string limit_name(const ordered_json& name, const Texts& text) {
  return name.is_string() ? text.name(name.get<std::string>()) : std::string("–");
}

std::string capitalised(std::string name) {
  if (!name.empty() && name[0] >= 'a' && name[0] <= 'z') name[0] = static_cast<char>(name[0] - 'a' + 'A');
  return name;
}

/// Returns the three largest limits as a sentence.
std::string limits_sentence(const ordered_json& limits, const Texts& text) {
  constexpr std::size_t named = 3;
  constexpr double least = 0.01;
  std::string sentence;
  std::size_t count = 0;
  for (const ordered_json* limit : by_share(limits)) {
    const double share = limit->value("share", 0.0);
    if (count == named || share < least) break;
    sentence +=
        (count++ == 0 ? "" : ", ") + escape_html(limit_name(member(*limit, "name"), text)) + " " + percent(share, text);
  }
  return sentence.empty() ? "" : " " + capitalised(sentence) + ".";
}

std::string feed_sentence(const Reasons& reasons, const Texts& text) {
  const auto lost = number_at(member(reasons.blocks, "lost"), "to_feed");
  if (!reasons.feed_time || !lost || !(*reasons.feed_time > 0)) return "";
  const std::string cuts = duration_label(*reasons.feed_time, text);
  const bool nothing = *lost < 5e-4;
  return " " + escape_html(text(nothing ? "job.at_feed" : "job.lost_to_feed",
                                {{"cuts", cuts}, {"lost", duration_label(*lost, text)}}));
}

/// Returns what the page shows largest: the duration of the motion, of a law that of its cycle, of a slot the wires.
std::string main_figure(const ordered_json& summary, const Texts& text) {
  auto duration = number_at(summary, "duration");
  if (!duration) duration = number_at(summary, "cycle_duration");
  if (duration) return duration_label(*duration, text);
  if (const auto count = number_at(summary, "count"))
    return text("job.wires", {{"n", shown_value(member(summary, "count"), text)}});
  return "";
}

std::string head(const Texts& text, const char* key, bool right = false) {
  return std::string(right ? "<th scope=\"col\" class=\"n\">" : "<th scope=\"col\">") + escape_html(text(key)) +
         "</th>";
}

/// Returns the attributes that name the rows of one visit of an entry, the first one where there are several.
std::string rows_of(const ordered_json& entry, double cycle) {
  const auto start = number_at(entry, "start_time"), time = number_at(entry, "time");
  if (!start || !time || !(cycle > 0)) return "";
  const double visits = std::max(1.0, number_at(entry, "visits").value_or(1));
  const auto first = static_cast<long long>(*start / cycle),
             count = static_cast<long long>(std::ceil(*time / visits / cycle)) + 2;
  return " data-first=\"" + std::to_string(first) + "\" data-count=\"" + std::to_string(count) + "\"";
}

}  // namespace

std::string verdict_line(const ordered_json& result, const Reasons& reasons, const Texts& text) {
  const ordered_json &verdict = member(result, "verification"), &summary = member(result, "summary");
  if (!verdict.is_object()) return "";
  const bool verified = verdict.value("passed", false);
  const std::string figure = main_figure(summary, text);
  std::string html = "<p class=\"verdict\" data-verdict>";
  if (!figure.empty()) html += "<strong class=\"big\">" + escape_html(figure) + "</strong> ";
  html += "<strong class=\"state " + std::string(verified ? "succeeded" : "failed") + "\">" +
          escape_html(text(verified ? "job.good" : "job.not_good")) + "</strong><br>";
  std::string sentences;
  if (!verified) {
    std::string names;
    for (const ordered_json& check : member(verdict, "checks"))
      if (!check.value("passed", false))
        names += (names.empty() ? "" : ", ") + escape_html(limit_name(member(check, "name"), text));
    sentences = " " + escape_html(text("job.failed_checks")) + " " + names + ".";
  }
  sentences += limits_sentence(reasons.limits, text) + feed_sentence(reasons, text);
  return html + sentences + "</p>\n";
}

std::string limits_table(const ordered_json& limits, const Texts& text) {
  const auto list = by_share(limits);
  if (list.empty()) return "";
  std::string rows;
  for (const ordered_json* limit : list) {
    const std::string name = escape_html(limit_name(member(*limit, "name"), text));
    const std::string permitted = limit->contains("intervals")
                                      ? escape_html(text("job.by_block"))
                                      : with_unit(member(*limit, "value"), member(*limit, "unit"), text);
    rows += "<tr data-limit=\"" + shown_value(member(*limit, "id"), text) + "\"><th scope=\"row\">" + name +
            "</th><td class=\"k\">" + bar(limit->value("share", 0.0), name, text) + "</td><td class=\"n k\">" +
            duration_label(limit->value("time", 0.0), text) + "</td><td class=\"n k\">" + permitted + "</td></tr>\n";
  }
  return "<h2>" + escape_html(text("job.limits_title")) +
         "</h2>\n<div class=\"scroll\" tabindex=\"0\"><table class=\"limits\"><thead><tr>" +
         head(text, "job.limit_name") + head(text, "job.share") + head(text, "job.time", true) +
         head(text, "job.permitted", true) + "</tr></thead>\n<tbody>" + rows + "</tbody></table></div>\n";
}

std::string slowest_blocks(const ordered_json& blocks, double cycle, const Texts& text) {
  const ordered_json& list = member(blocks, "blocks");
  if (!list.is_array() || list.empty()) return "";
  const std::string by = blocks.value("by", "block");
  const bool program = by == "line";
  const auto lost = member(blocks, "lost");
  std::string html = "<h2>" + escape_html(text(program ? "job.slowest_lines" : "job.slowest_blocks")) +
                     "</h2>\n<div class=\"scroll\" tabindex=\"0\"><table class=\"slowest\"><thead><tr>" +
                     head(text, program ? "job.line" : "job.block", true) +
                     head(text, program ? "job.text" : "job.mode") + head(text, "job.time", true) +
                     head(text, "job.lost", true) + head(text, "job.limit_name") + "</tr></thead>\n<tbody>";
  for (const ordered_json& entry : list) {
    const ordered_json &mode = member(entry, "mode"), &limit = member(entry, "limit");
    html += "<tr" + rows_of(entry, cycle) + "><th scope=\"row\" class=\"n\">" +
            shown_value(member(entry, by.c_str()), text) + "</th><td class=\"line\">" +
            (program ? "<code><bdi>" + shown_value(member(entry, "text"), text) + "</bdi></code>"
                     : escape_html(mode.is_string()
                                       ? text.find("job.mode_" + mode.get<std::string>(), mode.get<std::string>())
                                       : "–")) +
            "</td><td class=\"n k\">" + duration_label(entry.value("time", 0.0), text) + "</td><td class=\"n k\">" +
            duration_label(entry.value("lost", 0.0), text) + "</td><td>" + escape_html(limit_name(limit, text)) +
            (limit.is_null() ? "" : " " + percent(entry.value("limit_share", 0.0), text)) + "</td></tr>\n";
  }
  html +=
      "</tbody></table></div>\n<p class=\"soft\">" +
      escape_html(text("job.lost_totals", {{"feed", duration_label(number_at(lost, "to_feed").value_or(0), text)},
                                           {"axes", duration_label(number_at(lost, "to_axes").value_or(0), text)}})) +
      "</p>\n";
  return html;
}

std::string worst_section(const ordered_json& details, const Texts& text) {
  const ordered_json& worst = member(member(details, "sections"), "worst");
  const auto gap = number_at(worst, "gap"), time = number_at(worst, "time");
  if (!gap || !time || *gap < 5e-4) return "";  // nearer than that nothing is to be gained
  const ordered_json& line = member(worst, "line");
  const std::string place = line.is_number()
                                ? text("job.at_line", {{"n", shown_value(line, text)}})
                                : text("job.at_segment", {{"n", shown_value(member(worst, "segment"), text)}});
  std::string sentence =
      text("job.worst_section", {{"place", place}, {"time", duration_label(*time, text)}, {"gap", "\x01"}});
  sentence = escape_html(sentence);
  sentence.replace(sentence.find('\x01'), 1, percent(*gap, text));
  return "<p>" + sentence + "</p>\n";
}

std::string what_if_bars(const ordered_json& result, const Texts& text) {
  const ordered_json& list = member(member(result, "details"), "what_if");
  const auto planned = number_at(member(result, "summary"), "duration");
  if (!list.is_array() || list.empty() || !planned) return "";
  double most = 0;
  for (const ordered_json& entry : list)
    if (const auto duration = number_at(entry, "duration")) most = std::max(most, std::abs(*planned - *duration));
  std::string rows;
  for (const ordered_json& entry : list) {
    const std::string limit = entry.value("limit", "");
    const std::string key = "job.what_if_" + limit + (entry.value("factor", 1.0) > 1 ? "_more" : "_less");
    const std::string name = escape_html(text.find(key, entry.value("text", limit)));
    const auto duration = number_at(entry, "duration");
    rows += "<tr><th scope=\"row\">" + name + "</th>";
    if (duration) {
      const double won = *planned - *duration;
      const char* sign = won < 0 ? "+" : "−";
      rows += "<td class=\"k\"><meter max=\"" + ordered_json(std::max(most, 1e-9)).dump() + "\" value=\"" +
              ordered_json(std::abs(won)).dump() + "\"" +
              (won < 0 ? " low=\"0\" high=\"0\" optimum=\"0\" class=\"longer\"" : "") + " aria-label=\"" + name +
              "\"></meter></td><td class=\"n k\">" + sign + duration_label(std::abs(won), text) +
              "</td><td class=\"n k\">" + duration_label(*duration, text) + "</td></tr>\n";
    } else {
      rows += "<td></td><td colspan=\"2\">" + escape_html(text("job.what_if_none")) + "</td></tr>\n";
    }
  }
  return "<h2>" + escape_html(text("job.what_if")) +
         "</h2>\n<div class=\"scroll\" tabindex=\"0\"><table class=\"what-if\"><thead><tr>" + head(text, "job.change") +
         head(text, "job.won") + head(text, "job.difference", true) + head(text, "job.duration", true) +
         "</tr></thead>\n<tbody>" + rows + "</tbody></table></div>\n";
}

}  // namespace bahnwerk::server
