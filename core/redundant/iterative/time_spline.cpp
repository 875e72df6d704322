#include "core/redundant/iterative/time_spline.hpp"

#include <algorithm>

namespace bahnwerk {

TimeSpline::Coefficients TimeSpline::from(std::size_t i, double t) const {
  Coefficients c = pieces_[i].coefficients;
  const double by = t - pieces_[i].begin;
  for (std::size_t k = 0; k < max_spline_degree; ++k)
    for (std::size_t r = max_spline_degree; r-- > k;) c[r] += by * c[r + 1];
  return c;
}

AxisState TimeSpline::in_piece(std::size_t i, double t) const {
  const Coefficients c = from(i, t);
  return {c[0], c[1], 2 * c[2], 6 * c[3]};
}

void TimeSpline::append(const TimeSpline& other, double until, double end) {
  const double shift = end_;
  for (std::size_t i = 0; i < other.pieces() && other.begin(i) < until; ++i)
    append(shift + std::min(until, other.end(i)), other.coefficients(i));
  end_ = end;
}

void TimeSpline::slow(double factor) {
  for (Piece& piece : pieces_) {
    piece.begin *= factor;
    double power = 1;
    for (double& c : piece.coefficients) c /= power, power *= factor;
  }
  end_ *= factor;
}

}  // namespace bahnwerk
