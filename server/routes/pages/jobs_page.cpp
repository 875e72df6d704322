#include "server/routes/pages/jobs_page.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "api/kind.hpp"
#include "server/http/answer.hpp"
#include "server/http/key_gate.hpp"
#include "server/http/uri.hpp"
#include "server/pages/assets.hpp"
#include "server/pages/shell.hpp"
#include "server/routes/job_filter.hpp"
#include "server/routes/pages/job_page.hpp"
#include "server/routes/pages/result_html.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::array<std::string_view, 5> states{"queued", "running", "succeeded", "failed", "cancelled"};

struct Listed {
  std::vector<api::Job> jobs;
  std::vector<std::optional<double>> durations;  ///< s, of the planned motion in whole cycles
  std::optional<std::string> next;               ///< cursor of the next page
  std::map<api::JobState, std::size_t> counts;
};

/// Returns the duration of the planned motion; it is known without the result.
std::optional<double> motion_duration(Context& context, const api::Job& job) {
  if (job.state != api::JobState::succeeded) return std::nullopt;
  const auto info = context.store.series(job.id);
  const bool in_time = info && info->count > 0 && info->independent.time();
  return in_time ? std::optional(static_cast<double>(info->count - 1) * info->cycle_time) : std::nullopt;
}

Listed read_list(Context& context, const Request& request) {
  Pairs query = request.query;
  std::erase_if(query, [](const auto& parameter) { return parameter.first == "lang"; });
  JobFilter filter = parse_filter(query);
  filter.owner = sees_only(request);
  const std::size_t limit = filter.limit++;
  Listed listed;
  listed.jobs = context.store.list(filter);
  if (listed.jobs.size() > limit) {
    listed.jobs.pop_back();
    listed.next = listed.jobs.back().id;
  }
  const auto queued = [](const api::Job& job) { return job.state == api::JobState::queued; };
  if (std::any_of(listed.jobs.begin(), listed.jobs.end(), queued)) context.places.look();
  for (auto& job : listed.jobs) {
    context.live.overlay(job);
    listed.durations.push_back(motion_duration(context, job));
  }
  listed.counts = context.store.counts(filter.owner);
  return listed;
}

}  // namespace

Response jobs_data(Context& context, const Request& request) {
  require_json(request);
  const Listed listed = read_list(context, request);
  auto list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < listed.jobs.size(); ++i) {
    auto resource = job_resource(context, listed.jobs[i], request.prefix);
    resource["duration"] =
        listed.durations[i] ? nlohmann::ordered_json(*listed.durations[i]) : nlohmann::ordered_json(nullptr);
    list.push_back(std::move(resource));
  }
  nlohmann::ordered_json counts;
  for (const auto& [state, count] : listed.counts) counts[std::string(api::to_string(state))] = count;
  nlohmann::ordered_json document{{"jobs", std::move(list)}, {"next", nullptr}, {"counts", std::move(counts)}};
  if (listed.next) document["next"] = *listed.next;
  Response response = json_answer(200, document);
  const std::string etag = etag_of(response.body);
  return with_etag(request, etag, std::move(response)).set("Vary", "Cookie");
}

