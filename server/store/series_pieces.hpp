#pragma once
/// A plan's series as stores keep it: packed chunks of rows, the parts of its views, and a text that says what its
/// columns are.
#include <string>
#include <vector>

#include "api/planned_job.hpp"
#include "core/base/progress.hpp"
#include "server/store/codec.hpp"
#include "server/store/values.hpp"

namespace bahnwerk::server {

inline constexpr std::size_t series_chunk_rows = 4096;

struct SeriesChunk {
  std::size_t first = 0, rows = 0;
  std::string packed;
};

/// What one transaction stores: about 4 MB of chunks, and the parts of views, compressed, that the rows so far have
/// completed.
struct SeriesPiece {
  std::vector<SeriesChunk> chunks;
  std::vector<api::ViewPart> views;
};

/// Reads a series once, and makes chunks and views of it.
class SeriesPacker {
 public:
  /// Rows before `first` are stored already; the views need them again. `progress` is asked while rows are read.
  SeriesPacker(const api::PlannedJob& planned, std::size_t first, Progress progress);
  /// Returns the next piece; `last` becomes true with the last one.
  SeriesPiece next(bool& last);

 private:
  const SetpointSource& source_;
  std::size_t stored_;
  Progress progress_;
  Compressor compressor_;
  SeriesPiece piece_;
  api::Views views_;
  std::size_t row_ = 0;
  std::vector<double> values_;
};

/// Returns the view's part with its bytes compressed.
api::ViewPart packed(api::ViewPart part, Compressor& compressor);

/// Returns the columns as an array, or as an object with the poses' frame if it is known and the independent variable
/// if it is not time.
std::string series_columns(const SetpointSource& source);
/// Reads such a text into `info`, whose cycle time is known. Throws StoreError when damaged.
void read_series_columns(const std::string& text, SeriesInfo& info);

}  // namespace bahnwerk::server
