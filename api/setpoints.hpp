#pragma once
/// Setpoints on the wire: which rows and columns are asked for, and how they are written.
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/setpoint_source.hpp"

namespace bahnwerk::api {

enum class SetpointFormat { json, csv, ndjson, f64 };
/// From an Accept header; absent or "*/*" → json. nullopt = nothing acceptable (not-acceptable).
std::optional<SetpointFormat> negotiate_setpoints(std::string_view accept);
std::string_view content_type(SetpointFormat format);
std::string_view format_name(SetpointFormat format);  ///< json, csv, ndjson, f64

struct SetpointQuery {
  std::size_t first = 0;
  std::optional<std::size_t> count;  ///< rows of the series that the slice spans, before `every`
  std::size_t every = 1;
  std::optional<std::size_t> points;     ///< min/max envelope with about this many points, for charts
  std::vector<std::string> columns;      ///< empty = all
  std::optional<SetpointFormat> format;  ///< wins over Accept: a link in a page cannot carry a header
};
/// From a decoded query string's pairs. Throws Problem schema-violation (422) with pointers like /query/first for
/// values that are no non-negative integers, for every = 0, points = 0, points together with every, and for unknown
/// parameters.
SetpointQuery parse_setpoint_query(const std::vector<std::pair<std::string, std::string>>& query);

/// A stored series: like SetpointSource, but read chunk by chunk through a function, so that nothing holds the whole.
struct SetpointSeries {
  std::vector<Column> columns;
  std::size_t count = 0;
  double cycle_time = 0;
  /// Fills `out` with rows [first, first + rows), row-major, all columns.
  std::function<void(std::size_t first, std::size_t rows, std::vector<double>& out)> read;
};

/// Streams one answer: each call of next() appends a bounded piece (≈ 64 KiB) to `out`, until it returns false, having
/// appended nothing.
class SetpointStream {
 public:
  /// Throws Problem schema-violation for an unknown column or a first beyond the series.
  SetpointStream(SetpointSeries series, SetpointQuery query, SetpointFormat format);
  ~SetpointStream();
  SetpointStream(SetpointStream&&) noexcept;
  bool next(std::string& out);
  const std::vector<Column>& columns() const;  ///< those answered, for X-Columns

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Shortest text that reads back as the same double (std::to_chars).
void append_number(std::string& out, double value);

}  // namespace bahnwerk::api
