#pragma once
/// A contour as it is planned: blocks of curves joined into one path, with what the reader of it had to note.
#include <cstddef>
#include <string>
#include <vector>

#include "core/curve/path.hpp"

namespace bahnwerk {

enum class Mode { cut, position };

/// One block: the path segments [first, last) share a mode and a feed.
struct Block {
  Mode mode = Mode::cut;
  double feed = 0;  ///< mm/s, infinity = limited by the axes alone
  std::size_t first = 0, last = 0;
};

struct Contour {
  std::size_t dimension = 2;
  Path path;
  std::vector<Block> blocks;          ///< in order, covering every segment; empty blocks are kept (first == last)
  std::vector<std::string> notes;     ///< what was dropped or moved on reading, for the report
  std::vector<double> feeds() const;  ///< per path segment, mm/s
};

/// Where two path segments meet.
struct Joint {
  double s = 0;
  std::size_t next = 0;  ///< index of the segment that begins here
  double angle = 0;      ///< tangent jump, rad
  Vec step;              ///< right tangent − left tangent
};
/// Every inner joint of the path, in order. O(n).
std::vector<Joint> joints(const Path& path);

}  // namespace bahnwerk
