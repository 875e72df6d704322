// GET /v1/jobs/{id}/path and /v1/jobs/{id}/blocks: where the motion goes, and which part of the document takes how
// long.
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>

#include "api/problem.hpp"
#include "api/text/json_member.hpp"
#include "api/text/pointer.hpp"
#include "api/views/block_list.hpp"
#include "api/views/path_answer.hpp"
#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/http/middleware.hpp"
#include "server/routes/context.hpp"
#include "server/routes/stored_views.hpp"

namespace bahnwerk::server {
namespace {

/// Texts of lines of the job's program, which is read up to the last of them.
class ProgramLines {
 public:
  ProgramLines(Store& store, const std::string& id, const std::set<std::size_t>& lines) {
    const auto document = store.open_document(id);
    if (!document || lines.empty()) return;
    api::JsonMember member({"spec", "contour", "gcode"});
    std::string piece, text;
    while (number_ <= *lines.rbegin() && !member.ended() && document->next(piece)) {
      member.take(piece, text);
      piece.clear();
      take(text, lines);
      text.clear();
    }
    end_line(lines);
  }
  std::string operator()(std::size_t line) const {
    const auto at = texts_.find(line);
    return at == texts_.end() ? "" : at->second;
  }

 private:
  static constexpr std::size_t longest = 200;  // bytes of a line that are shown

  void take(std::string_view text, const std::set<std::size_t>& lines) {
    for (const char c : text) {
      if (c == '\n' && after_return_) {  // CR LF ends one line
        after_return_ = false;
        continue;
      }
      after_return_ = c == '\r';
      if (c == '\n' || c == '\r')
        end_line(lines);
      else if (line_.size() < longest)
        line_ += c;
    }
  }
  void end_line(const std::set<std::size_t>& lines) {
    if (lines.contains(number_)) texts_[number_] = line_;
    line_.clear();
    ++number_;
  }

  std::map<std::size_t, std::string> texts_;
  std::string line_;
  std::size_t number_ = 1;
  bool after_return_ = false;
};

api::SegmentTable segments_of(const StoredViews& views, const std::string& id) {
  auto table = api::read_segments(views.read);
  if (!table)
    throw api::Problem("not-found", "The job " + api::shortened(id) +
                                        " has no blocks: contours have them, since the version that stores them.");
  return std::move(*table);
}

Response blocks(Context& context, const Request& request) {
  require_json(request);
  const api::BlockQuery query = api::parse_block_query(request.query);
  const std::string& id = request.parameter("id");
  const api::Job job = require_success(context, id);
  return unless_known(request, content_etag(context, job, "blocks"), [&] {
    const api::SegmentTable table = segments_of(stored_views(context, id), id);
    const std::vector<api::ListedBlock> list = api::list_blocks(table, query.by, query.sort);
    std::set<std::size_t> lines;
    for (std::size_t i = query.first; i < list.size() && i - query.first < query.count; ++i)
      lines.insert(list[i].source);
    std::optional<ProgramLines> program;
    if (table.program) program.emplace(context.store, id, lines);
    const auto text = [&](std::size_t line) { return program ? (*program)(line) : std::string(); };
    return json_answer(200, api::blocks_document(table, query, list, {text}));
  });
}

api::PathRows rows_of(const StoredViews& views, std::string_view path) {
  const std::vector<Column>& columns = views.series.columns;
  for (const api::PathColumns& each : api::path_columns(columns))
    if (each.name == path) return {views.series.count, columns.size(), api::RowVertices(columns, each), views.rows};
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
std::vector<api::PathColumn> columns_of(const api::PathQuery& query, const StoredViews& views, const std::string& id) {
  std::vector<api::PathColumn> columns;
  for (const std::string& name : query.columns) {
    if (name == "v") {
      columns.push_back({name, "mm/s", [](const api::PathVertex& v) { return v.v; }});
    } else if (name == "mode") {
      columns.push_back({name, "1", [](const api::PathVertex& v) { return v.cut ? 1 : 0; }});
    } else if (name == "block") {
      columns.push_back({name, "1", [](const api::PathVertex& v) { return v.block; }});
    } else if (name == "line") {
      const auto table = std::make_shared<const api::SegmentTable>(segments_of(views, id));
      columns.push_back({name, "1", [table, step = views.series.cycle_time](const api::PathVertex& v) {
                           const auto& all = table->segments;
                           const auto next = std::upper_bound(
                               all.begin(), all.end(), v.row * step,
                               [](double t, const api::PlannedSegment& segment) { return t < segment.start; });
                           return (next == all.begin() ? next : next - 1)->source;
                         }});
    } else {
      const std::string message = name + " is not available for a path";
      throw api::Problem("schema-violation", "/query/columns: " + message, {{"/query/columns", message}});
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
    const StoredViews views = stored_views(context, id);
    const bool part = query.of == "part";
    const api::StoredPath stored(views.read, part ? "tool" : query.of);
    if (!stored.exists() || (part && !views.series.pose_frame))
      throw api::Problem("not-found", "The job " + api::shortened(id) + " has no path of " + query.of + ".");
    const api::ChosenPath chosen = api::choose_path(stored, query, rows_of(views, part ? "tool" : query.of));
    const std::vector<api::PathColumn> columns = columns_of(query, views, id);
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
