#include "core/motion/interpolation/interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/numeric/gauss_legendre.hpp"

namespace bahnwerk {
namespace {

constexpr std::size_t kept_rows = 256;
constexpr double least_share = 1e-3;  // part of the longest step that errors are related to at least

double arc(const Curve& curve, double from, double to) {
  const double middle = (from + to) / 2, half = (to - from) / 2;
  double sum = 0;
  for (const auto& [place, weight] : std::span(gauss_legendre<8>()).last<4>())  // the others lie opposite
    sum += weight * (curve.speed(middle - half * place) + curve.speed(middle + half * place));
  return half * sum;
}

/// Returns the length from one place to a later one.
double arc(const Path& path, const PathPlace& from, const PathPlace& to) {
  if (from.segment == to.segment) return arc(path[from.segment].curve(), from.u, to.u);
  double sum = arc(path[from.segment].curve(), from.u, path[from.segment].curve().end()) +
               arc(path[to.segment].curve(), path[to.segment].curve().begin(), to.u);
  for (std::size_t i = from.segment + 1; i < to.segment; ++i) sum += path[i].length();
  return sum;
}

struct Mean {
  double sum = 0, largest = 0;
  void add(double value) { sum += value, largest = std::max(largest, value); }
};

}  // namespace

Interpolation::Interpolation(std::shared_ptr<const PathMotion> motion, Interpolator interpolator, double cycle_time,
                             std::size_t cycles, ProgressScope& progress)
    : motion_(std::move(motion)),
      stepper_(motion_->path().tool(), interpolator, cycle_time),
      cycle_time_(cycle_time),
      cycles_(cycles) {
  measure(progress);
}

void Interpolation::law_at(Row& row) const {
  if (row.index == cycles_) {
    row.piece = motion_->pieces() - 1;
    row.law = {motion_->path().length(), 0, 0, 0};
    return;
  }
  const double t = static_cast<double>(row.index) * cycle_time_;
  row.piece = motion_->law().find(t, row.piece);
  row.law = motion_->along(row.piece, t);
}

void Interpolation::advance(Row& row) const {
  if (row.index == cycles_) return;
  Row after{row.index + 1, row.piece, {}, {}};
  law_at(after);
  after.place = after.index == cycles_ ? stepper_.end() : stepper_.next(row.place, row.law, after.law.s);
  row = after;
}

Interpolation::Row Interpolation::row(std::size_t index) const {
  Row row = kept_[index / kept_rows];
  while (row.index < index) advance(row);
  return row;
}

void Interpolation::measure(ProgressScope& progress) {
  const Path& path = motion_->path().tool();
  const double floor = least_share * peak_speed(motion_->law()) * cycle_time_;
  Mean along, chord;
  Row row{0, 0, stepper_.begin(), {}};
  law_at(row);
  kept_.reserve(cycles_ / kept_rows + 1);
  kept_.push_back(row);
  while (row.index < cycles_) {
    const Row from = row;
    advance(row);
    if (row.index % kept_rows == 0) kept_.push_back(row);
    const double aim = std::max(0.0, row.law.s - from.place.s), length = arc(path, from.place, row.place),
                 scale = std::max(aim, floor);
    const Vec way =
        path[row.place.segment].curve().at(row.place.u).value - path[from.place.segment].curve().at(from.place.u).value;
    along.add(std::abs(aim - length) / scale);
    chord.add(std::abs(aim - norm(way)) / scale);
    fluctuation_.drift += length - aim;
    fluctuation_.lag = std::max(fluctuation_.lag, std::abs(row.place.s - row.law.s));
    progress(row.index, cycles_);
  }
  const auto rows = static_cast<double>(cycles_);
  fluctuation_.mean = along.sum / rows, fluctuation_.largest = along.largest;
  fluctuation_.chord_mean = chord.sum / rows, fluctuation_.chord_largest = chord.largest;
}

}  // namespace bahnwerk
