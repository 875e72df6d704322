#pragma once
/// How rows are grouped: the cells of which views keep figures, and the intervals of an answer with `points`.
#include <array>
#include <cstddef>
#include <vector>

namespace bahnwerk::api {

/// Rows per cell of each level; a cell of one level is eight of the level before.
inline constexpr std::array<std::size_t, 4> cell_rows{64, 512, 4096, 32768};
inline constexpr std::size_t part_cells = 512;  ///< cells in one part of a stored level

/// Returns how many levels are stored for a series: level k of more than 16 cells. A short series has none.
std::size_t stored_levels(std::size_t count);

/// Returns whether rows are grouped by whole cells: where `points` intervals of them have 32 rows and more each, and
/// the series has levels.
bool grouped_by_cells(std::size_t rows, std::size_t points, std::size_t count);

/// Returns the bounds of the intervals into which rows [first, first + rows) of a series of `count` rows are divided:
/// of n = min(points, rows) intervals bound b is first + b·rows/n. Where they are grouped by
/// cells, n is at most rows/64, and inner bounds are rounded to whole cells of the coarsest level whose
/// cells are not longer than rows/n. n + 1 ascending numbers; {first} where there are no rows.
std::vector<std::size_t> bucket_bounds(std::size_t first, std::size_t rows, std::size_t points, std::size_t count);

/// Calls cell(level, index) for whole cells and rows(from, to) for what is left at the ends of rows [from, to), so that
/// together they cover it once. The last cell of a series may be short: it counts as whole where `to` is the end.
template <class Cell, class Rows>
void for_each_cell(std::size_t from, std::size_t to, std::size_t count, Cell&& cell, Rows&& rows) {
  const auto cover = [&](const auto& self, std::size_t a, std::size_t b, std::size_t levels) -> void {
    if (a >= b) return;
    if (levels == 0) return rows(a, b);
    const std::size_t size = cell_rows[levels - 1], begin = (a + size - 1) / size;
    const std::size_t end = b == count ? (b + size - 1) / size : b / size;
    if (begin >= end) return self(self, a, b, levels - 1);
    self(self, a, begin * size, levels - 1);
    for (std::size_t k = begin; k < end; ++k) cell(levels - 1, k);
    if (end * size < b) self(self, end * size, b, levels - 1);
  };
  cover(cover, from, to, stored_levels(count));
}

}  // namespace bahnwerk::api
