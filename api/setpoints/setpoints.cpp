#include "api/setpoints/setpoints.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "api/setpoints/setpoint_rows.hpp"
#include "api/text/json_text.hpp"
#include "api/text/query_values.hpp"
#include "core/base/read_rows.hpp"

namespace bahnwerk::api {
namespace {

constexpr std::size_t piece_size = 64 * 1024;

std::string text(std::string_view value) {
  return nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Writes a field by RFC 4180, with quotes only where needed.
std::string csv_field(const std::string& name) {
  if (name.find_first_of(",;\"\r\n") == name.npos) return name;
  std::string field = "\"";
  for (char c : name) field.append(c == '"' ? 2 : 1, c);
  return field + '"';
}

template <class Bits>
void append_bits(std::string& out, Bits bits) {
  for (std::size_t i = 0; i < sizeof bits; ++i, bits >>= 8) out += static_cast<char>(bits & 0xFF);
}

/// Returns the names of the columns that a layout has for a group of drives if no columns are requested; none: all.
std::vector<std::string> columns_of(const SetpointSeries& series, CsvLayout layout, DriveGroup group) {
  std::vector<std::string> names;
  const auto has = [&](const std::string& name) { return column_index(series.columns, name) < series.columns.size(); };
  const auto in_group = [&](const std::string& name) {
    if (group == DriveGroup::all) return true;
    const char stage = group == DriveGroup::coarse ? 'c' : 'f';
    return name.size() > 1 && name.back() == stage && has(name.substr(0, name.size() - 1));
  };
  if (layout == CsvLayout::plain && group == DriveGroup::all) return names;
  if (layout != CsvLayout::twincat_poses) {
    for (const Column& c : series.columns)
      if (has("v" + c.name) && has("a" + c.name) && in_group(c.name)) names.push_back(c.name);
  } else {
    for (const char* name : {"x", "y", "z", "phi", "psi"})
      if (has(name) && has(std::string("v") + name) && in_group(name)) names.push_back(name);
  }
  if (names.empty() && group != DriveGroup::all)
    refuse_parameter("group", "this series has no axes of that group of drives");
  if (names.empty()) refuse_parameter("layout", "this series has no columns of that layout; name some by columns");
  const std::size_t positions = names.size();
  for (std::size_t k = 0; k < positions; ++k) names.push_back("v" + names[k]);
  for (std::size_t k = 0; k < positions && layout == CsvLayout::plain; ++k) names.push_back("a" + names[k]);
  for (const char* name : {"brake", "base_frame", "part_frame", "mode", "block"})
    if (has(name)) names.push_back(name);
  return names;
}

/// Throws if the delay is not a whole number of cycles.
std::size_t rows_of(double delay, double cycle_time) {
  if (delay == 0) return 0;
  const double cycles = delay / cycle_time, whole = std::round(cycles);
  if (!(std::abs(cycles - whole) <= 1e-6 * std::fmax(1, whole)))
    refuse_parameter("delay", "must be whole cycles of " + nlohmann::json(cycle_time).dump() + " s");
  return static_cast<std::size_t>(whole);
}

std::vector<std::size_t> select(const SetpointSeries& series, const std::vector<std::string>& names) {
  std::vector<std::size_t> selected;
  if (names.empty())
    for (std::size_t c = 0; c < series.columns.size(); ++c) selected.push_back(c);
  for (const auto& name : names) {
    const std::size_t c = column_index(series.columns, name);
    if (c == series.columns.size()) {
      std::string known;
      for (const auto& column : series.columns) known += (known.empty() ? "" : ", ") + column.name;
      refuse_parameter("columns", "no column " + in_quotes(name) + "; there are " + known);
    }
    selected.push_back(c);
  }
  return selected;
}

}  // namespace

struct SetpointStream::State {
  SetpointSeries series;
  SetpointFormat format;
  const char *separator = ",", *line_end = "\n";  // separators of CSV
  std::vector<std::size_t> selected;
  std::vector<Column> answered;
  std::size_t first = 0, every = 1, rows = 0;
  RowCursor cursor{series, 0, 1, 0};

  // JSON: array k holds column selected[k] and is preceded by its opening text. Others: text before each value of a
  // row.
  std::vector<std::string> opening;
  std::string head, tail;
  std::size_t array = 0;
  bool headed = false, in_array = false, comma = false, done = false;

