#include "core/redundant/reversed_task.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "core/geometry/curve/reversed.hpp"
#include "core/motion/law/dwell.hpp"
#include "core/redundant/reversed_motion.hpp"

namespace bahnwerk {
namespace {

Contour reversed(const Contour& contour) {
  Contour back;
  back.dimension = contour.dimension;
  back.height = contour.height;
  const std::size_t n = contour.path.size(), blocks = contour.blocks.size();
  for (std::size_t i = n; i-- > 0;)
    back.path.append(bahnwerk::reversed(contour.path[i].curve()), contour.path[i].source());
  for (std::size_t i = blocks; i-- > 0;) {
    Block block = contour.blocks[i];
    block.first = n - contour.blocks[i].last, block.last = n - contour.blocks[i].first;
    back.blocks.push_back(block);
  }
  for (std::size_t i = contour.rests.size(); i-- > 0;) {
    Rest rest = contour.rests[i];
    rest.segment = n - rest.segment, rest.block = blocks - 1 - rest.block;
    back.rests.push_back(rest);
  }
  return back;
}

template <class T>
std::vector<T> backwards(std::vector<T> list) {
  std::reverse(list.begin(), list.end());
  return list;
}

/// Pieces from the last one on, each from its end to its begin.
TimeLaw reversed(const TimeLaw& law, const AxisPath& planned, const AxisPath& path) {
  TimeLaw back;
  const auto& pieces = law.pieces();
  back.reserve(pieces.size());
  const double duration = law.duration();
  for (std::size_t i = pieces.size(); i-- > 0;) {
    const LawPiece& p = pieces[i];
    const LawState end = p.at(p.duration);
    LawPiece piece;
    piece.segment = path.size() - 1 - p.segment;
    const Segment &from = planned[p.segment], &to = path[piece.segment];
    // Both are equally long but for rounding.
    const auto place = [&](double s) {
      if (s <= from.s0()) return to.s1();
      if (s >= from.s1()) return to.s0();
      return std::clamp(to.s1() - (s - from.s0()) / from.length() * to.length(), to.s0(), to.s1());
    };
    piece.s = place(p.s_end), piece.s_end = place(p.s);
    piece.v = i + 1 < pieces.size() ? pieces[i + 1].v : 0;
    piece.a = -end.a, piece.j = end.j, piece.q = -p.q;
    if (dwells(p)) piece.v = piece.a = piece.j = piece.q = 0, piece.s_end = piece.s;
    const double time = (duration - p.t0) - back.duration();  // so that it ends where other motions' pieces do
    piece.duration = time > 0 ? time : p.duration;
    back.append(piece);
  }
  return back;
}

}  // namespace

std::optional<RedundancyTask> reversed(const RedundancyTask& task) {
  const auto contour = std::make_shared<const Contour>(reversed(*task.contour));
  const std::size_t n = task.path->size();
  if (contour->path.size() != n) return std::nullopt;
  RedundancyTask back{contour_axes(contour, task.path->axes()),
                      contour,
                      task.machine,
                      backwards(task.feeds),
                      backwards(task.rests),
                      backwards(task.dwells)};
  for (Rest& rest : back.dwells) rest.segment = n - rest.segment, rest.block = contour->blocks.size() - 1 - rest.block;
  back.bound = task.bound;
  return back;
}

RedundancyResult reversed(RedundancyResult found, const RedundancyTask& task) {
  const std::size_t n = task.path->size();
  found.head =
      std::make_shared<const PathMotion>(task.path, reversed(found.head->law(), found.head->path(), *task.path));
  found.coarse = std::make_shared<const ReversedMotion>(found.coarse);
  for (SlowedSegment& slowed : found.slowed) slowed.segment = n - 1 - slowed.segment;
  std::reverse(found.slowed.begin(), found.slowed.end());
  return found;
}

}  // namespace bahnwerk
