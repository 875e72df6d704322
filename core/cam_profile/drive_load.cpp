#include "core/cam_profile/drive_load.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/cam/bernstein.hpp"
#include "core/numeric/gauss_legendre.hpp"

namespace bahnwerk::cam {
namespace {

constexpr double pi = std::numbers::pi;

/// Sign of the motion: 0 at rest, a disc of all values where a part of the law turns back.
template <class S>
LawSeries<S> direction(const LawSeries<S>& y, double still);
template <>
LawSeries<double> direction(const LawSeries<double>& y, double still) {
  return LawSeries<double>(y.c[1] > still ? 1 : y.c[1] < -still ? -1 : 0);
}
template <>
LawSeries<Disc> direction(const LawSeries<Disc>& y, double still) {
  const Disc v = y.c[1];
  if (v.low() > still) return LawSeries<Disc>(1);
  if (v.high() < -still) return LawSeries<Disc>(-1);
  LawSeries<Disc> out;
  if (v.low() >= -still && v.high() <= still) return out;
  const double low = v.low() < -still ? -1 : 0, high = v.high() > still ? 1 : 0;
  out.c[0] = Disc((low + high) / 2, (high - low) / 2);
  out.c[1] = Disc(0, std::numeric_limits<double>::infinity());
  return out;
}

class Effort {
 public:
  Effort(const LinearLoad& load, const FollowerLaw& law, double still)
      : load_(load), rate_(law.angular_velocity()), still_(still / rate_) {
    // Positions of the law are counted from its lowest one.
    constant_ = load.constant + load.position * law.lowest();
  }
  template <class S>
  LawSeries<S> operator()(const LawSeries<S>& y) const {
    const LawSeries<S> v = derived(y);
    LawSeries<S> out = (load_.acceleration * rate_ * rate_) * derived(v) + (load_.velocity * rate_) * v +
                       load_.position * y + LawSeries<S>(constant_);
    if (load_.friction > 0) out = out + load_.friction * direction(y, still_);
    return out;
  }
  template <class S>
  LawSeries<S> power(const LawSeries<S>& y) const {
    return (load_.power * rate_) * ((*this)(y)*derived(y));
  }
  LoadPoint point(const LawSeries<double>& y, double at) const {
    return {at, (*this)(y).value(), load_.speed * rate_ * y.derivative(1), power(y).value()};
  }

 private:
  LinearLoad load_;
  double rate_, still_, constant_;
};

/// Calls part(from, to) for parts of a piece in each of which the slave does not turn back.
template <class F>
void parts_of_one_direction(const std::vector<double>& velocity, double still, double from, double to, F&& part) {
  const auto [low, high] = std::minmax_element(velocity.begin(), velocity.end());
  const bool one = *low >= still || *high <= -still || (*low >= -still && *high <= still);
  if (one || to - from < 1e-9) return part(from, to);
  std::vector<double> left(velocity.size()), right(velocity.size());
  bernstein_split(velocity, 0.5, left.data(), right.data());
  const double middle = from + (to - from) / 2;
  parts_of_one_direction(left, still, from, middle, part);
  parts_of_one_direction(right, still, middle, to, part);
}

}  // namespace

LinearLoad linear_load(const DriveLoad& given) {
  LinearLoad out;
  constexpr double degree = pi / 180, milli = 1e-3;
  // Force at the slave, N or N m, per unit of the law.
  out.acceleration = given.inertia * (given.rotary ? degree : milli);
  out.velocity = given.damping, out.position = given.spring;
  out.constant = given.force - given.spring * given.spring_zero;
  out.friction = given.friction;
  out.speed = given.rotary ? 1.0 / 6 : 1;  // 1/min, or mm/s
  out.power = given.rotary ? degree : milli;
  if (given.ratio > 0) {
    const double turn = given.rotary ? degree * given.ratio : 2 * pi / given.ratio;  // rad of the motor per unit
    const double share = given.rotary ? 1 / given.ratio : milli * given.ratio / (2 * pi);
    for (double* part : {&out.acceleration, &out.velocity, &out.position, &out.constant, &out.friction}) *part *= share;
    out.acceleration += given.motor_inertia * turn;
    out.speed = turn * 30 / pi;
    out.power = turn;
  } else if (given.rotary) {
    out.acceleration += given.motor_inertia * degree;
  }
  return out;
}

Range acceleration_within(const LinearLoad& load, double peak) {
  if (!(load.acceleration > 0)) return {};
  const double room = peak - load.friction;
  return {(-room - load.constant) / load.acceleration, (room - load.constant) / load.acceleration};
}

LoadFigures load_figures(const LinearLoad& load, const CamLaw& law, Progress progress) {
  const FollowerLaw over(law, 1);
  const double still = 1e-9 * law.peak(1).value;
  const Effort effort(load, over, still);
  LoadFigures out;
  const auto most = [&](auto&& function) {
    const CertifiedMaximum found = certified_maximum(over, function, 1e-12, progress);
    return CamExtreme{found.value, found.at};
  };
  const auto least = [&](auto&& function) {
    CamExtreme found = most([&](const LawSeries<Disc>& y) { return -function(y); });
    found.value = -found.value;
    return found;
  };
  const auto force = [&](const LawSeries<Disc>& y) { return effort(y); };
  const auto power = [&](const LawSeries<Disc>& y) { return effort.power(y); };
  out.most = most(force), out.least = least(force);
  out.most_power = most(power), out.least_power = least(power);

  double square = 0, work = 0;
  for (std::size_t i = 0; i < over.pieces(); ++i) {
    const auto sum = [&](double from, double to) {
      for (const GaussPoint& g : gauss_legendre<24>()) {
        const double x = from + (to - from) * (1 + g.place) / 2, weight = g.weight * (to - from) / 2 * over.width(i);
        const LoadPoint p = effort.point(over.at(i, x), 0);
        square += weight * p.effort * p.effort, work += weight * p.power;
      }
    };
    const double limit = load.friction > 0 ? still / over.angular_velocity() : HUGE_VAL;
    parts_of_one_direction(over.derivative(i, 1), limit, 0, 1, sum);
    const int steps = std::max(2, static_cast<int>(std::ceil(over.width(i) * 180 / pi)));
    for (int k = 0; k <= steps; ++k) {
      const double x = static_cast<double>(k) / steps;
      out.points.push_back(effort.point(over.at(i, x), over.begin(i) + x * over.width(i)));
    }
  }
  out.rms = std::sqrt(square / (2 * pi));
  out.mean_power = work / (2 * pi);
  return out;
}

}  // namespace bahnwerk::cam
