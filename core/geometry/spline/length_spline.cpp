#include "core/geometry/spline/length_spline.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/numeric/tridiagonal.hpp"

namespace bahnwerk {
namespace {

constexpr int deepest = 40;

struct Simpson {
  const BezierPiece& piece;
  std::vector<double>&parameters, &values;

  double speed(double v) const { return norm(place(piece.at(v)[1])); }
  static double rule(double width, double a, double c, double b) { return width / 6 * (a + 4 * c + b); }

  void add(double v, double length) {
    parameters.push_back(v);
    values.push_back(values.back() + length);
  }
  /// Integrates over [a, b] with the speeds at both ends and in the middle.
  void run(double a, double b, double fa, double fc, double fb, double tolerance, int depth) {
    const double c = (a + b) / 2, h = b - a;
    const double fl = speed((a + c) / 2), fr = speed((c + b) / 2);
    const double left = rule(h / 2, fa, fl, fc), right = rule(h / 2, fc, fr, fb);
    // The first halving is not trusted: both rules may agree by accident on a symmetric piece.
    if (depth == deepest || (depth > 0 && std::abs(left + right - rule(h, fa, fc, fb)) < 10 * tolerance)) {
      add(c, left);
      add(b, right);
      return;
    }
    run(a, c, fa, fl, fc, tolerance / 2, depth + 1);
    run(c, b, fc, fr, fb, tolerance / 2, depth + 1);
  }
};

/// Slopes of the C² cubic spline through the points with given slopes at both ends [de Boor, A Practical Guide to
/// Splines, IV].
std::vector<double> spline_slopes(const std::vector<double>& x, const std::vector<double>& y, double first,
                                  double last) {
  const std::size_t n = x.size();
  Tridiagonal matrix(n);
  std::vector<double> slopes(n);
  slopes.front() = first;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double a = 1 / (x[i] - x[i - 1]), b = 1 / (x[i + 1] - x[i]);
    matrix.below[i] = a, matrix.at[i] = 2 * (a + b), matrix.above[i] = b;
    slopes[i] = 3 * (a * a * (y[i] - y[i - 1]) + b * b * (y[i + 1] - y[i]));
  }
  slopes.back() = last;
  matrix.solve(slopes);
  return slopes;
}

}  // namespace

Rational place_curve(const BezierPiece& piece) {
  std::vector<Vec> points;
  std::vector<double> weights;
  for (const auto& p : piece.points()) {
    points.push_back(place(projected(p)));
    weights.push_back(p[spline_dimension]);
  }
  return Rational::bezier(points, weights);
}

LengthSpline::LengthSpline(const BezierPiece& piece, double tolerance) : parameters_{0}, values_{0} {
  if (!(tolerance >= 1e-12)) throw std::invalid_argument("tolerance of a length below 1e-12 mm");
  Simpson simpson{piece, parameters_, values_};
  const double first = simpson.speed(0), last = simpson.speed(1);
  simpson.run(0, 1, first, simpson.speed(0.5), last, tolerance, 0);
  slopes_ = spline_slopes(parameters_, values_, first, last);
}

double LengthSpline::at(double v) const {
  v = std::clamp(v, 0.0, 1.0);
  const auto after = std::upper_bound(parameters_.begin() + 1, parameters_.end() - 1, v);
  const auto i = static_cast<std::size_t>(after - parameters_.begin());
  const double h = parameters_[i] - parameters_[i - 1], t = (v - parameters_[i - 1]) / h;
  const double rise = values_[i] - values_[i - 1], a = h * slopes_[i - 1], b = h * slopes_[i];
  return values_[i - 1] + t * (a + t * (3 * rise - 2 * a - b + t * (a + b - 2 * rise)));
}

double LengthSpline::inverse(double length) const {
  length = std::clamp(length, 0.0, values_.back());
  const auto after = std::upper_bound(values_.begin() + 1, values_.end() - 1, length);
  const auto i = static_cast<std::size_t>(after - values_.begin());
  const double h = parameters_[i] - parameters_[i - 1], rise = values_[i] - values_[i - 1];
  const double a = h * slopes_[i - 1], b = h * slopes_[i], target = length - values_[i - 1];
  const double c2 = 3 * rise - 2 * a - b, c3 = a + b - 2 * rise;
  double low = 0, high = 1, t = rise > 0 ? target / rise : 0;
  for (int step = 0; step < 100; ++step) {
    const double off = t * (a + t * (c2 + t * c3)) - target, slope = a + t * (2 * c2 + t * 3 * c3);
    (off > 0 ? high : low) = t;
    double next = t - off / slope;
    if (!(next >= low && next <= high)) next = (low + high) / 2;
    if (std::abs(next - t) < 1e-16) break;
    t = next;
  }
  return parameters_[i - 1] + h * t;
}

}  // namespace bahnwerk
