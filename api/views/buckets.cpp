#include "api/views/buckets.hpp"

#include <algorithm>

namespace bahnwerk::api {

std::size_t stored_levels(std::size_t count) {
  std::size_t levels = 0;
  while (levels < cell_rows.size() && count > 16 * cell_rows[levels]) ++levels;
  return levels;
}

bool grouped_by_cells(std::size_t rows, std::size_t points, std::size_t count) {
  const std::size_t n = std::min(points, rows);
  return stored_levels(count) > 0 && n > 0 && rows / n >= cell_rows[0] / 2;
}

std::vector<std::size_t> bucket_bounds(std::size_t first, std::size_t rows, std::size_t points, std::size_t count) {
  std::vector<std::size_t> bounds{first};
  std::size_t n = std::min(points, rows), cell = 1;
  if (const std::size_t levels = stored_levels(count); grouped_by_cells(rows, points, count)) {
    n = std::max<std::size_t>(1, std::min(n, rows / cell_rows[0]));
    for (std::size_t k = 0; k < levels && cell_rows[k] <= rows / n; ++k) cell = cell_rows[k];
  }
  bounds.reserve(n + 1);
  for (std::size_t b = 1; b <= n; ++b) {
    // Without rows · n, which could overflow: rows = quotient · n + remainder.
    const std::size_t bound = first + b * (rows / n) + b * (rows % n) / n;
    bounds.push_back(b == n ? bound : (bound + cell / 2) / cell * cell);
  }
  return bounds;
}

}  // namespace bahnwerk::api
