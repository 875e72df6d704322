#include "core/redundant/iterative/coarse_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bahnwerk {
namespace {

constexpr double apart = 1e-11;    // s: knots that are closer are merged
constexpr double made_up = 1e-10;  // largest share of a limit for the correction of rounding

AxisState at(const TimeSpline::Coefficients& c, double h) {
  AxisState s;
  double a = 0;  // half of the acceleration
  for (std::size_t i = c.size(); i-- > 0;) {
    a = a * h + s.v;
    s.v = s.v * h + s.x;
    s.x = s.x * h + c[i];
  }
  s.a = 2 * a;
  return s;
}

/// Builds one axis piece by piece; each piece continues where the one before ended.
class Continued {
 public:
  explicit Continued(const Limits& limits) : limits_(limits), jerk_(limits.jerk < unlimited) {}

  TimeSpline::Coefficients next(TimeSpline::Coefficients c, double h) {
    const AxisState end = at(c, h);
    if (begun_) {
      c[0] = state_.x, c[1] = state_.v;
      if (jerk_) c[2] = 0.5 * state_.a;
    }
    begun_ = true;
    state_ = at(c, h);
    const double x = end.x - state_.x, v = (end.v - state_.v) * h, a = (end.a - state_.a) * h * h;
    // Powers of time/h, from the second or third on, that change the values at the end by the difference and nothing at
    // the begin.
    TimeSpline::Coefficients e{};
    double most = 0;
    if (jerk_) {
      e[3] = 10 * x - 4 * v + 0.5 * a, e[4] = -15 * x + 7 * v - a, e[5] = 6 * x - 3 * v + 0.5 * a;
      most = (6 * std::abs(e[3]) + 24 * std::abs(e[4]) + 60 * std::abs(e[5])) / (h * h * h) / limits_.jerk;
    } else {
      e[2] = 3 * x - v, e[3] = v - 2 * x;
      most = (2 * std::abs(e[2]) + 6 * std::abs(e[3])) / (h * h) / limits_.acceleration;
    }
    if (!(most <= made_up)) return c;
    double power = 1;
    for (std::size_t i = 0; i < c.size(); ++i, power *= h) c[i] += e[i] / power;
    state_ = at(c, h);
    return c;
  }

 private:
  Limits limits_;
  bool jerk_;
  bool begun_ = false;
  AxisState state_;  // state at the end of the piece before
};

}  // namespace

std::shared_ptr<const SplineMotion> coarse_motion(const std::vector<TimeSpline>& axes, double duration,
                                                  const std::vector<Limits>& limits) {
  std::vector<double> ends;
  for (const TimeSpline& axis : axes)
    for (std::size_t i = 0; i < axis.pieces(); ++i) ends.push_back(axis.end(i));
  std::sort(ends.begin(), ends.end());
  std::vector<SplineMotion::Piece> pieces;
  std::vector<std::size_t> piece_of(axes.size(), 0);
  std::vector<Continued> continued(limits.begin(), limits.end());
  double begin = 0;
  ends.push_back(duration);
  for (double end : ends) {
    const bool last = end >= duration - apart;
    if (last) end = duration;
    if (!(end > begin + apart) && !(last && end > begin)) continue;
    SplineMotion::Piece piece;
    piece.end = end;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      piece_of[k] = axes[k].find(0.5 * (begin + end), piece_of[k]);
      TimeSpline::Coefficients c = axes[k].from(piece_of[k], begin);
      if (!limits.empty()) c = continued[k].next(c, end - begin);
      piece.axes.emplace_back(c.begin(), c.end());
    }
    pieces.push_back(std::move(piece));
    begin = end;
    if (last) break;
  }
  return std::make_shared<const SplineMotion>(std::move(pieces));
}

}  // namespace bahnwerk
