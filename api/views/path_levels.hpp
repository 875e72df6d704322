#pragma once
/// The view `path`: polylines of the tool's path, and of the coarse axes' path, whose vertices are rows, in levels of
/// growing tolerance. Chunks of vertices have boxes, so that a part of the plane is found without reading the rest.
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api/views/views.hpp"
#include "core/geometry/curve/vec.hpp"

namespace bahnwerk::api {

/// Tolerances of the levels, mm; what is finer is read from the rows. Every row between two neighbouring vertices lies
/// within it of their chord.
inline constexpr std::array<double, 5> path_tolerances{0.05, 0.25, 1.25, 6.25, 31.25};

/// A row that is a vertex. Coordinates and speed have single precision.
struct PathVertex {
  std::uint32_t row = 0;
  std::array<float, 3> at{};  ///< mm
  float v = 0;                ///< mm/s; 0 if the series has no speed
  std::uint32_t block = 0;    ///< 0 if the series has no blocks
  bool cut = true;            ///< column `mode`; true if the series has none
};

/// A path in the columns of a series: x, y (z), or xc, yc (zc).
struct PathColumns {
  std::string name;                  ///< tool or coarse
  std::vector<std::size_t> columns;  ///< two or three
};
/// Returns the paths that a series has.
std::vector<PathColumns> path_columns(const std::vector<Column>& columns);

/// Makes vertices of the rows of a series.
class RowVertices {
 public:
  RowVertices(const std::vector<Column>& columns, PathColumns path);
  /// Returns the row as a vertex, and its place in double precision in `at`.
  PathVertex operator()(std::size_t row, const double* values, Vec& at) const;

 private:
  PathColumns path_;
  std::size_t width_, speed_, block_, mode_;
};

/// Makes the view; nullptr if the series has no path.
std::unique_ptr<View> path_view(const ViewInput& input, const ViewSink& sink);

/// A box in the plane, mm.
struct PathBox {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// Vertices of stored levels of one path.
class StoredPath {
 public:
  /// `path` is tool or coarse. exists() is false if there is no such view.
  StoredPath(ViewReader read, std::string_view path);
  bool exists() const { return !chunks_.empty(); }
  std::size_t dimension() const { return dimension_; }
  /// Returns a number of vertices of a level that is not exceeded by those of rows [first, end) in the box.
  std::size_t at_most(std::size_t level, std::size_t first, std::size_t end, const std::optional<PathBox>& box) const;
  /// A polyline whose vertices follow one another in the level.
  using Run = std::vector<PathVertex>;
  /// Returns the chords of a level that touch the rows [first, end) and, grown by the level's tolerance, the box.
  std::vector<Run> read(std::size_t level, std::size_t first, std::size_t end, const std::optional<PathBox>& box) const;

 private:
  struct Chunk {
    std::uint8_t level;
    std::uint32_t part, count, first_row, last_row;
    std::array<float, 6> box;  ///< lowest and highest x, y, z
  };
  bool overlaps(const Chunk& chunk, std::size_t level, std::size_t first, std::size_t end,
                const std::optional<PathBox>& box) const;

  ViewReader read_;
  std::string name_;
  std::size_t dimension_ = 0;
  std::vector<Chunk> chunks_;  // chunks by level, then by rows; neighbours share a vertex
};

}  // namespace bahnwerk::api