  void prepare_json(std::size_t spanned, bool is_envelope);
  void prepare_rows();
  bool json_step(std::string& out, std::size_t limit);
  bool row_step(std::string& out);
};

void SetpointStream::State::prepare_json(std::size_t spanned, bool is_envelope) {
  const auto integer = [&](const char* name, std::size_t value) {
    head += (head.empty() ? "{\"" : ",\"") + std::string(name) + "\":" + std::to_string(value);
  };
  integer("first", first);
  if (is_envelope) {
    integer("count", spanned);
    integer("points", rows);
  } else {
    integer("every", every);
    integer("count", rows);
  }
  head += ",\"cycle_time\":";
  append_number(head, series.cycle_time);
  if (const Independent& over = series.independent; !over.time()) {
    head += ",\"independent\":{\"name\":" + text(over.name) + ",\"unit\":" + text(over.unit) + ",\"step\":";
    append_number(head, over.step);
    head += '}';
  }
  const auto column = [&](std::size_t k, std::size_t suffix) {
    const auto& name = answered[k].name;
    return "{\"name\":" + text(std::string_view(name).substr(0, name.size() - suffix)) +
           ",\"unit\":" + text(answered[k].unit);
  };
  if (is_envelope) {
    opening.push_back(",\"index\":[");
    for (std::size_t k = 1; k < answered.size(); k += 2) {
      opening.push_back((k == 1 ? "],\"columns\":[" : "]},") + column(k, 4) + ",\"min\":[");
      opening.push_back("],\"max\":[");
    }
  } else {
    for (std::size_t k = 0; k < answered.size(); ++k)
      opening.push_back((k == 0 ? ",\"columns\":[" : "]},") + column(k, 0) + ",\"values\":[");
  }
  tail = "]}]}\n";
}

void SetpointStream::State::prepare_rows() {
  for (std::size_t k = 0; k < answered.size(); ++k) {
    if (format == SetpointFormat::csv) {
      head += (k ? separator : "") + csv_field(answered[k].name);
      opening.push_back(k ? separator : "");
    } else if (format == SetpointFormat::ndjson) {
      opening.push_back((k ? "," : "{") + text(answered[k].name) + ":");
    }
  }
  if (format == SetpointFormat::csv) head += line_end;
}

/// Writes column after column and reads the series once per column, so that it is never in memory as a whole.
bool SetpointStream::State::json_step(std::string& out, std::size_t limit) {
  if (array == opening.size()) {
    out += tail;
    return false;
  }
  if (!in_array) {
    out += opening[array];
    cursor.rewind();
    in_array = true;
    comma = false;
  }
  while (out.size() < limit) {
    const double* row = cursor.next();
    if (!row) {
      in_array = false;
      ++array;
      break;
    }
    if (comma) out += ',';
    comma = true;
    append_number(out, row[selected[array]]);
  }
  return true;
}

bool SetpointStream::State::row_step(std::string& out) {
  const double* row = cursor.next();
  if (!row) return false;
  for (std::size_t k = 0; k < selected.size(); ++k) {
    if (format == SetpointFormat::f64) {
      append_bits(out, std::bit_cast<std::uint64_t>(row[selected[k]]));
    } else if (format == SetpointFormat::f32) {
      append_bits(out, std::bit_cast<std::uint32_t>(static_cast<float>(row[selected[k]])));
    } else {
      out += opening[k];
      append_number(out, row[selected[k]]);
    }
  }
  if (format == SetpointFormat::csv) out += line_end;
  if (format == SetpointFormat::ndjson) out += "}\n";
  return true;
}

SetpointStream::SetpointStream(SetpointSeries series, SetpointQuery query, SetpointFormat format)
    : state_(std::make_unique<State>()) {
  auto& s = *state_;
  if (query.delay > 0 && !series.independent.time())
    refuse_parameter("delay",
                     "this series is over " + series.independent.name + ", not over time: its rows cannot wait");
  const std::size_t waiting = rows_of(query.delay, series.cycle_time);
  const auto asks_for = [&](const char* name) {
    return std::find(query.columns.begin(), query.columns.end(), name) != query.columns.end() &&
           column_index(series.columns, name) == series.columns.size();
  };
  if (series.view && waiting == 0 && (asks_for("use") || asks_for("limit"))) series = with_limits(std::move(series));
  series = delayed(std::move(series), waiting);
  if (query.first > series.count)
    refuse_parameter("first", "row " + std::to_string(query.first) + " is beyond the series of " +
                                  std::to_string(series.count) + " rows");
  if (query.every == 0) refuse_parameter("every", "must be at least 1");
  const bool poses = query.layout == CsvLayout::twincat_poses;
  if (query.frame == SetpointFrame::base && !series.pose_frame)
    refuse_parameter("frame", "the machine's frame is not known: this series has poses of the part alone");
  const bool base = query.frame ? *query.frame == SetpointFrame::base : poses && series.pose_frame;
  if (base) series = in_base_frame(std::move(series));
  if (poses && query.columns.empty() && series.pose_frame)
    series = with_mark(std::move(series), base ? "base_frame" : "part_frame");
  if (query.layout != CsvLayout::plain) {
    if (format != SetpointFormat::csv) refuse_parameter("layout", "is one of CSV: ask for text/csv or format=csv");
    s.separator = ";", s.line_end = "\r\n";
  }
  if (query.columns.empty()) query.columns = columns_of(series, query.layout, query.group);
  const std::size_t rest = series.count - query.first;
  const std::size_t spanned = query.count ? std::min(*query.count, rest) : rest;
  s.selected = select(series, query.columns);
  s.format = format;
  s.first = query.first;
  s.every = query.every;
  if (query.points) {
    s.series = envelope(std::move(series), query.first, spanned, *query.points, std::move(s.selected));
    s.selected = select(s.series, {});
    s.rows = s.series.count;
    s.every = 1;
    s.cursor = RowCursor(s.series, 0, 1, s.rows);
  } else {
    s.series = std::move(series);
    s.rows = spanned == 0 ? 0 : 1 + (spanned - 1) / query.every;
    s.cursor = RowCursor(s.series, query.first, query.every, s.rows);
  }
  for (std::size_t c : s.selected) s.answered.push_back(s.series.columns[c]);
  if (format == SetpointFormat::json)
    s.prepare_json(spanned, query.points.has_value());
  else
    s.prepare_rows();
}

SetpointStream::~SetpointStream() = default;
SetpointStream::SetpointStream(SetpointStream&&) noexcept = default;

bool SetpointStream::next(std::string& out) {
  auto& s = *state_;
  if (s.done) return false;
  const std::size_t begin = out.size(), limit = begin + piece_size;
  if (!s.headed) out += s.head;
  s.headed = true;
  while (out.size() < limit && !s.done)
    s.done = s.format == SetpointFormat::json ? !s.json_step(out, limit) : !s.row_step(out);
  return out.size() != begin;
}

const std::vector<Column>& SetpointStream::columns() const { return state_->answered; }

}  // namespace bahnwerk::api
