#pragma once
/// Thins a path to vertices: the chord that is open takes rows as long as they lie within a tolerance of it.
#include <optional>

#include "api/views/path_levels.hpp"
#include "core/geometry/curve/chord_fan.hpp"

namespace bahnwerk::api {

class OpenChord {
 public:
  struct Point {
    PathVertex vertex;
    Vec at;  ///< place of the vertex in double precision
  };
  /// `modes`: whether each chord is of one mode, that of the row at its end.
  OpenChord(double tolerance, bool planar, bool modes = true) : fan_(tolerance, planar), modes_(modes) {}

  /// Takes the next point; returns the vertex at which another chord begins by it, the first point itself included.
  std::optional<Point> take(const Point& point) {
    if (!last_) return begin(*(last_ = point));
    std::optional<Point> vertex;
    const bool changes = modes_ && last_->vertex.cut != point.vertex.cut && last_->vertex.row != begin_row_;
    if (changes || !fan_.take(point.at)) {
      vertex = begin(*last_);
      fan_.take(point.at);
    }
    last_ = point;
    return vertex;
  }
  /// Returns the last point if the chord to it is still open.
  std::optional<Point> finish() const { return last_ && last_->vertex.row != begin_row_ ? last_ : std::nullopt; }

 private:
  Point begin(const Point& vertex) {
    fan_.begin(vertex.at);
    begin_row_ = vertex.vertex.row;
    return vertex;
  }

  ChordFan fan_;
  bool modes_;
  std::optional<Point> last_;
  std::uint32_t begin_row_ = 0;
};

}  // namespace bahnwerk::api
