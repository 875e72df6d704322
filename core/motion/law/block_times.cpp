#include "core/motion/law/block_times.hpp"

#include "core/motion/law/dwell.hpp"

namespace bahnwerk {

std::vector<BlockTime> block_times(const Contour& contour, const TimeLaw& law) {
  const auto& blocks = contour.blocks;
  std::vector<double> begin;
  begin.reserve(blocks.size() + 1);
  const auto enter = [&](std::size_t block, double t) {
    while (begin.size() <= block && begin.size() < blocks.size()) begin.push_back(t);
  };
  std::size_t block = 0, rest = 0;  // block of the current segment; next rest of the contour
  // The motion may also rest elsewhere, for example while it waits for a filter: that time belongs to the current
  // block.
  const auto there = [&](const Rest& at, const LawPiece& piece) {
    if (contour.path.size() == 0) return true;
    if (at.segment < contour.path.size()) return at.segment <= piece.segment;
    const Segment& last = contour.path[contour.path.size() - 1];
    return piece.segment + 1 == contour.path.size() && piece.s > 0.5 * (last.s0() + last.s1());
  };
  for (const LawPiece& piece : law.pieces()) {  // no piece spans two segments
    while (rest < contour.rests.size() && !(contour.rests[rest].seconds > 0)) ++rest;
    if (rest < contour.rests.size() && dwells(piece) && there(contour.rests[rest], piece)) {
      enter(contour.rests[rest++].block, piece.t0);
      continue;
    }
    while (block < blocks.size() && piece.segment >= blocks[block].last) ++block;
    enter(block, piece.t0);
  }
  while (begin.size() <= blocks.size()) begin.push_back(law.duration());
  std::vector<BlockTime> times;
  times.reserve(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) times.push_back({begin[b], begin[b + 1]});
  return times;
}

}  // namespace bahnwerk
