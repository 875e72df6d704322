#include "core/motion/law/law_excess.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/numeric/peak.hpp"

namespace bahnwerk {
namespace {

// PeakSweep resolves 2e-11 of its scale: with this multiple of the peak for scale, 1e-7 of the peak.
constexpr double coarsening = 5e3;
constexpr std::array looked_at{0.0, 0.25, 0.5, 0.75,
                               1.0};  // places in a piece that are evaluated before peaks are searched

class LawExcess {
 public:
  LawExcess(const PathTask& task, const TimeLaw& law, const Limits& along, ProgressScope& progress)
      : task_(task), law_(law), along_(along), progress_(progress), axes_(task.path.axes()) {}

  double run() {
    along_the_path();
    at_joints();
    of_the_axes();
    return most_;
  }

 private:
  void exceed(double v, double a, double j, const Limits& limits) {
    most_ = std::max({most_, std::abs(v) / limits.velocity, std::sqrt(std::abs(a) / limits.acceleration),
                      std::cbrt(std::abs(j) / limits.jerk)});
  }

  /// Evaluates the limits along the path in closed form: v is a cubic, a a parabola, j linear.
  void along_the_path() {
    for (const LawPiece& piece : law_.pieces()) {
      const Limits limits{std::min(along_.velocity, task_.feeds[piece.segment]), along_.acceleration, along_.jerk};
      const auto look = [&](double tau) {
        if (!(tau >= 0 && tau <= piece.duration)) return;
        const LawState x = piece.at(tau);
        exceed(x.v, x.a, x.j, limits);
      };
      look(0), look(piece.duration);
      for (const double tau : turning_points(piece)) look(tau);
    }
  }

  void at_joints() {
    const auto& pieces = law_.pieces();
    const double cycle = task_.machine.cycle_time;
    for (std::size_t i = 1; i < pieces.size(); ++i) {
      const LawPiece &left = pieces[i - 1], &right = pieces[i];
      if (left.segment == right.segment || task_.rests[right.segment]) continue;
      const AxisJet before = task_.path.at_parameter(left.segment, task_.path[left.segment].curve().end());
      const AxisJet after = task_.path.at_parameter(right.segment, task_.path[right.segment].curve().begin());
      for (std::size_t k = 0; k < axes_; ++k) {
        const AxisLimits& axis = task_.machine.axes[k];
        const double turn = after.d1[k] - before.d1[k];
        const double jump = (after.d2[k] - before.d2[k]) * right.v * right.v + turn * right.a;
        most_ = std::max({most_, std::abs(turn) * right.v / (axis.acceleration * cycle),
                          std::sqrt(std::abs(jump) / (axis.jerk * cycle))});
      }
    }
  }

  void of_the_axes() {
    PathBatch batch;
    std::array<LawState, PathBatch::most> state;
    // Values at n ≤ PathBatch::most times tau(i) of a piece, to put(channel, i, value): 3 channels per axis.
    const auto evaluate = [&](const LawPiece& piece, std::size_t n, auto&& tau, auto&& put) {
      const Segment& segment = task_.path[piece.segment];
      LawPiece local = piece;
      local.s -= segment.s0();  // far along a path the rounding of s would show as noise
      batch.count = n;
      batch.planar = false;
      for (std::size_t i = 0; i < n; ++i) {
        state[i] = local.at(tau(i));
        batch.u.set(i, std::clamp(segment.parameter_at(std::clamp(state[i].s, 0.0, piece.s_end - segment.s0())),
                                  segment.curve().begin(), segment.curve().end()));
      }
      task_.path.at_parameters(piece.segment, batch);
      for (std::size_t k = 0; k < axes_; ++k) {
        const bool still = batch.planar && k >= 2;
        for (std::size_t i = 0; i < n; ++i) {
          const double v = state[i].v, a = state[i].a, j = state[i].j;
          const double d1 = still ? 0 : batch.d1[k][i], d2 = still ? 0 : batch.d2[k][i],
                       d3 = still ? 0 : batch.d3[k][i];
          put(3 * k, i, d1 * v);
          put(3 * k + 1, i, d2 * v * v + d1 * a);
          put(3 * k + 2, i, (d3 * v * v + 3 * d2 * a) * v + d1 * j);
        }
      }
      progress_.work(2 * n);
    };

    std::vector<double> coarse(3 * axes_, 0.0);
    for (const LawPiece& piece : law_.pieces())
      evaluate(
          piece, looked_at.size(), [&](std::size_t i) { return looked_at[i] * piece.duration; },
          [&](std::size_t channel, std::size_t, double value) {
            coarse[channel] = std::max(coarse[channel], std::abs(value));
          });
    std::vector<double> scales;
    for (const double peak : coarse) scales.push_back(std::max(coarsening * peak, 1e-300));
    PeakSweep peaks(scales);
    for (std::size_t c = 0; c < coarse.size(); ++c) peaks.raise(c, coarse[c], 0, 0);
    for (std::size_t i = 0; i < law_.pieces().size(); ++i) {
      const LawPiece& piece = law_.pieces()[i];
      peaks.sweep(0, piece.duration, false, i, [&](PeakSamples& samples) {
        const auto n = static_cast<std::size_t>(samples.rule.points);
        evaluate(
            piece, n, [&](std::size_t at) { return samples.at(static_cast<int>(at)); },
            [&](std::size_t channel, std::size_t at, double value) { samples.values[channel * n + at] = value; });
        return true;
      });
    }
    for (std::size_t k = 0; k < axes_; ++k)
      exceed(peaks[3 * k].value, peaks[3 * k + 1].value, peaks[3 * k + 2].value, task_.machine.axes[k]);
  }

  const PathTask& task_;
  const TimeLaw& law_;
  const Limits& along_;
  ProgressScope& progress_;
  std::size_t axes_;
  double most_ = 0;
};

}  // namespace

double law_excess(const PathTask& task, const TimeLaw& law, const Limits& along, ProgressScope& progress) {
  return LawExcess(task, law, along, progress).run();
}

}  // namespace bahnwerk
