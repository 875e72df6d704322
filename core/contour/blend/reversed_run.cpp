#include "core/contour/blend/reversed_run.hpp"

#include <algorithm>
#include <utility>

#include "core/geometry/curve/reversed.hpp"

namespace bahnwerk::blending {

ReversedRun::ReversedRun(const ElementRun& stretch, const RunRange& range) : given_(range) {
  const std::size_t first = stretch.find(range.a, 0);
  std::size_t last = first;
  while (last < stretch.elements.size() && stretch.elements[last].begin < range.b) ++last;
  end_ = stretch.elements[last - 1].end();
  for (std::size_t i = last; i-- > first;) {
    Element e = stretch.elements[i];
    e.begin = end_ - e.end();
    if (e.straight) {
      e.from = e.from + e.length * e.tangent;
      e.tangent = -1.0 * e.tangent;
      e.segment = nullptr;
    } else {
      segments_.push_back(std::make_unique<Segment>(Segment::piece(reversed(e.segment->curve()), 0.0, e.source)));
      e.segment = segments_.back().get();
    }
    stretch_.elements.push_back(e);
  }
  range_ = {end_ - range.b, end_ - range.a, range.clamped_end, range.clamped_begin};
  range_.a = std::max(range_.a, 0.0);
}

SmoothedRun ReversedRun::turned_back(SmoothedRun run) const {
  std::reverse(run.pieces.begin(), run.pieces.end());
  for (std::optional<Rational>& piece : run.pieces)
    if (piece) piece = static_cast<const Rational&>(*reversed(*piece));
  const auto mirror = [&](std::vector<double>& places) {
    std::reverse(places.begin(), places.end());
    for (double& t : places) t = end_ - t;
  };
  mirror(run.breaks);
  mirror(run.failure_positions);
  if (!run.breaks.empty()) run.breaks.front() = given_.a, run.breaks.back() = given_.b;
  return run;
}

}  // namespace bahnwerk::blending
