#include "core/redundant/head/section_law.hpp"

#include <algorithm>
#include <memory>

#include "core/base/errors.hpp"

namespace bahnwerk {

TimeLaw section_law(const AxisPath& path, std::size_t first, std::size_t last, const Machine& machine,
                    const std::vector<double>& feeds, const std::function<TimeLaw(const PathTask&)>& plan) {
  Path own;
  for (std::size_t i = first; i < last; ++i)  // the curves belong to the whole path, which outlives this
    own.append(std::shared_ptr<const Curve>(std::shared_ptr<const void>(), &path[i].curve()), i);
  if (own.size() != last - first) throw Infeasible("a section of the contour cannot be planned by itself");
  const CartesianAxisPath axes(own, path.axes());
  std::vector<bool> rests(own.size() + 1, false);
  rests.front() = rests.back() = true;
  const std::vector<double> own_feeds(feeds.begin() + static_cast<std::ptrdiff_t>(first),
                                      feeds.begin() + static_cast<std::ptrdiff_t>(last));
  const TimeLaw planned = plan({axes, machine, own_feeds, rests});
  TimeLaw law;
  law.reserve(planned.pieces().size());
  for (LawPiece piece : planned.pieces()) {
    const Segment &here = own[piece.segment], &there = path[first + piece.segment];
    const auto moved = [&](double s) {
      return s >= here.s1() ? there.s1() : std::clamp(there.s0() + (s - here.s0()), there.s0(), there.s1());
    };
    piece.s = moved(piece.s);
    piece.s_end = moved(piece.s_end);
    piece.segment += first;
    law.append(piece);
  }
  return law;
}

}  // namespace bahnwerk
