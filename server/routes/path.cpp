// GET /v1/jobs/{id}/path and /v1/jobs/{id}/blocks: where the motion goes, and which part of the document takes how
// long.
#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "api/setpoints/path_answer.hpp"
#include "api/setpoints/setpoint_rows.hpp"
#include "api/text/json_text.hpp"
#include "api/text/query_values.hpp"
#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/http/middleware.hpp"
#include "server/routes/blocks.hpp"
#include "server/routes/context.hpp"
#include "server/routes/stored_series.hpp"

namespace bahnwerk::server {
namespace {

Response blocks(Context& context, const Request& request) {
  require_json(request);
  const api::BlockQuery query = api::parse_block_query(request.query);
  const std::string& id = request.parameter("id");
  const api::Job job = require_success(context, id);
  return unless_known(request, content_etag(context, job, "blocks"), [&] {
    const SeriesInfo info = require_views(context, id);
    const api::SetpointSeries series = stored_series(context, info);
    return json_answer(200, blocks_answer(context.store, id, series, require_segments(series, id), query));
  });
}

api::PathRows rows_of(const api::SetpointSeries& series, std::string_view path) {
  const std::vector<Column>& columns = series.columns;
  for (const api::PathColumns& each : api::path_columns(columns))
    if (each.name == path) return {series.count, columns.size(), api::RowVertices(columns, each), series.read};
  throw std::logic_error("a stored path without columns");
}

bool binary(const Request& request, const api::PathQuery& query) {
  static constexpr std::array<std::string_view, 2> offers{"application/json", "application/octet-stream"};
  if (query.binary) return *query.binary;
  const auto chosen = negotiate(request.header("accept"), offers);
  if (!chosen) throw api::Problem("not-acceptable", "A path comes as application/json or application/octet-stream.");
  return *chosen == 1;
}

/// Returns the columns that are asked for beside the coordinates.
std::vector<api::PathColumn> columns_of(const api::PathQuery& query, const api::SetpointSeries& series,
                                        const std::string& id) {
  std::vector<api::PathColumn> columns;
  for (const std::string& name : query.columns) {
    if (name == "v") {
      columns.push_back({name, "mm/s", [](const api::PathVertex& v) { return v.v; }});
    } else if (name == "mode") {
      columns.push_back({name, "1", [](const api::PathVertex& v) { return v.cut ? 1 : 0; }});
    } else if (name == "block") {
      columns.push_back({name, "1", [](const api::PathVertex& v) { return v.block; }});
    } else if (name == "line") {
      const auto table = std::make_shared<const api::SegmentTable>(require_segments(series, id));
      columns.push_back({name, "1", [table, step = series.cycle_time](const api::PathVertex& v) {
                           const auto& all = table->segments;
                           const auto next = std::upper_bound(
                               all.begin(), all.end(), v.row * step,
                               [](double t, const api::PlannedSegment& segment) { return t < segment.start; });
                           return (next == all.begin() ? next : next - 1)->source;
                         }});
    } else if (name == "phi" || name == "psi") {  // where the needle points
      const auto is_it = [&](const Column& column) { return column.name == name; };
      const auto found = std::find_if(series.columns.begin(), series.columns.end(), is_it);
      const auto at = static_cast<std::size_t>(found - series.columns.begin());
      if (found == series.columns.end()) api::refuse_parameter("columns", "this series has no column " + name);
      columns.push_back(
          {name, series.columns[at].unit, [series, at, row = std::vector<double>()](const api::PathVertex& v) mutable {
             series.read(v.row, 1, row);
             return row[at];
           }});
    } else {  // use or limit
      const auto limited = std::make_shared<const api::SetpointSeries>(api::with_limits(series));
      const std::size_t at = limited->columns.size() - (name == "use" ? 2 : 1);
      columns.push_back({name, "1", [limited, at, row = std::vector<double>()](const api::PathVertex& v) mutable {
                           limited->read(v.row, 1, row);
                           return row[at];
                         }});
    }
  }
  return columns;
}

Response path(Context& context, const Request& request) {
  const api::PathQuery query = api::parse_path_query(request.query);
  const bool bytes = binary(request, query);
  const std::string& id = request.parameter("id");
  const api::Job job = require_success(context, id);
  Response response = unless_known(request, content_etag(context, job, bytes ? "path-f32" : "path-json"), [&] {
    const SeriesInfo info = require_views(context, id);
    const api::SetpointSeries series = stored_series(context, info);
    const bool part = query.of == "part";
    const api::StoredPath stored(series.view, part ? "tool" : query.of);
    if (!stored.exists() || (part && !series.pose_frame))
      throw api::Problem("not-found", "The job " + api::shortened(id) + " has no path of " + query.of + ".");
    const api::ChosenPath chosen = api::choose_path(stored, query, rows_of(series, part ? "tool" : query.of));
    const std::vector<api::PathColumn> columns = columns_of(query, series, id);
    Response answer =
        bytes ? text_answer(200, "application/octet-stream", api::path_f32(chosen, stored.dimension(), columns))
              : text_answer(200, "application/json", api::path_json(chosen, query, stored.dimension(), columns));
    std::string tolerance;
    api::append_number(tolerance, chosen.tolerance);
    answer.set("X-Tolerance", tolerance);
    answer.set("X-Columns", api::path_column_names(stored.dimension(), columns));
    return answer;
  });
  response.set("Vary", "Accept");
  return response;
}

}  // namespace

void add_path_routes(Router& router, Context& context) {
  const auto tag = [&context](const char* what) {
    return [&context, what](const Request&, const api::Job& job) {
      return job.state == api::JobState::succeeded ? content_etag(context, job, what) : std::string();
    };
  };
  router.add(
      "GET", "/v1/jobs/{id}/blocks", Access::read,
      scan_unless_known(context, tag("blocks"), [&](const Request& request) { return blocks(context, request); }),
      {"by", "sort", "first", "count"});
  router.add("GET", "/v1/jobs/{id}/path", Access::read,
             scan_unless_known(
                 context,
                 [&context](const Request& request, const api::Job& job) {
                   if (job.state != api::JobState::succeeded) return std::string();
                   const bool bytes = binary(request, api::parse_path_query(request.query));
                   return content_etag(context, job, bytes ? "path-f32" : "path-json");
                 },
                 [&](const Request& request) { return path(context, request); }),
             {"points", "tolerance", "box", "first", "count", "of", "columns", "format"});
}

}  // namespace bahnwerk::server
