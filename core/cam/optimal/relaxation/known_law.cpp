#include "core/cam/optimal/relaxation/known_law.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/cam/optimal/task/extrema.hpp"

namespace bahnwerk::cam {

KnownLaw::KnownLaw(const LawTask& task, const LawBasis& basis, const SplineResult& spline)
    : points_(task.points()),
      cycle_(task.cycle),
      periodic_(task.periodic),
      travel_(task.travel),
      objective_(spline.objective),
      peaks_(spline.peaks) {
  for (std::size_t i = 0; i < points_.size(); ++i) points_[i] = {spline.breaks[i], spline.breaks[i]};
  std::vector<double> b(basis.degree() + 1);
  for (std::size_t section = 0; section < task.sections(); ++section) {
    if (task.is_given(section)) {
      const GivenSection& given = task.given[section]->law;
      const double begin = spline.breaks[section], whole = spline.breaks[section + 1] - begin;
      for (std::size_t i = 0; i < given.bernstein.size(); ++i)
        pieces_.push_back(
            {begin + whole * given.breaks[i], whole * (given.breaks[i + 1] - given.breaks[i]), given.bernstein[i]});
      continue;
    }
    const SectionBasis& own = basis.section(section);
    const double length = spline.breaks[section + 1] - spline.breaks[section];
    for (std::size_t piece = 0; piece < own.pieces(); ++piece) {
      own.bernstein(piece, spline.coefficients.data() + basis.first(section), 0, b.data());
      pieces_.push_back({spline.breaks[section] + length * own.begin(piece), length * own.length(piece), b});
    }
  }
  for (int r = 1; r < limited_orders; ++r) {
    if (task.weight[static_cast<std::size_t>(r)] > 0) continue;
    for (const Piece& piece : pieces_)
      for (const double v : {0.0, 0.25, 0.5, 0.75, 1.0})
        peaks_[static_cast<std::size_t>(r)] =
            std::max(peaks_[static_cast<std::size_t>(r)], std::abs(value(piece.begin + v * piece.length, r, v == 1.0)));
  }
}

KnownLaw::KnownLaw(const LawTask& task, const CamLaw& law, const std::vector<double>& at, double objective)
    : cycle_(task.cycle), periodic_(task.periodic), travel_(task.travel), objective_(objective), peaks_{} {
  for (const double time : at) points_.push_back({time, time});
  for (int r = 1; r < limited_orders; ++r) peaks_[static_cast<std::size_t>(r)] = law.peak(r).value * task.to_task(r);
  for (std::size_t i = 0; i < law.pieces(); ++i) {
    std::vector<double> b = law.piece(i).bernstein;
    for (double& each : b) each = (each - task.origin) / task.unit_position;
    pieces_.push_back(
        {(law.breaks()[i] - law.begin()) / task.unit_time, law.piece_duration(i) / task.unit_time, std::move(b)});
  }
}

double KnownLaw::value(double t, int order, bool before) const {
  double moved = 0;
  if (periodic_) {
    if (t > pieces_.front().begin + cycle_ * (1 + 1e-12)) t -= cycle_, moved += travel_;
    if (t < pieces_.front().begin) t += cycle_, moved -= travel_;
  }
  std::size_t i = 0;
  while (i + 1 < pieces_.size() &&
         (before ? t > pieces_[i + 1].begin + 1e-12 * cycle_ : t >= pieces_[i + 1].begin - 1e-12 * cycle_))
    ++i;
  std::vector<double> b = pieces_[i].bernstein;
  for (int r = 0; r < order; ++r) {
    differentiate_bernstein(b);
    for (double& each : b) each /= pieces_[i].length;
  }
  return evaluate_bernstein(b, std::clamp((t - pieces_[i].begin) / pieces_[i].length, 0.0, 1.0)) +
         (order == 0 ? moved : 0);
}

}  // namespace bahnwerk::cam
