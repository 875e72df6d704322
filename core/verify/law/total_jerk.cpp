#include "core/verify/law/total_jerk.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/numeric/peak.hpp"
#include "core/verify/law/channel_bounds.hpp"
#include "core/verify/law/curve_disc.hpp"

namespace bahnwerk::verify {
namespace {

// PeakSweep resolves 2e-11 of its scale; of the square 2e-7 will do.
constexpr double coarsening = 1e4;

double square(const PathBatch& batch, std::size_t i, const LawState& x) {
  double sum = 0;
  for (std::size_t k = 0; k < (batch.planar ? 2U : 3U); ++k) {
    const double j = (batch.d3[k][i] * x.v * x.v + 3 * batch.d2[k][i] * x.a) * x.v + batch.d1[k][i] * x.j;
    sum += j * j;
  }
  return sum;
}

}  // namespace

Worst total_jerk(const Path& tool, const TimeLaw& law, ProgressScope& progress) {
  PathBatch batch;
  std::array<LawState, PathBatch::most> state;
  // Counted from the begin of the segment: far along a path the rounding of s would show as noise.
  const auto fill = [&](const LawPiece& local, const Segment& segment, std::size_t n, auto&& tau) {
    batch.count = n;
    for (std::size_t i = 0; i < n; ++i) {
      state[i] = local.at(tau(i));
      batch.u.set(i, segment.parameter_at(std::clamp(state[i].s, 0.0, segment.length())));
    }
    segment.at_parameters(batch);
    progress.work(n);
  };
  const auto local = [&](const LawPiece& piece) {
    LawPiece moved = piece;
    moved.s -= tool[piece.segment].s0();
    return moved;
  };

  double coarse = 0;
  for (const LawPiece& piece : law.pieces()) {
    const std::array<double, 2> ends{0.0, piece.duration};
    fill(local(piece), tool[piece.segment], 2, [&](std::size_t i) { return ends[i]; });
    for (std::size_t i = 0; i < 2; ++i) coarse = std::max(coarse, square(batch, i, state[i]));
  }
  PeakSweep peaks({std::max(coarsening * coarse, 1e-300)});
  std::optional<CurveDiscs> discs;
  std::size_t discs_of = tool.size();
  for (std::size_t p = 0; p < law.pieces().size(); ++p) {
    const LawPiece& piece = law.pieces()[p];
    const LawPiece here = local(piece);
    const Segment& segment = tool[piece.segment];
    if (piece.segment != discs_of) discs.emplace(segment.curve()), discs_of = piece.segment;
    peaks.sweep(0, piece.duration, false, p, [&](PeakSamples& samples) {
      const auto n = static_cast<std::size_t>(samples.rule.points);
      const double half = 0.5 * (samples.end - samples.begin);
      const LawPiece middle = moved(here, samples.begin + half);
      // The bound of every coordinate is one of the norms: it holds for the sum of their squares.
      if (discs->vanishing() == 0)
        samples.missing[0] = bounds_over_time(middle, half, discs->about(segment.parameter_at(middle.s)),
                                              samples.rule.points)[static_cast<std::size_t>(ChannelQuantity::jerk)];
      fill(here, segment, n, [&](std::size_t i) { return samples.at(static_cast<int>(i)); });
      for (std::size_t i = 0; i < n; ++i) samples.values[i] = square(batch, i, state[i]);
      return true;
    });
  }
  Worst worst;
  if (law.pieces().empty()) return worst;
  worst.value = peaks[0].finite ? std::sqrt(peaks[0].value) : std::numeric_limits<double>::quiet_NaN();
  worst.at = law.pieces()[peaks[0].tag].t0 + peaks[0].at;
  return worst;
}

}  // namespace bahnwerk::verify
