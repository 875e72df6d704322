#include "server/routes/pages/job_page.hpp"

#include <array>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "api/kind.hpp"
#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "api/setpoints/limits_answer.hpp"
#include "api/setpoints/setpoints.hpp"
#include "api/text/json_member.hpp"
#include "api/text/json_parts.hpp"
#include "api/text/rfc3339.hpp"
#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/http/uri.hpp"
#include "server/pages/shell.hpp"
#include "server/pages/texts.hpp"
#include "server/routes/blocks.hpp"
#include "server/routes/pages/result_html.hpp"
#include "server/routes/pages/why_html.hpp"
#include "server/routes/stored_series.hpp"

namespace bahnwerk::server {
namespace {

using nlohmann::ordered_json;

/// Returns an object of strings without escaped names, with null in place of its values: long ones cost little.
ordered_json names_alone(std::string_view text) {
  ordered_json out = ordered_json::object();
  for (std::size_t begin = text.find('"'), strings = 0; begin != text.npos; begin = text.find('"', begin)) {
    std::size_t end = ++begin;
    while ((end = text.find_first_of("\"\\", end)) != text.npos && text[end] == '\\') end += 2;
    if (end == text.npos) break;
    if (strings++ % 2 == 0) out[std::string(text.substr(begin, end - begin))] = nullptr;
    begin = end + 1;
  }
  return out;
}

/// Returns the members of the result that a page shows, drawings by their names. The others may have a hundred
/// megabytes.
ordered_json read_result(StoredText& text) {
  api::JsonParts shown({"kind", "summary", "bound", "verification", "setpoints", "details.notes", "details.what_if",
                        "details.sections"});
  api::JsonParts drawn({"details.drawings"});
  std::string piece;
  for (bool more = true, more_drawn = true; (more || more_drawn) && text.next(piece); piece.clear()) {
    more = more && shown.take(piece);
    more_drawn = more_drawn && drawn.take(piece);
  }
  ordered_json result = ordered_json::parse(shown.document(), nullptr, false);
  constexpr std::string_view begin = R"({"details":{"drawings":{)";
  if (const std::string drawings = drawn.document(); drawings.starts_with(begin))
    result["details"]["drawings"] = names_alone(std::string_view(drawings).substr(begin.size()));
  return result;
}

/// The string at /details/drawings/<name> of a stored result, in pieces.
class Drawing {
 public:
  Drawing(std::unique_ptr<StoredText> text, const std::string& name)
      : text_(std::move(text)), member_({"details", "drawings", name}) {
    while (!member_.found() && read()) {
    }
  }
  bool exists() const { return member_.found(); }
  bool next(std::string& out) {
    while (pending_.empty() && read()) {
    }
    out += pending_;
    pending_.clear();
    return !member_.ended();
  }

