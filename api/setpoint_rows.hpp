#pragma once
/// Rows of a stored series in bounded memory, and the min/max envelope that charts draw.
#include <cstddef>
#include <string>
#include <vector>

#include "api/setpoints.hpp"

namespace bahnwerk::api {

/// Walks rows first, first + every, … of a series, reading blocks of at most 2048 rows.
class RowCursor {
 public:
  /// `rows`: how many rows next() hands out. The series outlives the cursor.
  RowCursor(const SetpointSeries& series, std::size_t first, std::size_t every, std::size_t rows);
  const double* next();  ///< all columns of the next row, valid until the next call; nullptr at the end
  void rewind();

 private:
  const SetpointSeries* series_;
  std::size_t first_, every_, rows_;
  std::size_t given_ = 0;                // rows handed out
  std::size_t loaded_ = 0, offset_ = 0;  // rows handed out up to the end of the block; place in the block
  std::vector<double> block_;
};

/// The series with columns x, y, z, phi, vx and vy, as far as it has them, in the machine's frame. It must know that.
SetpointSeries in_base_frame(SetpointSeries series);
/// The series with one more column, behind the others, that is 1 in every row.
SetpointSeries with_mark(SetpointSeries series, const std::string& name);
/// The series begun so many rows later: its first row stands before it as often, with 0 in the columns that are the
/// rate vc or ac of another column c.
SetpointSeries delayed(SetpointSeries series, std::size_t rows);

/// The envelope of rows [first, first + rows) as a series of min(points, rows) rows: column "index" (the bucket's first
/// row), then per column of `columns` its smallest and largest value in the bucket, named x_min, x_max. Bucket b covers
/// rows [first + b·rows/n, first + (b+1)·rows/n). Computed on the first read; holds points · (2 · columns + 1) doubles.
SetpointSeries envelope(SetpointSeries series, std::size_t first, std::size_t rows, std::size_t points,
                        std::vector<std::size_t> columns);

}  // namespace bahnwerk::api
