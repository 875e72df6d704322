#include "core/contour/contour.hpp"

#include <algorithm>

namespace bahnwerk {

std::vector<double> Contour::feeds() const {
  std::vector<double> feed(path.size());
  for (const Block& b : blocks)
    for (std::size_t i = b.first; i < b.last; ++i) feed[i] = b.feed;
  return feed;
}

std::vector<bool> Contour::rest_places() const {
  std::vector<bool> places(path.size() + 1, false);
  for (const Rest& rest : rests) places[rest.segment] = true;
  return places;
}

double Contour::dwell() const {
  double sum = 0;
  for (const Rest& rest : rests) sum += rest.seconds;
  return sum;
}

void stop_at_mode_changes(Contour& contour) {
  std::vector<Rest> stops;
  const Block* before = nullptr;
  for (std::size_t b = 0; b < contour.blocks.size(); ++b) {
    const Block& block = contour.blocks[b];
    if (block.first == block.last) continue;
    if (before != nullptr && before->mode != block.mode) stops.push_back({block.first, 0, b});
    before = &block;
  }
  std::vector<Rest> all;
  all.reserve(contour.rests.size() + stops.size());
  const auto earlier = [](const Rest& a, const Rest& b) {
    return a.segment != b.segment ? a.segment < b.segment : a.block < b.block;
  };
  std::merge(contour.rests.begin(), contour.rests.end(), stops.begin(), stops.end(), std::back_inserter(all), earlier);
  contour.rests = std::move(all);
}

bool stops_at(const Path& path, std::size_t i, double corner_angle) {
  const Segment &before = path[i - 1], &after = path[i];
  return before.cusp_end() || after.cusp_begin() ||
         angle_between(before.at_parameter(before.curve().end()).d1, after.at_parameter(after.curve().begin()).d1) >
             corner_angle;
}

std::vector<Joint> joints(const Path& path, ProgressScope* progress) {
  std::vector<Joint> list;
  if (path.empty()) return list;
  list.reserve(path.size() - 1);
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (progress) progress->work(4);
    const Segment &before = path[i - 1], &after = path[i];
    const Vec left = before.at_parameter(before.curve().end()).d1;
    const Vec right = after.at_parameter(after.curve().begin()).d1;
    list.push_back({after.s0(), i, angle_between(left, right), right - left});
  }
  return list;
}

}  // namespace bahnwerk
