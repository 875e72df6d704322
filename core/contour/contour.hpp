#pragma once
/// A contour as it is planned: blocks of curves joined into one path, with the notes of its reader.
#include <cstddef>
#include <string>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/geometry/path/path.hpp"

namespace bahnwerk {

enum class Mode { cut, position };  ///< whether the tool is on (cut) or off

/// The path segments [first, last), which share a mode and a feed.
struct Block {
  Mode mode = Mode::cut;
  double feed = 0;  ///< largest speed of the tool, mm/s; infinite: limited by the axes alone
  std::size_t first = 0, last = 0;
};

/// A rest of the motion where path segment `segment` begins, or at the end of the path for segment == path.size().
struct Rest {
  std::size_t segment = 0;
  double seconds = 0;     ///< duration; 0: the motion only stops
  std::size_t block = 0;  ///< the block to which the rest belongs; it may have no segments
};
inline constexpr double longest_rest = 86400;  ///< longest dwell, s

/// A path with the blocks, rests and notes that planning needs.
struct Contour {
  std::size_t dimension = 2;  ///< number of coordinates of the path, 2 or 3
  double height = 0;  ///< position of a third axis along a planar contour, whose path has z = 0; mm; 0 if unknown
  Path path;
  std::vector<Block> blocks;          ///< blocks in order; they cover every segment; empty ones have first == last
  std::vector<Rest> rests;            ///< ordered by segment, then by block; dwells at one place add up
  std::vector<std::string> notes;     ///< remarks of the reader on what it dropped or moved
  std::vector<double> feeds() const;  ///< feed of each path segment, mm/s
  /// Returns whether the motion rests at the beginning of each path segment and, as the last entry, at the end of the
  /// path. O(segments + rests).
  std::vector<bool> rest_places() const;
  double dwell() const;  ///< sum of all rests, s
};

/// Adds a rest of 0 s wherever cutting and positioning meet. O(blocks + rests).
void stop_at_mode_changes(Contour& contour);

/// A place at which two path segments meet. The tangent may jump there.
struct Joint {
  double s = 0;          ///< mm along the path
  std::size_t next = 0;  ///< index of the segment that begins here
  double angle = 0;      ///< tangent jump, rad
  Vec step;              ///< right tangent − left tangent
};
/// Returns whether a motion has to stop at the beginning of segment i > 0: at a cusp, or a tangent jump above
/// `corner_angle`, rad.
bool stops_at(const Path& path, std::size_t i, double corner_angle);

/// Returns every inner joint of the path, in order. O(n), up to 2 µs each; reports to `progress`, if given.
std::vector<Joint> joints(const Path& path, ProgressScope* progress = nullptr);

}  // namespace bahnwerk