namespace {

std::string parameter(const Request& request, std::string_view name) {
  for (const auto& [key, value] : request.query)
    if (key == name) return value;
  return "";
}

/// Returns the address of the list with another value of a parameter; "" removes it. A cursor stays only where it is
/// set: another filter begins at its first page.
std::string address(const Request& request, std::string_view name, const std::string& value) {
  std::string text;
  const auto add = [&](std::string_view key, const std::string& with) {
    text += (text.empty() ? "/?" : "&") + std::string(key) + "=" + encode_component(with);
  };
  for (const auto& [key, with] : request.query)
    if (key != name && key != "lang" && key != "cursor") add(key, with);
  if (!value.empty()) add(name, value);
  return escape_html(text.empty() ? "/" : text);
}

/// Returns a name of the service's own words, e.g. a kind, in the language of the page.
std::string kind_name(const Texts& text, const std::string& kind) { return text.find("jobs.kind_" + kind, kind); }

std::string chips(const Request& request, const Texts& text, const Listed& listed) {
  std::size_t all = 0;
  for (const auto& [state, count] : listed.counts) all += count;
  const std::string chosen = parameter(request, "state");
  std::string html = "<nav class=\"chips\" id=\"states\" aria-label=\"" + escape_html(text("jobs.by_state")) + "\">";
  const auto chip = [&](const std::string& state, const std::string& label, std::size_t count) {
    html += "<a href=\"" + address(request, "state", state) + "\" data-state=\"" + state + "\"" +
            (state == chosen ? " aria-current=\"true\"" : "") + ">" + escape_html(label) + " <b>" +
            std::to_string(count) + "</b></a> ";
  };
  chip("", text("jobs.all"), all);
  for (const auto state : states) {
    const auto count = listed.counts.find(*api::job_state(state));
    chip(std::string(state), text("jobs.state_" + std::string(state)),
         count == listed.counts.end() ? 0 : count->second);
  }
  return html + "</nav>\n";
}

std::string filter_form(const Request& request, const Texts& text) {
  const auto option = [&](const std::string& value, const std::string& label, const std::string& chosen) {
    return "<option value=\"" + value + "\"" + (value == chosen ? " selected" : "") + ">" + escape_html(label) +
           "</option>";
  };
  std::string html = "<form id=\"filter\" class=\"filter\" method=\"get\" action=\"/\" role=\"search\">";
  for (const char* kept : {"state", "reference", "tag", "created_after", "created_before"})
    if (const std::string value = parameter(request, kept); !value.empty())
      html += "<input type=\"hidden\" name=\"" + std::string(kept) + "\" value=\"" + escape_html(value) + "\">";
  html += "<label><span class=\"visually-hidden\">" + escape_html(text("jobs.search")) +
          "</span><input type=\"search\" name=\"text\" maxlength=\"200\" placeholder=\"" +
          escape_html(text("jobs.search")) + "\" value=\"" + escape_html(parameter(request, "text")) + "\"></label> ";
  html += "<label><span class=\"visually-hidden\">" + escape_html(text("jobs.kind")) + "</span><select name=\"kind\">" +
          option("", text("jobs.all_kinds"), "");
  for (const api::Kind& kind : api::kinds())
    html += option(std::string(kind.name), kind_name(text, std::string(kind.name)), parameter(request, "kind"));
  html += "</select></label> <label><span class=\"visually-hidden\">" + escape_html(text("jobs.order")) +
          "</span><select name=\"sort\">" + option("", text("jobs.newest"), "") +
          option("oldest", text("jobs.oldest"), parameter(request, "sort")) + "</select></label> <button>" +
          escape_html(text("jobs.show")) + "</button></form>\n";
  return html;
}

std::string state_cell(Context& context, const Texts& text, const api::Job& job) {
  const std::string state(api::to_string(job.state));
  std::string html = "<span class=\"state " + state + "\">" + escape_html(text("jobs.state_" + state)) + "</span>";
  if (job.state == api::JobState::running) {
    const std::string percent = std::to_string(static_cast<int>(job.fraction * 100 + 1e-9));
    html += " <progress max=\"100\" value=\"" + percent + "\" aria-label=\"" + escape_html(text("jobs.progress")) +
            "\"></progress> " + percent + " %";
  }
  if (job.state == api::JobState::queued)
    if (const auto ahead = context.places.ahead(job.id))
      html += " <span class=\"soft\">" +
              escape_html(*ahead == 0 ? text("jobs.is_next") : text("jobs.ahead", {{"n", std::to_string(*ahead)}})) +
              "</span>";
  return html;
}

std::string row(Context& context, const Texts& text, const api::Job& job, const std::optional<double>& duration) {
  const std::string name = job.request.name.value_or("");
  std::string html =
      "<tr data-id=\"" + job.id + "\"><td class=\"tick\"></td><th scope=\"row\"><a href=\"/jobs/" + job.id + "\">";
  html += name.empty() ? "<code>" + job.id + "</code>" : "<bdi>" + escape_html(name) + "</bdi>";
  html += "</a></th><td class=\"kind\">" + escape_html(kind_name(text, job.request.kind)) +
          "</td><td class=\"reference\"><bdi>" + escape_html(job.request.reference.value_or("")) +
          "</bdi></td><td class=\"status\">" + state_cell(context, text, job) + "</td><td class=\"n duration\">" +
          (duration ? duration_label(*duration, text) : std::string()) + "</td><td class=\"age\">" +
          time_label(job.created_at) + "</td><td class=\"actions\"></td></tr>\n";
  return html;
}

std::string table(Context& context, const Request& request, const Texts& text, const Listed& listed) {
  const auto head = [&](const char* key, const char* classes = "") {
    return "<th scope=\"col\"" + std::string(*classes ? " class=\"" + std::string(classes) + "\"" : "") + ">" +
           escape_html(text(key)) + "</th>";
  };
  std::string html = "<div id=\"list\"><table class=\"jobs\"><thead><tr><td class=\"tick\"></td>" + head("jobs.job") +
                     head("jobs.kind") + head("jobs.reference") + head("jobs.state") + head("jobs.duration", "n") +
                     head("jobs.posted") + "<td class=\"actions\"></td></tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < listed.jobs.size(); ++i) html += row(context, text, listed.jobs[i], listed.durations[i]);
  html += "</tbody></table></div>\n";
  html += "<p id=\"none\"" + std::string(listed.jobs.empty() ? "" : " hidden") + ">" + escape_html(text("jobs.none")) +
          " <a href=\"/\">" + escape_html(text("jobs.show_all")) + "</a></p>\n";
  html += "<p id=\"more\">";
  if (!parameter(request, "cursor").empty())
    html += "<a href=\"" + address(request, "cursor", "") + "\">" + escape_html(text("jobs.first_page")) + "</a> ";
  if (listed.next)
    html += "<a rel=\"next\" href=\"" + address(request, "cursor", *listed.next) + "\">" +
            escape_html(text("jobs.next_page")) + "</a>";
  return html + "</p>\n";
}

/// What somebody sees who has just installed the service: what it is, and one click to a first plan.
std::string first_open(const Request& request, const Texts& text) {
  struct Card {
    const char *kind, *example;
  };
  static constexpr std::array<Card, 5> cards{{{"contour", "bracket"},
                                              {"motion_law", "radial_cam"},
                                              {"winding", "rotor_coil"},
                                              {"fill_factor", "stator_slot"},
                                              {"probe_path", "probe_profile"}}};
  std::string html =
      "<div id=\"first\"><p class=\"lead\">" + escape_html(text("jobs.what_it_is")) + "</p>\n<div class=\"cards\">\n";
  for (const Card& card : cards) {
    const std::string kind = card.kind;
    html += "<article class=\"card\"><img class=\"picture\" alt=\"\" width=\"240\" height=\"130\" src=\"" +
            asset_address(kind + ".svg") + "\"><h2>" + escape_html(kind_name(text, kind)) + "</h2><p>" +
            escape_html(text("jobs.says_" + kind)) + "</p><p><button class=\"primary\" data-example=\"" + card.example +
            "\">" + escape_html(text("jobs.plan_example")) + "</button></p></article>\n";
  }
  const std::string scheme = request.secure ? "https://" : "http://";
  const std::string curl = "curl -H 'Content-Type: application/json' --data-binary @job.json " + scheme +
                           request.authority + request.prefix + "/v1/jobs";
  html += "</div>\n<h2>" + escape_html(text("jobs.own")) + "</h2>\n<div id=\"drop\" class=\"drop\"><p>" +
          escape_html(text("jobs.drop")) + "</p><p><a href=\"/new\">" + escape_html(text("jobs.to_form")) +
          "</a></p></div>\n<h2>" + escape_html(text("jobs.by_program")) +
          "</h2>\n<p class=\"copy\"><code id=\"curl\">" + escape_html(curl) +
          "</code></p>\n<p class=\"soft\"><a href=\"/openapi.json\">OpenAPI</a> · <a "
          "href=\"/v1/examples\">" +
          escape_html(text("jobs.examples")) + "</a> · <a href=\"/v1/kinds\">" + escape_html(text("jobs.kinds")) +
          "</a></p></div>\n";
  return html;
}

}  // namespace

Response jobs_page(Context& context, const Request& request) {
  require_page(request);
  const Texts text(language_of(request));
  const Listed listed = read_list(context, request);
  const bool any =
      std::any_of(listed.counts.begin(), listed.counts.end(), [](const auto& each) { return each.second > 0; });
  const bool plain = std::all_of(request.query.begin(), request.query.end(),
                                 [](const auto& parameter) { return parameter.first == "lang"; });
  std::string body;
  if (!any && plain)
    body = first_open(request, text);
  else
    body = chips(request, text, listed) + filter_form(request, text) + "<div id=\"bulk\"></div>\n" +
           table(context, request, text, listed);
  return tagged_page(
      request, {.title = "Bahnwerk",
                .body = body,
                .module = "jobs",
                .heading = "<h1>" + escape_html(text(!any && plain ? "jobs.welcome" : "shell.jobs")) + "</h1>\n"});
}

}  // namespace bahnwerk::server
