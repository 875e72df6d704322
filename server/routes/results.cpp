#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "api/result_files.hpp"
#include "api/setpoints/setpoints.hpp"
#include "api/text/query_values.hpp"
#include "server/http/answer.hpp"
#include "server/http/middleware.hpp"
#include "server/routes/stored_document.hpp"
#include "server/routes/stored_series.hpp"

namespace bahnwerk::server {
namespace {

/// Returns the names of `parts`; empty: the whole result. Throws Problem schema-violation for what is no list of names.
std::vector<std::string> asked_parts(const Request& request) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : request.query)
    if (name == "parts")
      for (std::string& part : api::split(value)) parts.push_back(std::move(part));
  const auto faulty = [](const std::string& part) {
    const bool plain = std::all_of(part.begin(), part.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
    });
    return !plain || part.empty() || part.front() == '.' || part.back() == '.' || part.find("..") != part.npos;
  };
  if (parts.size() > 50 || std::any_of(parts.begin(), parts.end(), faulty))
    api::refuse_parameter("parts", "must be at most 50 names of members, such as summary,details.slowest");
  return parts;
}

Response result(Context& context, const Request& request) {
  require_json(request);
  const std::vector<std::string> parts = asked_parts(request);
  const std::string& id = request.parameter("id");
  const api::Job job = require_result(context, id);
  return unless_known(request, content_etag(context, job, "result"), [&] {
    auto document = context.store.open_result(id);
    if (!document) require_success(context, id);  // a failure of an older version
    if (!document)
      throw api::Problem("not-found", "There is no job " + api::shortened(id) + ".");  // the job was deleted in between
    if (!parts.empty()) return text_answer(200, "application/json", read_parts(*document, parts));
    return text_answer("application/json", std::move(document));
  });
}

/// Answers a file that the job's kind makes of its stored result.
Response kind_file(Context& context, const Request& request, const std::string& layout) {
  const std::string& id = request.parameter("id");
  const api::Job job = require_success(context, id);
  return unless_known(request, content_etag(context, job, "table-" + layout), [&] {
    const auto document = context.store.result(id);
    if (!document) throw api::Problem("not-found", "There is no job " + api::shortened(id) + ".");
    const auto result = nlohmann::json::parse(*document);
    api::ResultFile file = api::result_file(result, layout, job.request.name.value_or(""));
    Response response = text_answer(200, file.content_type, std::move(file.text));
    if (!file.header.empty()) response.set(file.header, file.header_value);
    response.set("Content-Disposition", "attachment; filename=\"" + id + "-" + layout + "." + file.extension + "\"");
    return response;
  });
}

Response setpoint_rows(Context& context, const Request& request, const api::SetpointQuery& query,
                       api::SetpointFormat format) {
  const std::string& id = request.parameter("id");
  const auto is_computed = [](const std::string& column) { return column == "use" || column == "limit"; };
  const bool views = query.points || std::any_of(query.columns.begin(), query.columns.end(), is_computed);
  const SeriesInfo info = views ? require_views(context, id) : require_series(context, id);
  const auto stream =
      std::make_shared<api::SetpointStream>(api::SetpointStream(stored_series(context, info), query, format));
  std::string columns;
  for (const Column& column : stream->columns()) columns += (columns.empty() ? "" : ",") + column.name;
  Response response;
  response.set("Content-Type", std::string(api::content_type(format)));
  response.set("X-Columns", columns);
  if (query.format)
    response.set("Content-Disposition",
                 "attachment; filename=\"" + id + "." + std::string(api::format_name(format)) + "\"");
  response.stream = [stream](std::string& piece) { return stream->next(piece); };
  return response;
}

api::SetpointFormat format_of(const Request& request, const api::SetpointQuery& query) {
  const auto format = query.format ? query.format : api::negotiate_setpoints(request.header("accept").value_or(""));
  if (!format)
    throw api::Problem(
        "not-acceptable",
        "Setpoints come as application/json, text/csv, application/x-ndjson or application/octet-stream.");
  return *format;
}

/// Returns the tag of setpoints. A succeeded job never changes: the address, query included, and the format name the
/// bytes.
std::string setpoints_etag(const Context& context, const Request& request, const api::SetpointQuery& query,
                           const api::Job& job) {
  return content_etag(context, job, "setpoints-" + std::string(api::format_name(format_of(request, query))));
}

Response setpoints(Context& context, const Request& request) {
  const api::SetpointQuery query = api::parse_setpoint_query(request.query);
  if (query.file_layout) return kind_file(context, request, *query.file_layout);
  const api::SetpointFormat format = format_of(request, query);
  const api::Job job = require_success(context, request.parameter("id"));
  Response response = unless_known(request, setpoints_etag(context, request, query, job),
                                   [&] { return setpoint_rows(context, request, query, format); });
  response.set("Vary", "Accept");
  return response;
}

}  // namespace

void add_result_routes(Router& router, Context& context) {
  const auto succeeded = [](const api::Job& job) { return job.state == api::JobState::succeeded; };
  router.add("GET", "/v1/jobs/{id}/result", Access::read,
             scan_unless_known(
                 context,
                 [&context, succeeded](const Request&, const api::Job& job) {
                   return succeeded(job) ? content_etag(context, job, "result") : std::string();
                 },
                 [&](const Request& request) { return result(context, request); }),
             {"parts"});
  router.add("GET", "/v1/jobs/{id}/setpoints", Access::read,
             scan_unless_known(
                 context,
                 [&context, succeeded](const Request& request, const api::Job& job) {
                   const api::SetpointQuery query = api::parse_setpoint_query(request.query);
                   if (query.file_layout || !succeeded(job)) return std::string();
                   return setpoints_etag(context, request, query, job);
                 },
                 [&](const Request& request) { return setpoints(context, request); }),
             {"first", "count", "every", "columns", "points", "format", "layout", "frame"});
}

}  // namespace bahnwerk::server
