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
#include "api/setpoints/setpoint_rows.hpp"
#include "api/text/json_member.hpp"
#include "api/text/pointer.hpp"
#include "api/views/block_list.hpp"
#include "api/views/path_answer.hpp"
#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/http/middleware.hpp"
#include "server/routes/context.hpp"
#include "server/routes/stored_series.hpp"

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

api::SegmentTable segments_of(const api::SetpointSeries& series, const std::string& id) {
  auto table = api::read_segments(series.view);
  if (!table)
    throw api::Problem("not-found", "The job " + api::shortened(id) +
                                        " has no blocks: contours have them, since the version that stores them.");
  return std::move(*table);
}

using Intervals = std::vector<std::pair<double, double>>;

/// Returns the limit to which most cycles that begin in the intervals belong; of an interval without one, the cycle in
/// which it lies.
api::MainLimit main_limit(api::LimitsReader& limits, const api::SetpointSeries& series, const Intervals& intervals) {
  api::LimitsReader::Counts sum(limits.numbers());
  std::uint64_t all = 0;
  const auto cycle = [&](double time, double rounding) {
    return std::min(static_cast<std::size_t>(std::max(0.0, time / series.cycle_time + rounding)), series.count - 1);
  };
  for (const auto& [begin, end] : intervals) {
    std::size_t from = cycle(begin, 1 - 1e-6), to = cycle(end, 1 - 1e-6);
    if (from >= to) to = (from = cycle(begin, 1e-6)) + 1;
    const api::LimitsReader::Counts counts = limits.count(from, to);
    for (std::size_t number = 0; number < counts.size(); ++number) {
      sum[number] += counts[number];
      all += counts[number];
    }
  }
  if (all == 0) return {};
  const std::size_t most = api::most_frequent(sum);
  return {limits.name(most), static_cast<double>(sum[most]) / static_cast<double>(all)};
}

Response blocks(Context& context, const Request& request) {
  require_json(request);
  const api::BlockQuery query = api::parse_block_query(request.query);
  const std::string& id = request.parameter("id");
  const api::Job job = require_success(context, id);
  return unless_known(request, content_etag(context, job, "blocks"), [&] {
    const SeriesInfo info = require_views(context, id);
    const api::SetpointSeries series = stored_series(context.store, info);
    const api::SegmentTable table = segments_of(series, id);
    const std::vector<api::ListedBlock> list = api::list_blocks(table, query.by, query.sort);
    std::set<std::size_t> lines;
    for (std::size_t i = query.first; i < list.size() && i - query.first < query.count; ++i)
      lines.insert(list[i].source);
    std::optional<ProgramLines> program;
    if (table.program) program.emplace(context.store, id, lines);
    const auto text = [&](std::size_t line) { return program ? (*program)(line) : std::string(); };
    api::LimitsReader limits(series.view, series.count);
    const auto limit = [&](const Intervals& intervals) { return main_limit(limits, series, intervals); };
    return json_answer(200, api::blocks_document(table, query, list, {text, limit}));
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
      const auto table = std::make_shared<const api::SegmentTable>(segments_of(series, id));
      columns.push_back({name, "1", [table, step = series.cycle_time](const api::PathVertex& v) {
                           const auto& all = table->segments;
                           const auto next = std::upper_bound(
                               all.begin(), all.end(), v.row * step,
                               [](double t, const api::PlannedSegment& segment) { return t < segment.start; });
                           return (next == all.begin() ? next : next - 1)->source;
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
    const api::SetpointSeries series = stored_series(context.store, info);
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
