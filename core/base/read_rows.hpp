#pragma once
/// Reading a series of setpoints row by row.
#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include "core/base/setpoint_source.hpp"

namespace bahnwerk {

/// Returns the index of the column of that name; columns.size() if there is none.
inline std::size_t column_index(const std::vector<Column>& columns, std::string_view name) {
  const auto at = std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
  return static_cast<std::size_t>(at - columns.begin());
}

/// Calls visit(k, row) for every row in order, and passed(rows so far, rows since the last call), if given, after every
/// 1024 rows and at the end. `row` has one number per column. Memory: 1024 rows.
template <class Visit, class Passed>
void for_each_row(const SetpointSource& setpoints, Visit&& visit, Passed&& passed) {
  constexpr std::size_t chunk_rows = 1024;
  const std::size_t rows = setpoints.count(), width = setpoints.columns().size();
  std::vector<double> chunk(std::min(rows, chunk_rows) * width);
  for (std::size_t first = 0; first < rows; first += chunk_rows) {
    const std::size_t count = std::min(chunk_rows, rows - first);
    setpoints.read(first, count, chunk.data());
    for (std::size_t i = 0; i < count; ++i) visit(first + i, chunk.data() + i * width);
    passed(first + count, count);
  }
}
/// Calls visit(k, row) for every row in order.
template <class Visit>
void for_each_row(const SetpointSource& setpoints, Visit&& visit) {
  for_each_row(setpoints, visit, [](std::size_t, std::size_t) {});
}

}  // namespace bahnwerk
