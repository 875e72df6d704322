#include "core/probe/straight/motion_writer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace bahnwerk::probe {

MotionWriter::MotionWriter(const ProbeProblem& problem) : problem_(problem), position_(problem.points.front()) {
  out_.times.push_back(0);
}

void MotionWriter::add(double duration, Vec v, Vec a, Vec j, Vec snap) {
  const std::array coefficients{position_, v, a / 2, j / 6, snap / 24};
  add(duration, coefficients);
}

void MotionWriter::add(double duration, std::span<const Vec> coefficients, PieceJoint joint) {
  TimeSum next = sum_;
  next.add(duration);
  const double end = next.value();
  if (!(end > time_)) return;
  sum_ = next;
  out_.durations.push_back(duration);
  out_.joints.push_back(joint);
  SplineMotion::Piece piece{end, std::vector<Polynomial>(problem_.dimension())};
  for (std::size_t k = 0; k < problem_.dimension(); ++k) {
    Polynomial& p = piece.axes[k];
    p.resize(coefficients.size());
    p[0] = position_[k];
    for (std::size_t i = 1; i < coefficients.size(); ++i) p[i] = coefficients[i][k];
    while (p.size() > 1 && p.back() == 0) p.pop_back();
    position_[k] = evaluate(p, end - time_);
  }
  time_ = end;
  pieces_.push_back(std::move(piece));
}

MotionWriter::State MotionWriter::carry() {
  State out{position_, {}, {}, {}};
  if (pieces_.empty()) return out;
  const double x = pieces_.back().end - (pieces_.size() > 1 ? pieces_[pieces_.size() - 2].end : 0);
  sum_.add(x - out_.durations.back());  // the sum of all durations stays the time
  out_.durations.back() = x;
  for (std::size_t k = 0; k < problem_.dimension(); ++k) {
    const std::array<double, 4> end = state_at(pieces_.back().axes[k], x);
    out.v[k] = end[1], out.a[k] = end[2], out.j[k] = end[3];
  }
  return out;
}

void MotionWriter::aim(Vec position) {
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  for (std::size_t k = 0; k < problem_.dimension(); ++k)
    if (std::abs(position[k] - position_[k]) <= rounding * std::abs(position[k])) position_[k] = position[k];
}

ProbeMotion MotionWriter::finish() {
  out_.times.push_back(time_);
  out_.motion = std::make_shared<const SplineMotion>(std::move(pieces_));
  return std::move(out_);
}

}  // namespace bahnwerk::probe
