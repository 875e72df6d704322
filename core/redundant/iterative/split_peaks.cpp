#include "core/redundant/iterative/split_peaks.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {
namespace {

Range hull(const Range& a, const Range& b) { return {std::min(a.lowest, b.lowest), std::max(a.highest, b.highest)}; }
double largest(const Range& r) { return std::max(std::abs(r.lowest), std::abs(r.highest)); }
Range minus(const Range& a, const Range& b) { return {a.lowest - b.highest, a.highest - b.lowest}; }

/// Returns the ranges of a polynomial's second and third derivative over h seconds: the values at both ends, widened by
/// at most h²/8·max|f″|, where f″ is linear.
struct CoarseRange {
  Range acceleration, jerk;
};
CoarseRange range_of(const TimeSpline::Coefficients& c, double h) {
  const double a0 = 2 * c[2], a1 = 2 * c[2] + h * (6 * c[3] + h * (12 * c[4] + h * 20 * c[5]));
  const double j0 = 6 * c[3], j1 = 6 * c[3] + h * (24 * c[4] + h * 60 * c[5]);
  const double bend = std::max(std::abs(24 * c[4]), std::abs(24 * c[4] + 120 * c[5] * h)) * h * h / 8;
  const double jerk_bend = std::abs(120 * c[5]) * h * h / 8;
  return {{std::min(a0, a1) - bend, std::max(a0, a1) + bend},
          {std::min(j0, j1) - jerk_bend, std::max(j0, j1) + jerk_bend}};
}

}  // namespace

std::vector<SplitPeaks> split_peaks(const HeadCells& cells, const TimeLaw& law, std::size_t axis,
                                    const TimeSpline& coarse, const SegmentRange& range, CellsBegin& at) {
  std::vector<SplitPeaks> peaks(range.last - range.first);
  const auto raise = [](double& peak, double value) { peak = std::max(peak, value); };
  std::size_t& piece = at.coarse;
  const double begin = law.pieces()[at.law].t0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    SplitPeaks& p = peaks[law.pieces()[at.law + cells.pieces[c]].segment - range.first];
    const double t0 = begin + cells.times[c], t1 = begin + cells.times[c + 1], h = t1 - t0;
    const HeadCell& head = cells.cells[axis][c];
    piece = coarse.find(t0, piece);
    Range coarse_a, fine_a;
    bool any = false;
    std::size_t i = piece;
    for (double t = t0; t < t1; ++i) {
      const double until = i + 1 < coarse.pieces() ? std::min(t1, coarse.end(i)) : t1;
      const CoarseRange r = range_of(coarse.from(i, t), until - t);
      coarse_a = any ? hull(coarse_a, r.acceleration) : r.acceleration;
      raise(p.coarse_jerk, largest(r.jerk));
      raise(p.fine_jerk, largest(minus(head.jerk, r.jerk)));
      any = true;
      t = until;
    }
    fine_a = minus(head.acceleration, coarse_a);
    raise(p.coarse_acceleration, largest(coarse_a));
    raise(p.fine_acceleration, largest(fine_a));
    const std::size_t end_piece = coarse.find(t1, piece);
    const AxisState s0 = coarse.in_piece(piece, t0), s1 = coarse.in_piece(end_piece, t1);
    const HeadNode &n0 = cells.nodes[axis][c], &n1 = cells.nodes[axis][c + 1];
    raise(p.coarse_velocity, std::max(std::abs(s0.v), std::abs(s1.v)) + coarse_a.width() * h / 4);
    raise(p.fine_velocity, std::max(std::abs(n0.v - s0.v), std::abs(n1.v - s1.v)) + fine_a.width() * h / 4);
    raise(p.offset, std::max(std::abs(n0.x - s0.x), std::abs(n1.x - s1.x)) + largest(fine_a) * h * h / 8);
  }
  return peaks;
}

std::vector<SplitPeaks> sampled_peaks(const HeadSamples& head, std::size_t axis, const TimeSpline& coarse,
                                      const SegmentRange& range) {
  std::vector<SplitPeaks> peaks(range.last - range.first);
  const auto raise = [](double& peak, double value) { peak = std::max(peak, std::abs(value)); };
  std::size_t piece = 0;
  for (std::size_t i = 0; i < head.times.size(); ++i) {
    piece = coarse.find(head.times[i], piece);
    const AxisState c = coarse.in_piece(piece, head.times[i]), &h = head.axes[axis][i];
    SplitPeaks& p = peaks[head.segments[i] - range.first];
    raise(p.offset, h.x - c.x);
    raise(p.coarse_velocity, c.v);
    raise(p.coarse_acceleration, c.a);
    raise(p.coarse_jerk, c.j);
    raise(p.fine_velocity, h.v - c.v);
    raise(p.fine_acceleration, h.a - c.a);
    raise(p.fine_jerk, h.j - c.j);
  }
  return peaks;
}

}  // namespace bahnwerk
