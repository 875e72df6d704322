#pragma once
/// The answer to GET …/path: vertices of a path within a tolerance, or as many as fit a picture.
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/views/path_levels.hpp"

namespace bahnwerk::api {

struct PathQuery {
  std::optional<std::size_t> points;  ///< at most about that many vertices
  std::optional<double> tolerance;    ///< mm; without both, 2000 points
  std::optional<PathBox> box;
  std::size_t first = 0;
  std::optional<std::size_t> count;  ///< rows
  std::string of = "tool";           ///< tool, coarse or part: the tool in the frame of the part
  std::vector<std::string> columns;  ///< beside row, begin and the coordinates
  std::optional<bool> binary;        ///< parameter `format`: f32 or json
  static constexpr std::size_t most_points = 200'000;
};
/// Parses a decoded query string. Throws Problem schema-violation with pointers like /query/box.
PathQuery parse_path_query(const std::vector<std::pair<std::string, std::string>>& query);

/// The vertices that answer a query.
struct ChosenPath {
  std::vector<StoredPath::Run> runs;  ///< a run is a polyline; between two of them nothing is in the box
  /// mm; every row left out between two vertices of a run lies within it of their chord, with coordinates in single
  /// precision
  double tolerance = 0;
};
/// The rows of the series, for what is finer than the finest level.
struct PathRows {
  std::size_t count = 0, width = 0;
  RowVertices vertex;
  std::function<void(std::size_t first, std::size_t rows, std::vector<double>& out)> read;
};
/// Returns vertices from the coarsest level within the tolerance, or from the finest one that is not much larger than
/// the number asked for, or from the rows in the box; these are thinned further where that is permitted. Reads the
/// chunks of one level in the box. Throws Problem schema-violation for a tolerance that more than 2 000 000 vertices
/// would be needed for.
ChosenPath choose_path(const StoredPath& path, const PathQuery& query, const PathRows& rows);

/// Values of a column beside the coordinates.
struct PathColumn {
  std::string name, unit;
  std::function<double(const PathVertex&)> value;
};
/// Returns {"of", "tolerance", "count", "columns", "values": {NAME: [...]}}: row, begin (1 where a run begins),
/// coordinates, then the columns.
std::string path_json(const ChosenPath& path, const PathQuery& query, std::size_t dimension,
                      const std::vector<PathColumn>& columns);
/// Returns the same, row-major, little-endian: row as an unsigned integer of 4 bytes, everything else as a float.
std::string path_f32(const ChosenPath& path, std::size_t dimension, const std::vector<PathColumn>& columns);
/// Returns the names of the columns with commas between them.
std::string path_column_names(std::size_t dimension, const std::vector<PathColumn>& columns);

}  // namespace bahnwerk::api
