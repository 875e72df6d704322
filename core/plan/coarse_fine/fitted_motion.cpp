#include "core/plan/coarse_fine/fitted_motion.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace bahnwerk {

FittedMotion::FittedMotion(std::shared_ptr<const Motion> motion, double factor, const TimeLaw& law,
                           std::vector<double> still, int rest)
    : motion_(std::move(motion)), factor_(factor), duration_(law.duration()), still_(std::move(still)) {
  if (axes() > max_axes) throw std::invalid_argument("a motion has eight axes at most");
  constexpr double same =
      64 *
      std::numeric_limits<double>::epsilon();  // largest relative difference of times that rounding makes of equal ones
  begin_.reserve(motion_->pieces());
  std::size_t i = 0;
  for (std::size_t piece = 0; piece < motion_->pieces(); ++piece) {
    double t = motion_->begin(piece) * factor_;
    while (i + 1 < law.pieces().size() && law.pieces()[i + 1].t0 <= t) ++i;
    for (const std::size_t near : {i, i + 1})
      if (near < law.pieces().size() && std::abs(law.pieces()[near].t0 - t) <= same * t) t = law.pieces()[near].t0;
    begin_.push_back(t);
  }
  end_at_rest(rest);
}

void FittedMotion::end_at_rest(int rest) {
  const double h = duration_ - begin_.back();
  std::vector<Polynomial> corrected(motion_->axes());
  for (std::size_t k = 0; k < corrected.size(); ++k) {
    Polynomial p;
    if (!polynomial(pieces() - 1, k, p)) continue;
    const Polynomial dp = derivative(p);
    const double v = bahnwerk::evaluate(dp, h), a = bahnwerk::evaluate(derivative(dp), h);
    if (rest == 1)
      p = p + Polynomial{0, 0, -v / (2 * h)};
    else  // e = α τ³ + β τ⁴ with e′(h) = −v, e″(h) = −a
      p = p + Polynomial{0, 0, 0, (a * h - 3 * v) / (3 * h * h), (2 * v - a * h) / (4 * h * h * h)};
    corrected[k] = std::move(p);
  }
  last_ = std::move(corrected);
}

MotionState FittedMotion::in_piece(std::size_t piece, double t) const {
  MotionState state = motion_->in_piece(piece, motion_->begin(piece) + (t - begin_[piece]) / factor_);
  const std::size_t moving = motion_->axes();
  double power = factor_;
  for (std::size_t order = 1; order < MotionState::orders; ++order, power *= factor_)
    for (std::size_t k = 0; k < moving; ++k) state[order][k] /= power;
  if (piece + 1 == pieces())
    for (std::size_t k = 0; k < last_.size(); ++k) {
      if (last_[k].empty()) continue;
      Polynomial p = last_[k];
      for (std::size_t order = 0; order < MotionState::orders; ++order, p = derivative(p))
        state[order][k] = bahnwerk::evaluate(p, t - begin_[piece]);
    }
  for (std::size_t k = 0; k < still_.size(); ++k) state[0][moving + k] = still_[k];
  return state;
}

MotionState FittedMotion::final_state() const {
  MotionState state;
  state[0] = in_piece(pieces() - 1, duration_)[0];
  return state;
}

bool FittedMotion::polynomial(std::size_t piece, std::size_t axis, Polynomial& out) const {
  if (axis >= motion_->axes()) {
    out = {still_[axis - motion_->axes()]};
    return true;
  }
  if (piece + 1 == pieces() && !last_.empty() && !last_[axis].empty()) {
    out = last_[axis];
    return true;
  }
  if (!motion_->polynomial(piece, axis, out)) return false;
  double power = 1;
  for (double& c : out) c /= power, power *= factor_;
  return true;
}

}  // namespace bahnwerk
