#include "core/contour/blend/reversed_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/contour/blend/smooth_scale.hpp"
#include "core/geometry/curve/reversed.hpp"

namespace bahnwerk::blending {

bool begins_at_end(const ElementRun& stretch, const RunRange& range) {
  constexpr double clear = 1e-7;
  const double length = range.b - range.a;
  const Vec begin = point_of(stretch, range.a), end = point_of(stretch, range.b);
  for (const double part : {0.5, 0.25, 0.125, 0.375, 0.0625, 0.1875, 0.3125, 0.4375}) {
    const double first = norm(point_of(stretch, range.a + part * length) - begin),
                 last = norm(point_of(stretch, range.b - part * length) - end);
    if (std::abs(first - last) > clear * std::max(first, last)) return first > last;
  }
  return false;
}

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
