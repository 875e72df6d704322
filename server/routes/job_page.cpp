#include "server/routes/job_page.hpp"

#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "api/kind.hpp"
#include "api/problem.hpp"
#include "api/setpoints/setpoints.hpp"
#include "api/text/json_member.hpp"
#include "api/text/json_parts.hpp"
#include "api/text/pointer.hpp"
#include "api/views/limits_answer.hpp"
#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/http/uri.hpp"
#include "server/pages/shell.hpp"
#include "server/routes/blocks.hpp"
#include "server/routes/result_html.hpp"
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
  api::JsonParts shown({"kind", "summary", "bound", "verification", "setpoints", "details.notes"});
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

std::string failure(const api::Job& job) {
  const ordered_json error = ordered_json::parse(job.error.value_or("{}"), nullptr, false);
  if (!error.is_object() || error.empty()) return "";
  const std::string type = error.value("type", "");
  std::string text = "<div class=\"error\"><p><strong>" + escape_html(error.value("title", "")) + ".</strong> " +
                     escape_html(error.value("detail", "")) + "</p>\n";
  if (error.contains("errors")) {
    text += "<ul>";
    for (const auto& fault : error["errors"])
      text += "<li><code>" + escape_html(fault.value("pointer", "")) + "</code> " +
              escape_html(fault.value("message", "")) + "</li>";
    text += "</ul>\n";
  }
  for (const auto& each : api::problem_types())
    if (type == "/problems/" + std::string(each.slug))
      text += "<p>" + prose_html(each.advice) + " <a href=\"" + type + "\">" + std::string(each.slug) + "</a></p>\n";
  return text + "</div>\n";
}

/// Returns the media type of a drawing by its name.
std::string_view drawing_type(std::string_view name) {
  return name.ends_with(".dxf") ? "image/vnd.dxf" : "image/svg+xml";
}
bool shown_by_browsers(std::string_view name) { return drawing_type(name) == "image/svg+xml"; }

std::string drawings(const std::string& page, const ordered_json& details) {
  if (!details.contains("drawings") || !details["drawings"].is_object() || details["drawings"].empty()) return "";
  std::string text = "<h2>Drawings</h2>\n";
  for (const auto& [name, drawing] : details["drawings"].items()) {
    if (!shown_by_browsers(name)) continue;
    const std::string link = page + "/drawings/" + encode_component(name);
    text += "<figure><a href=\"" + link + "\"><img src=\"" + link + "\" alt=\"" + escape_html(name) +
            "\"></a><figcaption>" + escape_html(name) + "</figcaption></figure>\n";
  }
  return text;
}

std::string downloads(const std::string& link, const std::string& page, const ordered_json& result) {
  std::string text = "<h2>Downloads</h2>\n<p><a href=\"" + link + "/spec\">document as posted</a>";
  if (!result.is_null()) {
    text += " · <a href=\"" + link + "/result\">result</a>";
    if (result.contains("setpoints"))
      for (const auto format : {api::SetpointFormat::csv, api::SetpointFormat::ndjson, api::SetpointFormat::f64,
                                api::SetpointFormat::json}) {
        const std::string name(api::format_name(format));
        text += " · <a href=\"" + link + "/setpoints?format=" + name + "\">setpoints, " + name + "</a>";
      }
    const api::Kind* const kind = api::find_kind(result.value("kind", ""));
    if (result.contains("setpoints") && kind)
      for (const std::string_view layout : kind->files.layouts) {
        const std::string name(layout);
        text += " · <a href=\"" + link + "/setpoints?layout=" + name + "\">" + std::string(kind->files.title) + ", " +
                name + "</a>";
      }
    if (result.contains("details") && result["details"].contains("drawings"))
      for (const auto& [name, drawing] : result["details"]["drawings"].items())
        if (!shown_by_browsers(name))
          text += " · <a href=\"" + page + "/drawings/" + encode_component(name) + "\">" + escape_html(name) + "</a>";
  }
  return text + " · <a href=\"" + link + "\">job</a></p>\n";
}

std::string facts(const api::Job& job) {
  std::string rows;
  const auto row = [&](const char* name, const std::string& value) {
    if (!value.empty()) rows += "<tr><th>" + std::string(name) + "</th><td>" + value + "</td></tr>\n";
  };
  const auto time = [](const std::optional<std::int64_t>& ms) { return ms ? time_label(*ms) : std::string(); };
  row("state", state_label(job));
  row("kind", escape_html(job.request.kind));
  row("name", escape_html(job.request.name.value_or("")));
  row("reference", escape_html(job.request.reference.value_or("")));
  row("id", "<code>" + job.id + "</code>");
  row("priority", std::to_string(job.request.priority));
  row("deadline", time(job.request.deadline));
  row("created", time(job.created_at));
  row("started", time(job.started_at));
  row("finished", time(job.finished_at));
  row("attempt", std::to_string(job.attempt));
  return "<table>\n" + rows + "</table>\n";
}

