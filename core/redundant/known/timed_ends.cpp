#include "core/redundant/known/timed_ends.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bahnwerk {
namespace {

constexpr std::size_t looked_at = 8;  // pieces at either end that may become constant
constexpr int places = 4;             // samples per piece

/// Tells whether all axes keep their limits on [p.s, p.s_end] at the constant rate dt/dτ = v.
bool evenly(const LawPiece& p, double v, const TimedPath& path, const Machine& axes) {
  const Segment& segment = path[p.segment];
  for (int i = 0; i <= places; ++i) {
    const double s = p.s + (p.s_end - p.s) * i / places;
    const AxisJet q =
        path.at_parameter(p.segment, segment.parameter_at(std::clamp(s - segment.s0(), 0.0, segment.length())));
    for (std::size_t k = 0; k < path.axes(); ++k)
      if (std::abs(q.d1[k]) * v > axes.axes[k].velocity || std::abs(q.d2[k]) * v * v > axes.axes[k].acceleration)
        return false;
  }
  return true;
}

/// Gives the pieces at one end, at most `count`, a constant rate; as many as make the motion shortest.
void even_end(std::vector<LawPiece>& pieces, bool last, const TimedPath& path, const Machine& axes) {
  const std::size_t n = pieces.size(), most = std::min(looked_at, n > 0 ? n - 1 : 0);
  const auto piece = [&](std::size_t i) -> LawPiece& { return pieces[last ? n - 1 - i : i]; };
  double gained = 0, rate = 0;
  std::size_t best = 0;
  double lasted = 0, length = 0;
  for (std::size_t count = 1; count <= most; ++count) {
    const LawPiece& p = piece(count - 1);
    lasted += p.duration;
    length += p.s_end - p.s;
    const double v = last ? p.v : piece(count).v;
    if (!(v > 0)) continue;
    if (lasted - length / v <= gained) continue;
    bool holds = true;
    for (std::size_t i = 0; i < count && holds; ++i) holds = evenly(piece(i), v, path, axes);
    if (holds) gained = lasted - length / v, best = count, rate = v;
  }
  for (std::size_t i = 0; i < best; ++i) {
    LawPiece& p = piece(i);
    p.v = rate;
    p.a = p.j = p.snap = 0;
    p.duration = (p.s_end - p.s) / rate;
  }
}

}  // namespace

TimeLaw with_moving_ends(const TimeLaw& rate, const TimedPath& path, const Machine& axes) {
  std::vector<LawPiece> pieces(rate.pieces().begin(), rate.pieces().end());
  even_end(pieces, true, path, axes);
  even_end(pieces, false, path, axes);
  TimeLaw law;
  law.reserve(pieces.size());
  for (const LawPiece& p : pieces) law.append(p);
  return law;
}

}  // namespace bahnwerk
