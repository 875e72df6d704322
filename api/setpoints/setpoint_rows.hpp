#pragma once
/// Rows of a stored series in bounded memory, and the min/max envelope for charts.
#include <cstddef>
#include <string>
#include <vector>

#include "api/setpoints/setpoints.hpp"

namespace bahnwerk::api {

/// Iterates over the rows first, first + every, … of a series, reading blocks of at most 2048 rows.
class RowCursor {
 public:
  /// `rows` is the number of rows that next() returns. The series must outlive the cursor.
  RowCursor(const SetpointSeries& series, std::size_t first, std::size_t every, std::size_t rows);
  const double* next();  ///< returns all columns of the next row, valid until the next call; nullptr at the end
  void rewind();

 private:
  const SetpointSeries* series_;
  std::size_t first_, every_, rows_;
  std::size_t given_ = 0;                // rows handed out
  std::size_t loaded_ = 0, offset_ = 0;  // rows handed out up to the end of the block; place in the block
  std::vector<double> block_;
};

/// Returns the series with those of its columns x, y, z, phi, vx and vy that exist converted to the machine's frame,
/// which the series must know.
SetpointSeries in_base_frame(SetpointSeries series);
/// Returns the series with an additional last column that is 1 in every row.
SetpointSeries with_mark(SetpointSeries series, const std::string& name);
/// Returns the series delayed by `rows` rows: its first row is repeated before it, with 0 in columns vc and ac, the
/// rates of a column c.
SetpointSeries delayed(SetpointSeries series, std::size_t rows);

/// Returns the series with the additional last columns use and limit, which are computed from its rows and the stored
/// list of limits. The series must have views.
SetpointSeries with_limits(SetpointSeries series);

/// Returns the envelope of the rows [first, first + rows) as a series of n = min(points, rows) rows: column "index"
/// (the bucket's first row), then for each of `columns` its smallest and largest value in the bucket, named x_min,
/// x_max. Bucket b covers the rows [first + b·rows/n, first + (b+1)·rows/n). Of a series with views they are those of
/// bucket_bounds(), and long ones are read from the views. The column limit of with_limits() has the number that most
/// rows of the bucket have, twice. The envelope is computed on the first read and takes points · (2 · columns + 1)
/// doubles.
SetpointSeries envelope(SetpointSeries series, std::size_t first, std::size_t rows, std::size_t points,
                        std::vector<std::size_t> columns);

}  // namespace bahnwerk::api