/// Returns what limits the motion, and of contours the lines, or blocks, that lose most time. Nothing where the series
/// has no views yet: those are made by reading all rows.
std::string limits_and_blocks(Context& context, const api::Job& job) {
  constexpr std::size_t slowest = 5;
  const auto info = context.store.series(job.id);
  if (!info || info->views != api::views_version) return "";
  const api::SetpointSeries series = stored_series(context.store, *info);
  api::LimitsReader limits(series.view, info->count);
  std::string text = largest_limits(api::limits_answer(limits, info->count, info->cycle_time, {}));
  const auto table = api::read_segments(series.view);
  if (!table) return text;
  const api::BlockQuery query{.by = table->program ? api::ListedBy::line : api::ListedBy::block,
                              .sort = api::ListOrder::lost,
                              .count = slowest};
  return text + slowest_blocks(blocks_answer(context.store, job.id, series, *table, query));
}

/// Returns the element that tells the page's module which job it shows, and the size and columns of its series.
std::string job_element(Context& context, const api::Job& job) {
  std::string text = "<div id=\"job\" data-id=\"" + job.id + "\" data-kind=\"" + escape_html(job.request.kind) +
                     "\" data-state=\"" + std::string(api::to_string(job.state)) + "\"";
  const auto info = final(job) ? context.store.series(job.id) : std::nullopt;
  if (info) {
    std::string columns;
    for (const auto& column : info->columns) columns += (columns.empty() ? "" : ",") + column.name;
    text += " data-rows=\"" + std::to_string(info->count) + "\" data-cycle=\"" +
            nlohmann::json(info->cycle_time).dump() + "\" data-columns=\"" + escape_html(columns) + "\"";
  }
  return text + "></div>\n";
}

std::string body(Context& context, const api::Job& job, const ordered_json& result) {
  const std::string page = "/jobs/" + job.id;
  std::string text = job_element(context, job);
  text += result.is_object()
              ? verdict_line(result)
              : "<p class=\"lead\">" + state_label(job) + " · " + escape_html(job.request.kind) + "</p>\n";
  text += failure(job);
  if (job.state == api::JobState::running)
    text += "<p><progress max=\"1\" value=\"" + shown_value(job.fraction) + "\"></progress><br>" +
            escape_html(job.stage) + " " + escape_html(job.message) + "</p>\n";
  if (result.is_object()) {
    const ordered_json details = result.value("details", ordered_json::object());
    const ordered_json verdict = result.value("verification", ordered_json());
    const bool failed = job.state == api::JobState::failed;  // then the checks say why, and come first
    if (failed) text += verification(verdict);
    text += limits_and_blocks(context, job);
    if (result.contains("setpoints")) text += "<section id=\"curves\"></section>\n<section id=\"path\"></section>\n";
    text += "<section id=\"kind\"></section>\n" + drawings(page, details);
    text += "<h2>Summary</h2>\n" + figures(result.value("summary", ordered_json()), job.request.kind, "summary");
    if (result.contains("bound")) text += "<h2>Bound</h2>\n" + figures(result["bound"], job.request.kind, "bound");
    if (details.contains("notes") && !details["notes"].empty()) {
      text += "<h2>Notes</h2>\n<ul>";
      for (const auto& note : details["notes"]) text += "<li>" + shown_value(note) + "</li>";
      text += "</ul>\n";
    }
    if (!failed) text += verification(verdict);
  }
  text += "<h2>Job</h2>\n" + facts(job);
  return text + downloads("/v1/jobs/" + job.id, page, result);
}

}  // namespace

std::string time_label(std::int64_t ms) {
  const std::string text = api::rfc3339(ms);
  return "<time datetime=\"" + text + "\">" + text.substr(0, 10) + " " + text.substr(11, 8) + " UTC</time>";
}

std::string state_label(const api::Job& job) {
  const std::string state(api::to_string(job.state));
  std::string text = "<span class=\"state " + state + "\">" + state + "</span>";
  // 0.29 · 100 is below 29.
  if (job.state == api::JobState::running)
    text += " " + std::to_string(static_cast<int>(job.fraction * 100 + 1e-9)) + " %";
  return text;
}

Response job_page(Context& context, const Request& request) {
  static constexpr std::array<std::string_view, 1> offers{"text/html"};
  if (!negotiate(request.header("accept"), offers))
    throw api::Problem("not-acceptable", "This page comes as text/html.");
  const api::Job job = find_job(context, request.parameter("id"));
  ordered_json result;
  // A plan that failed its verification has a result, too.
  if (final(job))
    if (const auto text = context.store.open_result(job.id)) result = read_result(*text);
  const std::string title = job.request.name && !job.request.name->empty() ? *job.request.name : "Job " + job.id;
  return tagged_page(request, {.title = title, .body = body(context, job, result), .module = "job"});
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
