#include "core/redundant/known/quicker_ranges.hpp"

#include <algorithm>
#include <utility>

namespace bahnwerk {
namespace {

constexpr double one = TimedPath::per_second;  // mm/s: the rate of the old time
constexpr double short_part = 0.02;            // share of a piece
constexpr int halvings = 60;

LawPiece at_rate(std::size_t segment, double s, double s_end) {
  LawPiece piece;
  piece.segment = segment;
  piece.s = s, piece.s_end = s_end;
  piece.v = one;
  piece.duration = (s_end - s) / one;
  return piece;
}

/// Returns the time at which the rate of a piece crosses 1.
double crossing(const LawPiece& p, bool rises) {
  double low = 0, high = p.duration;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    ((p.at(middle).v < one) == rises ? low : high) = middle;
  }
  return rises ? high : low;
}

}  // namespace

std::vector<QuickerRange> quicker_ranges(const TimeLaw& rate) {
  std::vector<QuickerRange> ranges;
  bool open = false;
  const auto add = [&](const LawPiece& piece) {
    if (!open) ranges.push_back({piece.s, piece.s, {}});
    open = true;
    ranges.back().pieces.push_back(piece);
    ranges.back().end = piece.s_end;
  };
  for (const LawPiece& p : rate.pieces()) {
    const double before = p.v, after = p.at(p.duration).v;
    if (before <= one && after <= one) {
      open = false;
      continue;
    }
    if (before >= one && after >= one) {
      add(p);
      continue;
    }
    if (before < one) open = false;
    LawPiece part = p;
    const double way = p.s_end - p.s, at = crossing(p, before < one);
    const LawState x = p.at(at);
    if (before < one && p.s_end - x.s > short_part * way) {
      part.s = x.s, part.v = one, part.a = x.a, part.j = x.j;
      part.duration = p.duration - at;
    } else if (before >= one && x.s - p.s > short_part * way) {
      part.s_end = x.s;
      part.duration = at;
    } else {  // evenly in the square over the whole piece
      const double from = std::max(before, one), to = std::max(after, one);
      part.v = from, part.a = (to - from) * (to + from) / (2 * way), part.j = part.snap = 0;
      part.duration = 2 * way / (from + to);
    }
    if (way > 0) add(part);
    if (after < one) open = false;
  }
  return ranges;
}

TimeLaw with_ranges(const TimedPath& path, const std::vector<QuickerRange>& ranges, std::vector<std::size_t>& borders) {
  TimeLaw law;
  borders.clear();
  std::size_t segment = 0;
  double s = 0;
  const auto old_time = [&](double until) {
    while (s < until) {
      while (segment + 1 < path.size() && path[segment].s1() <= s) ++segment;
      const double end = std::min(until, path[segment].s1());
      if (!(end > s)) break;
      law.append(at_rate(segment, s, end));
      s = end;
    }
  };
  for (const QuickerRange& range : ranges) {
    old_time(range.begin);
    borders.push_back(law.pieces().size());
    for (const LawPiece& piece : range.pieces) law.append(piece);
    borders.push_back(law.pieces().size());
    s = range.end;
  }
  old_time(path.length());
  return law;
}

}  // namespace bahnwerk
