#pragma once
/// Looks between the nodes: peaks of every cell, shares of limits, and what a section has to be slowed by.
#include <algorithm>
#include <cmath>

#include "core/motion/jerk/section.hpp"
#include "core/numeric/peak.hpp"

namespace bahnwerk {

using jerk_section_detail::sure;

namespace {

/// Least share. Where an axis reverses, its jerk inside a cell depends only weakly on its jerk at both ends: a smaller
/// share does not help, a smaller cell does.
constexpr double min_share = 0.5;
/// A peak from which on shares are not even tried, and one for which they are.
constexpr double hopeless = 1.15, bearable = 1.05;
/// Peaks, in relation to their limits, are found to the first of these: rounding shows in the jerk of a fine cell long
/// before 1e-11, and would be halved on and on. What stays below the second keeps its limit.
constexpr double resolved = 1e-8, kept = 1 - 1e-7;

}  // namespace

template <int N, int M>
void JerkSectionPlanner<N, M>::look_half_way(ProgressScope& progress) {
  const std::size_t n = grid_.cells.size();
  shape_.resize(n);
  for (std::size_t c = 0; c < n; ++c) {
    progress(c, n);
    if (grid_.cells[c].straight) continue;
    const Station<N> at = path_.at(grid_.cells[c].segment, 0.5 * (grid_.left(c).u + grid_.right(c).u));
    const JerkStation<M>* ends = &problem_.stations[problem_.cells[c].station];
    shape_[c] = CellPath<M>(ends[0], rows_of(at), ends[1], at.s - grid_.left(c).s, grid_.length(c));
  }
}

template <int N, int M>
CellPeaks<M> JerkSectionPlanner<N, M>::peaks_of(std::size_t c, bool exact) const {
  const RowLimits<M>& limit = exact ? limit_ : soft_;
  const double h = grid_.length(c), f = feed(c);
  const LawPiece law = jerk_piece(state_[c], state_[c + 1], h);
  const JerkStation<M>&l = problem_.stations[problem_.cells[c].station],
        &r = problem_.stations[problem_.cells[c].station + 1];
  const std::size_t segment = grid_.cells[c].segment;
  const auto peaks = [&](auto&& at) { return cell_peaks(law, CellPlaces{l, r, h, at}, limit, 1 / (f * f)); };
  if (grid_.cells[c].straight) return peaks([&](double) { return l; });
  if (exact)
    return peaks([&](double s) {
      return rows_of(path_.derivatives(segment, path_[segment].parameter_at(looked_at(segment, grid_.left(c).s + s))));
    });
  return peaks([&](double s) { return shape_[c].at(s); });
}

template <int N, int M>
void JerkSectionPlanner<N, M>::measure(bool exact, ProgressScope& progress) {
  const std::size_t n = grid_.cells.size();
  peaks_.resize(n);
  certain_ = exact;
  worst_ = {};
  for (std::size_t c = 0; c < n; ++c) {
    progress(c, n);
    raise(peaks_[c] = peaks_of(c, exact));
  }
}

template <int N, int M>
void JerkSectionPlanner<N, M>::certify(ProgressScope& progress) {
  if (!certain_) measure(true, progress);  // a model of the path is good enough to plan by, not to vouch for
  worst_ = {};
  PeakSweep sweep(std::vector<double>(3 * M, 1.0), resolved);
  for (std::size_t k = 0; k < 3 * M; ++k) sweep.raise(k, kept, 0, 0);  // no peak below this value is searched for
  const std::size_t n = grid_.cells.size();
  for (std::size_t c = 0; c < n; ++c) {
    progress(c, n);
    if (peaks_[c].doubt > sure) {
      LawPiece law = jerk_piece(state_[c], state_[c + 1], grid_.length(c));
      if (!(law.duration > 0) || !std::isfinite(law.duration)) continue;  // emit() refuses the section
      const std::size_t segment = grid_.cells[c].segment;
      // Next to a cusp rounded positions say nothing of curvature; the verifier counts from there (LocalPlaces).
      const bool cusp = path_[segment].cusp_begin() || path_[segment].cusp_end();
      const double origin = cusp ? 0 : path_[segment].s0();
      law.s = origin + grid_.left(c).s;
      const bool open = grid_.cells[c].cusp_left || grid_.cells[c].cusp_right;
      sweep.sweep(0, law.duration, open, c, [&](PeakSamples& samples) {
        const auto points = static_cast<std::size_t>(samples.rule.points);
        double* values = samples.values;
        for (std::size_t i = 0; i < points; ++i) {
          const LawState x = law.at(samples.begin + samples.rule.node[i] * (samples.end - samples.begin));
          const JerkStation<M> d =
              rows_of(path_.derivatives(segment, path_[segment].parameter_at(looked_at(segment, x.s - origin))));
          const double b = x.v * x.v;
          for (std::size_t k = 0; k < M; ++k) {
            values[k * points + i] = d.d1[k] * d.d1[k] * b * limit_.inverse_velocity2[k];
            values[(M + k) * points + i] = (d.d2[k] * b + d.d1[k] * x.a) * limit_.inverse_acceleration[k];
            values[(2 * M + k) * points + i] =
                (d.d3[k] * b * x.v + 3 * d.d2[k] * x.v * x.a + d.d1[k] * x.j) * limit_.inverse_jerk[k];
          }
        }
        return true;
      });
      const double f = feed(c);
      worst_.v = std::max(worst_.v, peak_speed2(law) / (f * f));
    } else {
      raise(peaks_[c]);
    }
    if (c > 0) worst_.v = std::max(worst_.v, state_[c].b / cap_[c]);
  }
  if (exit_.b > 0) worst_.v = std::max(worst_.v, exit_.b / cap_[n]);
  for (const auto& rows : problem_.nodes)
    for (std::size_t k = 0; k < M; ++k)
      worst_.a = std::max(worst_.a, std::abs(rows.p[k] * state_[rows.node].b + rows.q[k] * state_[rows.node].a));
  const auto bound = [](double peak) { return peak > kept ? 1 + 1.5 * (peak - kept) : peak; };
  for (std::size_t k = 0; k < M; ++k) {
    worst_.v = std::max(worst_.v, bound(sweep[k].value));
    worst_.a = std::max(worst_.a, bound(sweep[M + k].value));
    worst_.j = std::max(worst_.j, bound(sweep[2 * M + k].value));
  }
}

template <int N, int M>
bool JerkSectionPlanner<N, M>::mark_unresolved_cells() {
  const std::size_t n = grid_.cells.size();
  bool any = false;
  division_.resize(n);
  for (std::size_t c = 0; c < n; ++c)
    for (std::size_t k = 0; k < M; ++k)
      if (peaks_[c].jerk[k] > hopeless ||
          (peaks_[c].jerk[k] > bearable &&
           std::min(problem_.cells[c].share[0][k], problem_.cells[c].share[1][k]) <= min_share)) {
        division_[c].parts = std::max<std::uint16_t>(division_[c].parts, 4);
        any = true;
      }
  return any;
}

template <int N, int M>
void JerkSectionPlanner<N, M>::tighten(double times, bool acceleration) {
  const std::size_t n = grid_.cells.size();
  const auto less = [&](double peak) { return peak > sure ? sure / (sure + times * (peak - sure)) : 1.0; };
  for (auto& rows : problem_.nodes)
    for (std::size_t k = 0; k < M && acceleration; ++k)
      rows.share[k] *= less(std::max(peaks_[rows.node - 1].acceleration[k], peaks_[rows.node].acceleration[k]));
  for (auto& rows : problem_.middles)
    for (std::size_t k = 0; k < M && acceleration; ++k) rows.share[k] *= less(peaks_[rows.cell].acceleration[k]);
  for (std::size_t c = 0; c < n; ++c) {
    for (auto& share : problem_.cells[c].share)
      for (std::size_t k = 0; k < M; ++k)
        share[k] = std::max(std::min(min_share, share[k]), share[k] * less(peaks_[c].jerk[k]));
    if (c > 0) {
      problem_.inverse_cap[c][0] /= less(peaks_[c - 1].velocity);
      problem_.inverse_cap[c][1] /= less(peaks_[c].velocity);
    }
  }
}

}  // namespace bahnwerk
