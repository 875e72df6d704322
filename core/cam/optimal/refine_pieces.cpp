#include "core/cam/optimal/refine_pieces.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk::cam {
namespace {

constexpr double change = 0.1;       // part of the largest jerk by which it changes at a piece that is halved
constexpr double hidden = 1e-6;      // part of a usual derivative that rounding may hide in a piece
constexpr double kept = 1e-10;       // part of the largest acceleration that rounding may hide at a joint of pieces
constexpr double least_ramp = 1e-3;  // fraction of a section below which no piece is halved where no jerk is limited
constexpr std::size_t jerk_order = 3;

struct PieceJerk {
  double first, last, lowest, highest;
};

/// Returns the jerk of the pieces of a section, none of a section that is given.
std::vector<PieceJerk> jerk_of(const LawTask& task, const LawBasis& basis, const SplineResult& spline,
                               std::size_t section) {
  std::vector<PieceJerk> out;
  if (task.is_given(section) || task.constant_velocity(section)) return out;
  const SectionBasis& own = basis.section(section);
  const double length = spline.breaks[section + 1] - spline.breaks[section], power = std::pow(length, -3);
  std::vector<double> b(own.degree() - jerk_order + 1);
  for (std::size_t piece = 0; piece < own.pieces(); ++piece) {
    own.bernstein(piece, spline.coefficients.data() + basis.first(section), jerk_order, b.data());
    const auto [low, high] = std::minmax_element(b.begin(), b.end());
    out.push_back({power * b.front(), power * b.back(), power * *low, power * *high});
  }
  return out;
}

}  // namespace

LawBasis halve_at_changes(const LawTask& task, const LawBasis& basis, const SplineResult& spline) {
  std::vector<std::vector<PieceJerk>> jerk;
  double peak = 0;
  for (std::size_t s = 0; s < task.sections(); ++s) {
    jerk.push_back(jerk_of(task, basis, spline, s));
    for (const PieceJerk& each : jerk.back()) peak = std::max({peak, each.highest, -each.lowest});
  }
  const double least = change * peak, shortest = task.weight[jerk_order] > 0 ? 0 : least_ramp;
  std::vector<std::vector<double>> breaks;
  for (std::size_t s = 0; s < task.sections(); ++s) {
    const SectionBasis& own = basis.section(s);
    const double length = spline.breaks[s + 1] - spline.breaks[s];
    const int order = kept_order(task, s);
    const double most = hidden * LawTask::usual_peaks[static_cast<std::size_t>(order)];
    breaks.push_back({0});
    for (std::size_t i = 0; i < own.pieces(); ++i) {
      const double half = own.length(i) / 2;
      if (!jerk[s].empty() && half >= shortest &&
          published_rounding(task, static_cast<int>(own.degree()), length * half, 2) <= kept * spline.peaks[2] &&
          published_rounding(task, static_cast<int>(own.degree()), length * half, order) <= most) {
        const PieceJerk& here = jerk[s][i];
        const double before = i > 0 ? std::abs(here.first - jerk[s][i - 1].last) : 0;
        const double behind = i + 1 < own.pieces() ? std::abs(jerk[s][i + 1].first - here.last) : 0;
        if (std::max({before, behind, here.highest - here.lowest}) > least)
          breaks.back().push_back(own.begin(i) + half);
      }
      breaks.back().push_back(own.breaks()[i + 1]);
    }
  }
  return {static_cast<int>(basis.degree()), breaks};
}

}  // namespace bahnwerk::cam
