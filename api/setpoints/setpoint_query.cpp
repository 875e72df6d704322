// The query string of GET /v1/jobs/{id}/setpoints.
#include <algorithm>
#include <stdexcept>

#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "api/result_files.hpp"
#include "api/setpoints/setpoints.hpp"
#include "api/text/query_values.hpp"

namespace bahnwerk::api {
namespace {

constexpr double max_delay = 60;            // s
constexpr std::size_t max_points = 20'000;  // an envelope is held in memory: 20 000 points of 12 columns are 4 MB

}  // namespace

SetpointQuery parse_setpoint_query(const std::vector<std::pair<std::string, std::string>>& query) {
  SetpointQuery result;
  std::vector<FieldError> errors;
  std::vector<std::string> seen;
  bool every_given = false, csv = false;
  for (const auto& [key, value] : query) {
    const auto fault = [&, &name = key](std::string message) {
      errors.push_back({pointer("/query", {name.substr(0, 100)}), std::move(message)});
    };
    if (std::find(seen.begin(), seen.end(), key) != seen.end()) {
      fault("given more than once");
      continue;
    }
    seen.push_back(key);
    if (key == "columns") {
      result.columns = split(value);
      for (auto column = result.columns.begin(); column != result.columns.end(); ++column) {
        if (column->empty()) {
          fault("a column name is empty");
          break;
        }
        if (std::find(result.columns.begin(), column, *column) != column) {
          fault("column " + in_quotes(*column) + " is named twice");
          break;
        }
      }
      continue;
    }
    if (key == "format") {
      for (const auto format : {SetpointFormat::json, SetpointFormat::csv, SetpointFormat::ndjson, SetpointFormat::f64,
                                SetpointFormat::f32})
        if (format_name(format) == value) result.format = format;
      if (!result.format) fault("must be json, csv, ndjson, f64 or f32");
      continue;
    }
    if (key == "layout") {
      if (kind_of_layout(value)) {
        result.file_layout = value;
        continue;
      }
      if (value == "csv") {  // plain rows, as CSV whatever the Accept header says
        csv = true;
        continue;
      }
      try {
        result.layout = value_of<CsvLayout>(value, csv_layouts);
      } catch (const std::invalid_argument&) {
        fault("must be plain, csv, twincat or twincat_poses" + result_layouts_text());
      }
      continue;
    }
    if (key == "frame") {
      try {
        result.frame = value_of<SetpointFrame>(value, setpoint_frames);
      } catch (const std::invalid_argument&) {
        fault("must be part or base");
      }
      continue;
    }
    if (key == "group") {
      try {
        result.group = value_of<DriveGroup>(value, drive_groups);
      } catch (const std::invalid_argument&) {
        fault("must be all, coarse or fine");
      }
      continue;
    }
    if (key == "delay") {
      const auto seconds = real(value);
      if (seconds && *seconds >= 0 && *seconds <= max_delay)
        result.delay = *seconds;
      else
        fault("must be a time from 0 to 60 s, such as 0.004");
      continue;
    }
    if (key != "first" && key != "count" && key != "every" && key != "points") {
      fault(
          "unknown parameter; known are first, count, every, columns, points, format, layout, frame, group, "
          "delay");
      continue;
    }
    const auto number = natural(value);
    if (!number) {
      fault("must be a non-negative integer");
    } else if (key == "first") {
      result.first = *number;
    } else if (key == "count") {
      result.count = *number;
    } else if (key == "every") {
      every_given = true;
      result.every = *number;
      if (*number == 0) fault("must be at least 1");
    } else {
      result.points = *number;
      if (*number == 0 || *number > max_points) fault("must be from 1 to " + std::to_string(max_points));
    }
  }
  if (csv && result.format && *result.format != SetpointFormat::csv)
    errors.push_back({"/query/format", "must be csv where layout is csv"});
  if (csv) result.format = SetpointFormat::csv;
  if (result.file_layout && seen.size() > 1)
    errors.push_back({"/query/layout", "is a whole file: it cannot be combined with other parameters"});
  if (result.points && every_given)
    errors.push_back({"/query/points", "cannot be combined with every: an envelope looks at every row"});
  if (result.points && result.layout != CsvLayout::plain)
    errors.push_back({"/query/layout", "cannot be combined with points: an envelope is for charts"});
  if (!errors.empty()) {
    std::string detail = errors.front().pointer + ": " + errors.front().message;
    throw Problem("schema-violation", detail, std::move(errors));
  }
  return result;
}

}  // namespace bahnwerk::api