 private:
  bool read() {
    piece_.clear();
    if (member_.ended() || !text_->next(piece_)) return false;
    member_.take(piece_, pending_);
    return true;
  }
  std::unique_ptr<StoredText> text_;
  api::JsonMember member_;
  std::string piece_, pending_;
};

/// Returns the address of the field at a pointer into the job's document, on the page that posts it again with changes.
std::string field_link(const api::Job& job, const std::string& pointer) {
  std::string fragment;
  for (std::size_t at = 0; at < pointer.size();) {
    const std::size_t slash = std::min(pointer.find('/', at), pointer.size());
    fragment +=
        encode_component(std::string_view(pointer).substr(at, slash - at)) + (slash < pointer.size() ? "/" : "");
    at = slash + 1;
  }
  return "/new?from=" + job.id + "#" + fragment;
}

/// Returns why a job has no plan, and what to change. Titles and advice are in both languages, what the planner found
/// is in English.
std::string failure(const api::Job& job, const Texts& text) {
  const ordered_json error = ordered_json::parse(job.error.value_or("{}"), nullptr, false);
  if (!error.is_object() || error.empty()) return "";
  const std::string type = error.value("type", "");
  const std::string slug = type.substr(std::min(type.size(), std::string_view("/problems/").size()));
  std::string html = "<div class=\"error\" id=\"problem\"><p><strong>" +
                     escape_html(text.find("job.error_" + slug, error.value("title", ""))) +
                     ".</strong> <span lang=\"en\">" + escape_html(error.value("detail", "")) + "</span></p>\n";
  if (error.contains("errors")) {
    html += "<ul>";
    for (const auto& fault : error["errors"]) {
      const std::string pointer = fault.value("pointer", "");
      html += "<li><a href=\"" + escape_html(field_link(job, pointer)) + "\"><code>" + escape_html(pointer) +
              "</code></a> <span lang=\"en\">" + escape_html(fault.value("message", "")) + "</span></li>";
    }
    html += "</ul>\n";
  }
  for (const auto& each : api::problem_types())
    if (each.slug == slug)
      html += "<p>" + prose_html(text.find("job.advice_" + slug, each.advice)) + " <a href=\"" + type + "\">" + slug +
              "</a></p>\n";
  return html + "<p><a href=\"/new?from=" + job.id + "\">" + escape_html(text("job.repost")) + "</a></p></div>\n";
}

/// Returns the media type of a drawing by its name.
std::string_view drawing_type(std::string_view name) {
  return name.ends_with(".dxf") ? "image/vnd.dxf" : "image/svg+xml";
}
bool shown_by_browsers(std::string_view name) { return drawing_type(name) == "image/svg+xml"; }

std::string heading(const Texts& text, std::string_view key) { return "<h2>" + escape_html(text(key)) + "</h2>\n"; }

std::string drawings(const std::string& page, const ordered_json& details, const Texts& text) {
  if (!details.contains("drawings") || !details["drawings"].is_object() || details["drawings"].empty()) return "";
  std::string html;
  for (const auto& [name, drawing] : details["drawings"].items()) {
    if (!shown_by_browsers(name)) continue;
    const std::string link = page + "/drawings/" + encode_component(name);
    html += "<figure><a href=\"" + link + "\"><img loading=\"lazy\" src=\"" + link + "\" alt=\"" + escape_html(name) +
            "\"></a><figcaption>" + escape_html(name) + "</figcaption></figure>\n";
  }
  // Modules draw what the pictures show: those stay for who has no script, and for print.
  return html.empty() ? ""
                      : "<details class=\"drawings\"><summary>" + escape_html(text("job.drawings")) + "</summary>\n" +
                            html + "</details>\n";
}

std::string downloads(const std::string& link, const std::string& page, const ordered_json& result, const Texts& text) {
  const auto entry = [](const std::string& address, const std::string& label) {
    return "<a href=\"" + address + "\">" + escape_html(label) + "</a>";
  };
  std::string html = "<section id=\"downloads\">" + heading(text, "job.downloads") + "<p>" +
                     entry(link + "/spec", text("job.document"));
  if (!result.is_null()) {
    html += " · " + entry(link + "/result", text("job.result"));
    if (result.contains("setpoints"))
      for (const auto format : {api::SetpointFormat::csv, api::SetpointFormat::ndjson, api::SetpointFormat::f64,
                                api::SetpointFormat::json}) {
        const std::string name(api::format_name(format));
        html += " · " + entry(link + "/setpoints?format=" + name, text("job.setpoints") + ", " + name);
      }
    const api::Kind* const kind = api::find_kind(result.value("kind", ""));
    if (result.contains("setpoints") && kind)
      for (const std::string_view layout : kind->files.layouts) {
        const std::string name(layout);
        html += " · " + entry(link + "/setpoints?layout=" + name, std::string(kind->files.title) + ", " + name);
      }
    if (result.contains("details") && result["details"].contains("drawings"))
      for (const auto& [name, drawing] : result["details"]["drawings"].items())
        if (!shown_by_browsers(name)) html += " · " + entry(page + "/drawings/" + encode_component(name), name);
  }
  return html + " · " + entry(link, text("job.resource")) + "</p></section>\n";
}

std::string facts(const api::Job& job, const Texts& text) {
  std::string rows;
  const auto row = [&](const char* key, const std::string& value) {
    if (!value.empty())
      rows += "<tr><th scope=\"row\">" + escape_html(text(key)) + "</th><td>" + value + "</td></tr>\n";
  };
  const auto name = [](const std::optional<std::string>& given) {
    return given && !given->empty() ? "<bdi>" + escape_html(*given) + "</bdi>" : std::string();
  };
  const auto time = [](const std::optional<std::int64_t>& ms) { return ms ? time_label(*ms) : std::string(); };
  row("job.state", state_label(job, text));
  row("job.kind", escape_html(text.find("job.kind_" + job.request.kind, job.request.kind)));
  row("job.name", name(job.request.name));
  row("job.reference", name(job.request.reference));
  row("job.id", "<code>" + job.id + "</code>");
  row("job.priority", std::to_string(job.request.priority));
  row("job.deadline", time(job.request.deadline));
  row("job.created", time(job.created_at));
  row("job.started", time(job.started_at));
  row("job.finished", time(job.finished_at));
  row("job.attempt", std::to_string(job.attempt));
  return "<section id=\"facts\">" + heading(text, "job.job") + "<table class=\"figures\">\n" + rows +
         "</table></section>\n";
}

/// Returns what the stored views say of the motion's time. Nothing where the series has no views yet: those are made by
/// reading all rows.
Reasons reasons_of(Context& context, const api::Job& job) {
  constexpr std::size_t slowest = 8;
  Reasons reasons;
  const auto info = context.store.series(job.id);
  if (!info || info->views != api::views_version) return reasons;
  reasons.cycle = info->cycle_time;
  const api::SetpointSeries series = stored_series(context, *info);
  api::LimitsReader limits(series.view, info->count);
  reasons.limits = api::limits_answer(limits, info->count, info->cycle_time, {});
  const auto table = api::read_segments(series.view);
  if (!table) return reasons;
  double at_feed = 0;
  for (const api::PlannedSegment& segment : table->segments)
    if (segment.feed < std::numeric_limits<double>::infinity()) at_feed += segment.least_time;
  reasons.feed_time = at_feed;
  const api::BlockQuery query{.by = table->program ? api::ListedBy::line : api::ListedBy::block,
                              .sort = api::ListOrder::lost,
                              .count = slowest};
  reasons.blocks = blocks_answer(context.store, job.id, series, *table, query);
  return reasons;
}

/// Returns why the motion takes as long as it does: limits and slowest lines beside each other, then what would change
/// it.
std::string why(const ordered_json& result, const Reasons& reasons, const Texts& text) {
  const ordered_json details = result.value("details", ordered_json::object());
  const std::string limits = limits_table(reasons.limits, text),
                    lines = slowest_blocks(reasons.blocks, reasons.cycle, text);
  std::string html = "<section id=\"why\">";
  if (!limits.empty() || !lines.empty()) {
    html += "<div class=\"pair\">";
    if (!limits.empty()) html += "<div>" + limits + "</div>";
    if (!lines.empty()) html += "<div>" + lines + worst_section(details, text) + "</div>";
    html += "</div>\n";
  }
  return html + what_if_bars(result, text) + "</section>\n";
}

/// Returns the element that tells the page's module which job it shows, and the size and columns of its series.
std::string job_element(Context& context, const api::Job& job) {
  std::string html = "<div id=\"job\" data-id=\"" + job.id + "\" data-kind=\"" + escape_html(job.request.kind) +
                     "\" data-state=\"" + std::string(api::to_string(job.state)) + "\"";
  const auto info = final(job) ? context.store.series(job.id) : std::nullopt;
  if (info) {
    std::string columns, units;
    for (const auto& column : info->columns) {
      columns += (columns.empty() ? "" : ",") + column.name;
      units += (&column == &info->columns.front() ? "" : ",") + column.unit;
    }
    const bool timed = info->independent.time();
    html += " data-rows=\"" + std::to_string(info->count) + "\" data-cycle=\"" +
            nlohmann::json(timed ? info->cycle_time : info->independent.step).dump() + "\" data-seconds=\"" +
            nlohmann::json(info->cycle_time).dump() + "\" data-independent=\"" + escape_html(info->independent.name) +
            "\" data-unit=\"" + escape_html(timed ? "s" : info->independent.unit) + "\" data-columns=\"" +
            escape_html(columns) + "\" data-units=\"" + escape_html(units) + "\"";
  }
  return html + "></div>\n";
}

/// Returns what is known of a job that has not ended, for the page's module to keep up to date.
std::string progress(const api::Job& job, const Texts& text) {
  const bool running = job.state == api::JobState::running;
  std::string html = "<section id=\"live\"><p><progress max=\"1\"";
  if (running) html += " value=\"" + nlohmann::json(job.fraction).dump() + "\"";
  html += " aria-label=\"" + escape_html(text("job.progress")) + "\"></progress></p>\n<p class=\"stage\">";
  if (running) html += escape_html(text.find("job.stage_" + job.stage, job.stage)) + " " + escape_html(job.message);
  return html + "</p><noscript><p><a href=\"\">" + escape_html(text("job.refresh")) + "</a></p></noscript></section>\n";
}

/// Returns the first line of a job without a plan.
std::string state_line(const api::Job& job, const Texts& text) {
  return "<p class=\"verdict\" data-verdict>" + state_label(job, text) + " <span class=\"soft\">" +
         escape_html(text.find("job.kind_" + job.request.kind, job.request.kind)) + "</span></p>\n";
}

std::string body(Context& context, const api::Job& job, const ordered_json& result, const Texts& text) {
  const std::string page = "/jobs/" + job.id;
  std::string html = job_element(context, job);
  const Reasons reasons = result.is_object() ? reasons_of(context, job) : Reasons{};
  const std::string verdict = verdict_line(result, reasons, text);
  html += verdict.empty() ? state_line(job, text) : verdict;
  html += failure(job, text);
  if (!final(job)) html += progress(job, text);
  if (result.is_object()) {
    const ordered_json details = result.value("details", ordered_json::object());
    const bool failed = job.state == api::JobState::failed;  // then the checks say why, and come first
    const std::string checks = "<section id=\"verification\">" +
                               verification(result.value("verification", ordered_json()), text) + "</section>\n";
    if (failed) html += checks;
    html += why(result, reasons, text);
    if (result.contains("setpoints"))
      html += "<div class=\"beside\"><section id=\"curves\"></section>\n<section id=\"path\"></section></div>\n";
    html += "<section id=\"kind\"></section>\n" + drawings(page, details, text);
    if (!failed) html += checks;
    if (const std::string bound = bound_sentence(result, text); !bound.empty())
      html += "<section id=\"bound\">" + heading(text, "job.bound") + bound + "</section>\n";
    html += "<div class=\"pair\"><section id=\"summary\">" + heading(text, "job.summary") +
            figures(result.value("summary", ordered_json()), job.request.kind, "summary", text) + "</section>\n";
    html += facts(job, text) + "</div>\n";
    if (details.contains("notes") && !details["notes"].empty()) {
      html += "<section id=\"notes\">" + heading(text, "job.notes") + "<ul lang=\"en\">";
      for (const auto& note : details["notes"]) html += "<li>" + shown_value(note, text) + "</li>";
      html += "</ul></section>\n";
    }
  } else {
    html += facts(job, text);
  }
  return html + downloads("/v1/jobs/" + job.id, page, result, text);
}

}  // namespace

std::string time_label(std::int64_t ms) {
  const std::string text = api::rfc3339(ms);
  return "<time datetime=\"" + text + "\">" + text.substr(0, 10) + " " + text.substr(11, 8) + " UTC</time>";
}

std::string state_label(const api::Job& job, const Texts& text) {
  const std::string state(api::to_string(job.state));
  std::string html = "<span class=\"state " + state + "\">" + escape_html(text("job.state_" + state)) + "</span>";
  // 0.29 · 100 is below 29.
  if (job.state == api::JobState::running)
    html += " " + std::to_string(static_cast<int>(job.fraction * 100 + 1e-9)) + " %";
  return html;
}

Response job_page(Context& context, const Request& request) {
  require_page(request);
  const Texts text(language_of(request));
  const api::Job job = find_job(context, request.parameter("id"));
  ordered_json result;
  // A plan that failed its verification has a result, too.
  if (final(job))
    if (const auto stored = context.store.open_result(job.id)) result = read_result(*stored);
  const std::string title =
      job.request.name && !job.request.name->empty() ? *job.request.name : text("job.title", {{"id", job.id}});
  return tagged_page(request, {.title = title, .body = body(context, job, result, text), .module = "job"});
}

Response drawing(Context& context, const Request& request) {
  const std::string &id = request.parameter("id"), &name = request.parameter("name");
  const std::string_view type = drawing_type(name);
  if (!negotiate(request.header("accept"), std::array{type}))
    throw api::Problem("not-acceptable", "This drawing comes as " + std::string(type) + ".");
  const api::Job job = require_result(context, id);
  Response response = unless_known(request, content_etag(context, job, "drawing"), [&] {
    auto text = context.store.open_result(id);
    const auto drawing = text ? std::make_shared<Drawing>(std::move(text), name) : nullptr;
    if (!drawing || !drawing->exists())
      throw api::Problem("not-found", "The job " + id + " has no drawing " + api::shortened(name) + ".");
    Response picture;
    picture.set("Content-Type", std::string(type));
    picture.stream = [drawing](std::string& piece) { return drawing->next(piece); };
    return picture;
  });
  // Opened on its own, a picture is a document: it gets no more rights than the page.
  response.set("Content-Security-Policy", "default-src 'none'; style-src 'unsafe-inline'; frame-ancestors 'none'");
  return response;
}

}  // namespace bahnwerk::server
