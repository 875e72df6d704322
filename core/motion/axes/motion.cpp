#include "core/motion/axes/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace bahnwerk {

MotionState Motion::evaluate(double t, std::size_t& piece) const {
  const std::size_t n = pieces();
  if (!(piece < n && begin(piece) <= t && (piece + 1 == n || t < begin(piece + 1)))) {
    if (piece + 1 < n && begin(piece + 1) <= t && (piece + 2 == n || t < begin(piece + 2))) {
      ++piece;
    } else {
      std::size_t low = 0, high = n;  // the last one that begins at or before t
      while (high - low > 1) (begin((low + high) / 2) <= t ? low : high) = (low + high) / 2;
      piece = low;
    }
  }
  return in_piece(piece, std::clamp(t, begin(piece), end(piece)));
}

SumOfMotions::SumOfMotions(std::shared_ptr<const Motion> first, std::shared_ptr<const Motion> second)
    : first_(std::move(first)), second_(std::move(second)) {
  const double T = first_->duration(), rounding = 32 * std::numeric_limits<double>::epsilon() * T;
  if (first_->axes() != second_->axes() || !(std::abs(T - second_->duration()) <= rounding))
    throw std::invalid_argument("motions that are added have equally many axes and last equally long");
  for (std::size_t i = 0, j = 0;;) {
    begin_.push_back({std::max(first_->begin(i), second_->begin(j)), i, j});
    const double end1 = i + 1 < first_->pieces() ? first_->begin(i + 1) : T,
                 end2 = j + 1 < second_->pieces() ? second_->begin(j + 1) : T;
    if (end1 >= T && end2 >= T) break;
    if (end1 <= end2) ++i;
    if (end2 <= end1) ++j;
  }
}

MotionState SumOfMotions::in_piece(std::size_t piece, double t) const {
  MotionState sum = first_->in_piece(begin_[piece].first, t);
  const MotionState other = second_->in_piece(begin_[piece].second, t);
  for (std::size_t order = 0; order < MotionState::orders; ++order)
    for (std::size_t k = 0; k < axes(); ++k) sum[order][k] += other[order][k];
  return sum;
}

bool SumOfMotions::polynomial(std::size_t piece, std::size_t axis, Polynomial& out) const {
  const Begin& at = begin_[piece];
  Polynomial a, b;
  if (!first_->polynomial(at.first, axis, a) || !second_->polynomial(at.second, axis, b)) return false;
  out = shifted(std::move(a), at.t - first_->begin(at.first), 1) +
        shifted(std::move(b), at.t - second_->begin(at.second), 1);
  return true;
}

}  // namespace bahnwerk
