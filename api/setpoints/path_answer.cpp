#include "api/setpoints/path_answer.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "api/setpoints/setpoints.hpp"
#include "api/text/json_text.hpp"
#include "api/text/query_values.hpp"
#include "api/views/bytes.hpp"
#include "api/views/open_chord.hpp"

namespace bahnwerk::api {
namespace {

constexpr std::array axes{"x", "y", "z"};
constexpr std::array<std::string_view, 8> column_names{"v", "limit", "mode", "block", "line", "use", "phi", "psi"};
constexpr std::size_t default_points = 2000;
constexpr std::size_t candidates = 16;  // vertices that are read for each one that is asked for
constexpr std::size_t rows_each = 2;    // rows that are read for each vertex that is asked for

/// Returns what a value was read as; refuses the parameter if it could not be read.
template <class T>
T read_as(const std::string& name, const std::optional<T>& value, const char* what) {
  if (!value) refuse_parameter(name, what);
  return *value;
}

PathBox box_of(const std::string& text) {
  const auto parts = split(text);
  constexpr const char* form = "must be x0,y0,x1,y1 in mm, the lower corner first";
  if (parts.size() != 4) refuse_parameter("box", form);
  std::array<double, 4> v{};
  for (std::size_t i = 0; i < 4; ++i) v[i] = read_as("box", real(parts[i]), form);
  if (!(v[0] <= v[2] && v[1] <= v[3])) refuse_parameter("box", form);
  return {v[0], v[1], v[2], v[3]};
}

std::vector<std::string> columns_of(const std::string& text) {
  std::vector<std::string> list;
  for (std::string& name : split(text)) {
    if (std::find(column_names.begin(), column_names.end(), name) == column_names.end())
      refuse_parameter("columns", "must be a list of v, limit, mode, block, line, use, phi, psi");
    list.push_back(std::move(name));
  }
  return list;
}

Vec at(const PathVertex& vertex) { return {vertex.at[0], vertex.at[1], vertex.at[2]}; }

std::size_t size_of(const std::vector<StoredPath::Run>& runs) {
  std::size_t count = 0;
  for (const auto& run : runs) count += run.size();
  return count;
}

/// Returns the number of chords before one of another mode.
std::size_t mode_changes(const std::vector<StoredPath::Run>& runs) {
  std::size_t count = 0;
  for (const auto& run : runs)
    for (std::size_t i = 2; i < run.size(); ++i) count += run[i].cut != run[i - 1].cut;
  return count;
}

StoredPath::Run thinned_run(const StoredPath::Run& run, double tolerance, bool planar, bool modes) {
  StoredPath::Run out;
  OpenChord chord(tolerance, planar, modes);
  for (const PathVertex& each : run)
    if (const auto vertex = chord.take({each, at(each)})) out.push_back(vertex->vertex);
  if (const auto vertex = chord.finish()) out.push_back(vertex->vertex);
  return out;
}

std::vector<StoredPath::Run> thinned_runs(const std::vector<StoredPath::Run>& runs, double tolerance, bool planar,
                                          bool modes) {
  std::vector<StoredPath::Run> out;
  for (const auto& run : runs) out.push_back(thinned_run(run, tolerance, planar, modes));
  return out;
}

/// Returns the part of [first, end) that a run spans.
std::pair<std::size_t, std::size_t> span_of(const StoredPath::Run& run, std::size_t first, std::size_t end) {
  return {std::max<std::size_t>(run.front().row, first), std::min<std::size_t>(run.back().row + 1, end)};
}

std::size_t rows_of(const std::vector<StoredPath::Run>& runs, std::size_t first, std::size_t end) {
  std::size_t count = 0;
  for (const auto& run : runs) {
    const auto [from, to] = span_of(run, first, end);
    count += to > from ? to - from : 0;
  }
  return count;
}

/// Returns the rows of the runs, thinned within a tolerance.
std::vector<StoredPath::Run> from_rows(const std::vector<StoredPath::Run>& runs, const PathRows& rows,
                                       std::size_t first, std::size_t end, double tolerance, bool planar) {
  constexpr std::size_t most_vertices = 2'000'000, rows_at_once = 4096;
  std::vector<StoredPath::Run> out;
  std::vector<double> values;
  std::size_t count = 0;
  for (const auto& run : runs) {
    const auto [from, to] = span_of(run, first, end);
    if (to <= from) continue;
    StoredPath::Run& line = out.emplace_back();
    OpenChord chord(tolerance, planar);
    Vec at;
    for (std::size_t k = from; k < to; k += rows_at_once) {
      const std::size_t part = std::min(rows_at_once, to - k);
      rows.read(k, part, values);
      for (std::size_t i = 0; i < part; ++i) {
        const PathVertex row = rows.vertex(k + i, values.data() + i * rows.width, at);
        if (const auto vertex = chord.take({row, at})) line.push_back(vertex->vertex);
      }
      if (count + line.size() > most_vertices)
        refuse_parameter("tolerance", "needs more than 2000000 vertices: widen it, or narrow the box or the rows");
    }
    if (const auto vertex = chord.finish()) line.push_back(vertex->vertex);
    count += line.size();
  }
  return out;
}

/// Returns the largest error of a coordinate in single precision, as a distance.
double rounding(const std::vector<StoredPath::Run>& runs) {
  float largest = 0;
  for (const auto& run : runs)
    for (const PathVertex& v : run)
      for (const float c : v.at) largest = std::max(largest, std::abs(c));
  return largest * 0x1p-24 * std::sqrt(3.0);
}

/// Calls visit(vertex, begin) for every vertex.
template <class Visit>
void for_each_vertex(const ChosenPath& path, const Visit& visit) {
  for (const auto& run : path.runs)
    for (std::size_t i = 0; i < run.size(); ++i) visit(run[i], i == 0);
}

}  // namespace

PathQuery parse_path_query(const std::vector<std::pair<std::string, std::string>>& query) {
  PathQuery out;
  constexpr const char* whole = "must be a whole number";
  for (const auto& [name, value] : query) {
    if (name == "points") out.points = read_as(name, natural(value), whole);
    if (name == "tolerance") out.tolerance = read_as(name, real(value), "must be a number, mm");
    if (name == "box") out.box = box_of(value);
    if (name == "first") out.first = read_as(name, natural(value), whole);
    if (name == "count") out.count = read_as(name, natural(value), whole);
    if (name == "of") out.of = value;
    if (name == "columns") out.columns = columns_of(value);
    if (name == "format") out.binary = value == "f32";
    if (name == "format" && value != "f32" && value != "json") refuse_parameter(name, "must be json or f32");
  }
  if (out.of != "tool" && out.of != "coarse" && out.of != "part")
    refuse_parameter("of", "must be tool, coarse or part");
  if (out.points && out.tolerance) refuse_parameter("tolerance", "excludes points");
  if (out.points && (*out.points < 2 || *out.points > PathQuery::most_points))
    refuse_parameter("points", "must be between 2 and 200000");
  if (out.tolerance && *out.tolerance < 0) refuse_parameter("tolerance", "must not be negative");
  if (out.count == std::size_t{0}) refuse_parameter("count", "must be at least 1");
  if (!out.points && !out.tolerance) out.points = default_points;
  return out;
}

ChosenPath choose_path(const StoredPath& path, const PathQuery& query, const PathRows& rows) {
  if (query.first >= rows.count) refuse_parameter("first", "is beyond the last row");
  const std::size_t first = query.first,
                    end = query.count ? first + std::min(*query.count, rows.count - first) : rows.count;
  const bool planar = path.dimension() == 2;
  std::size_t level = path_tolerances.size() - 1;
  if (query.points)
    for (level = 0;
         level + 1 < path_tolerances.size() && path.at_most(level, first, end, query.box) > candidates * *query.points;)
      ++level;
  else
    while (level > 0 && path_tolerances[level] > *query.tolerance) --level;
  ChosenPath chosen;
  std::vector<StoredPath::Run> runs = path.read(level, first, end, query.box);
  double stored = path_tolerances[level];
  if (level == 0 &&
      (query.points ? rows_of(runs, first, end) <= rows_each * *query.points : stored > *query.tolerance)) {
    stored = query.tolerance.value_or(0);
    runs = from_rows(runs, rows, first, end, stored, planar);
  }
  chosen.runs = runs;
  chosen.tolerance = stored;
  if (query.tolerance && *query.tolerance > stored) {
    chosen.runs = thinned_runs(runs, *query.tolerance - stored, planar, true);
    chosen.tolerance = *query.tolerance;
  }
  // A run keeps its ends: where there are many runs, more vertices stay than were asked for.
  const std::size_t most = query.points ? std::max(*query.points, 2 * runs.size()) : size_of(runs);
  // Where few vertices are asked for, both ends of each rapid move do not fit.
  const bool modes = 2 * (mode_changes(runs) + runs.size()) <= most / 2;
  for (double more = std::max(stored / 4, 1e-4); size_of(chosen.runs) > most; more *= 1.2) {
    chosen.runs = thinned_runs(runs, more, planar, modes);
    chosen.tolerance = stored + more;
  }
  chosen.tolerance += rounding(chosen.runs);
  return chosen;
}

std::string path_column_names(std::size_t dimension, const std::vector<PathColumn>& columns) {
  std::string names = "row,begin";
  for (std::size_t k = 0; k < dimension; ++k) names += std::string(",") + axes.at(k);
  for (const PathColumn& column : columns) names += "," + column.name;
  return names;
}

std::string path_json(const ChosenPath& path, const PathQuery& query, std::size_t dimension,
                      const std::vector<PathColumn>& columns) {
  std::string out = "{\"of\":\"" + query.of + "\",\"tolerance\":";
  append_number(out, path.tolerance);
  out += ",\"count\":" + std::to_string(size_of(path.runs)) + ",\"columns\":[";
  std::string values;
  const auto column = [&](const std::string& name, const std::string& unit, const auto& value) {
    const char* const comma = values.empty() ? "" : ",";
    out += comma + ("{\"name\":\"" + name + "\",\"unit\":\"" + unit + "\"}");
    values += comma + ("\"" + name + "\":[");
    bool following = false;
    for_each_vertex(path, [&](const PathVertex& vertex, bool begin) {
      if (following) values += ',';
      following = true;
      value(vertex, begin);
    });
    values += ']';
  };
  const auto append_float = [&](float value) {
    std::array<char, 32> text;
    values.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
  };
  column("row", "1", [&](const PathVertex& v, bool) { values += std::to_string(v.row); });
  column("begin", "1", [&](const PathVertex&, bool begin) { values += begin ? '1' : '0'; });
  for (std::size_t k = 0; k < dimension; ++k)
    column(axes.at(k), "mm", [&](const PathVertex& v, bool) { append_float(v.at[k]); });
  for (const PathColumn& each : columns)
    column(each.name, each.unit, [&](const PathVertex& v, bool) { append_float(static_cast<float>(each.value(v))); });
  return out + "],\"values\":{" + values + "}}";
}

std::string path_f32(const ChosenPath& path, std::size_t dimension, const std::vector<PathColumn>& columns) {
  std::string out;
  out.reserve(size_of(path.runs) * 4 * (2 + dimension + columns.size()));
  for_each_vertex(path, [&](const PathVertex& vertex, bool begin) {
    put(out, vertex.row);
    put(out, begin ? 1.0F : 0.0F);
    for (std::size_t k = 0; k < dimension; ++k) put(out, vertex.at[k]);
    for (const PathColumn& column : columns) put(out, static_cast<float>(column.value(vertex)));
  });
  return out;
}

}  // namespace bahnwerk::api
