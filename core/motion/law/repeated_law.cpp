#include "core/motion/law/repeated_law.hpp"

#include <algorithm>

namespace bahnwerk {
namespace {

double length(const Segment& segment) { return segment.travelled(segment.curve().end()); }

}  // namespace

void repeat_law(TimeLaw& law, const Path& path, const LawRepetition& repetition, ProgressScope& progress) {
  const std::size_t from = repetition.from, to = repetition.to, source = repetition.source, copy = repetition.copy;
  double before = 0, now = 0;
  for (std::size_t i = 0; i < repetition.segments; ++i)
    before += length(path[source + i]), now += length(path[copy + i]);
  const double stretch = now / before;
  law.reserve(to - from);
  std::size_t at = path.size();
  double part = 1;  // part of the current segment
  for (std::size_t i = from; i < to; ++i) {
    progress.work();
    LawPiece p = law.pieces()[i];
    const Segment &old = path[p.segment], &segment = path[p.segment - source + copy];
    if (p.segment != at) at = p.segment, part = length(segment) / length(old);
    const auto place = [&](double s) {
      return s >= old.s1() ? segment.s1() : std::min(segment.s0() + (s - old.s0()) * part, segment.s1());
    };
    p.segment = p.segment - source + copy;
    p.s = place(p.s), p.s_end = place(p.s_end);
    p.v *= stretch, p.a *= stretch, p.j *= stretch, p.snap *= stretch;
    law.append(p);
  }
}

}  // namespace bahnwerk
