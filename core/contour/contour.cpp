#include "core/contour/contour.hpp"

namespace bahnwerk {

std::vector<double> Contour::feeds() const {
  std::vector<double> feed(path.size());
  for (const Block& b : blocks)
    for (std::size_t i = b.first; i < b.last; ++i) feed[i] = b.feed;
  return feed;
}

std::vector<Joint> joints(const Path& path) {
  std::vector<Joint> list;
  if (path.empty()) return list;
  list.reserve(path.size() - 1);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Segment &before = path[i - 1], &after = path[i];
    const Vec left = before.at_parameter(before.curve().end()).d1;
    const Vec right = after.at_parameter(after.curve().begin()).d1;
    list.push_back({after.s0(), i, angle_between(left, right), right - left});
  }
  return list;
}

}  // namespace bahnwerk
