#include "core/verify/probe/edge_newton.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {

template <int D>
bool EdgeNewton<D>::step(const EdgeIterate<D>& at, double mu, double curvature, double damping) {
  tg_ = 1, extra_ = 0, residual_ = 0;
  work_.setZero();
  height_ = 0;
  for (std::size_t k = 0; k < samples_.count(); ++k) {
    if (!samples_.fixed(k)) tube_rows(at, k, mu);
    for (std::size_t r = 1; r <= 4; ++r)
      if (k < samples_.rows(r) && samples_.free_row(r, k)) difference_rows(at, r, k, mu, curvature);
    reduce(k);
    if (!take(k)) return false;
  }
  double both = 0;
  for (std::size_t k = 0; k < samples_.count(); ++k)
    for (int i = 0; i < D; ++i) both += factor_[k](i, 5 * D) * factor_[k](i, 5 * D + 1);
  const double schur = (residual_ + extra_) * (1 + damping);
  if (!(schur > 0)) return false;
  dtau_ = (-tg_ - both) / schur;
  substitute_back();
  return std::isfinite(dtau_);
}

// Row of J: the difference's value times `weight`; right-hand sides of the step and of the border.
template <int D>
void EdgeNewton<D>::put(std::size_t r, std::size_t k, double power, const Point& weight, double step, double border) {
  const int i = static_cast<int>(height_++);
  for (std::size_t m = 0; m <= r; ++m) {
    if (samples_.fixed(k + m)) continue;
    const double f = samples_.row(r, k)[m] * power;
    for (int a = 0; a < D; ++a) work_(i, static_cast<int>(m) * D + a) = f * weight[a];
  }
  work_(i, 5 * D) = step;
  work_(i, 5 * D + 1) = border;
}

template <int D>
void EdgeNewton<D>::tube_rows(const EdgeIterate<D>& at, std::size_t k, double mu) {
  bool cap;
  Point u;
  const Point d = samples_.offset(k, at.x[k], cap, u);
  const double r2 = samples_.radius(k) * samples_.radius(k), l = at.dual[k], g = at.slack[k];
  const double round = std::sqrt(2 * l / r2), steep = std::sqrt(l / g);
  for (int a = 0; a < D; ++a) {
    const int i = static_cast<int>(height_++);
    for (int b = 0; b < D; ++b) work_(i, b) = round * ((a == b) - (cap ? 0.0 : u[a] * u[b]));
  }
  const int i = static_cast<int>(height_++);
  for (int b = 0; b < D; ++b) work_(i, b) = -2 * d[b] / r2 * steep;
  work_(i, 5 * D) = mu / (g * steep);
}

template <int D>
void EdgeNewton<D>::difference_rows(const EdgeIterate<D>& at, std::size_t r, std::size_t k, double mu,
                                    double curvature) {
  double power = 1 / at.h;
  for (std::size_t i = 2; i <= r; ++i) power /= at.h;
  const double order = static_cast<double>(r);
  const Point q = samples_.value(at.x, r, k, power);
  if (r == 1) {
    const double v2 = samples_.problem().speed * samples_.problem().speed, l = at.dual[samples_.speed_slack(k)],
                 g = at.slack[samples_.speed_slack(k)];
    const double round = std::sqrt(2 * l / v2), steep = std::sqrt(l / g);
    double along = 0;
    for (int a = 0; a < D; ++a) {
      Point unit{};
      unit[a] = round;
      put(r, k, power, unit, 0, -order * (1 + curvature) * round * q[a]);
      extra_ -= order * order * (curvature + curvature * curvature) * round * round * q[a] * q[a];
      along += q[a] * q[a];
    }
    Point grad;
    for (int a = 0; a < D; ++a) grad[a] = -2 * q[a] / v2 * steep;
    put(r, k, power, grad, mu / (g * steep), 2 * order * along / v2 * steep);
    tg_ -= order * mu / g * 2 * along / v2;
    return;
  }
  for (int a = 0; a < D; ++a) {
    const std::size_t s = samples_.axis_slack(r, k, a);
    const double scale = 1 / samples_.problem().derivative[r - 2][a];
    const double w = std::sqrt(at.dual[s] / at.slack[s] + at.dual[s + 1] / at.slack[s + 1]) * scale;
    const double force = mu * (1 / at.slack[s] - 1 / at.slack[s + 1]) * scale;
    const double pull = curvature * (at.dual[s] - at.dual[s + 1]) * scale;
    Point unit{};
    unit[a] = w;
    put(r, k, power, unit, -force / w, -order * (w * q[a] + pull / w));
    extra_ -= order * order * (pull * q[a] + pull * pull / (w * w));
    tg_ -= order * force * q[a];
  }
}

// Householder reflections: the first 5 D columns of the rows in use become a triangle.
template <int D>
void EdgeNewton<D>::reduce(std::size_t k) {
  const int rows = static_cast<int>(height_), columns = 5 * D;
  int p = 0;  // the row that this column's reflection fills
  for (int c = 0; c < columns && p < rows; ++c) {
    const std::size_t sample = k + static_cast<std::size_t>(c / D);
    if (sample >= samples_.count() || samples_.fixed(sample)) continue;
    double sum = 0;
    for (int i = p + 1; i < rows; ++i) sum += work_(i, c) * work_(i, c);
    if (sum > 0) {
      const double head = work_(p, c), norm = std::sqrt(sum + head * head);
      const double v0 = head > 0 ? head + norm : head - norm;
      const double beta = 2 / (v0 * v0 + sum);
      for (int j = c + 1; j < columns + 2; ++j) {
        double dot = v0 * work_(p, j);
        for (int i = p + 1; i < rows; ++i) dot += work_(i, c) * work_(i, j);
        dot *= beta;
        work_(p, j) -= dot * v0;
        for (int i = p + 1; i < rows; ++i) work_(i, j) -= dot * work_(i, c);
      }
      work_(p, c) = head > 0 ? -norm : norm;
      for (int i = p + 1; i < rows; ++i) work_(i, c) = 0;
    }
    ++p;
  }
  for (int i = p; i < rows; ++i) {
    residual_ += work_(i, columns + 1) * work_(i, columns + 1);
    work_.row(i).setZero();
  }
  height_ = static_cast<std::size_t>(p);
}

// The rows of this sample are done; what is left moves up and to the left.
template <int D>
bool EdgeNewton<D>::take(std::size_t k) {
  const int taken = samples_.fixed(k) ? 0 : D, left = std::max(0, static_cast<int>(height_) - taken);
  if (!samples_.fixed(k)) {
    factor_[k] = work_.template topRows<D>();
    for (int i = 0; i < D; ++i)
      if (!(std::abs(factor_[k](i, i)) > 0) || !std::isfinite(factor_[k](i, i))) return false;
  } else {
    factor_[k].setZero();
  }
  for (int i = 0; i < left; ++i) {
    for (int c = 0; c < 4 * D; ++c) work_(i, c) = work_(i + taken, c + D);
    for (int c = 4 * D; c < 5 * D; ++c) work_(i, c) = 0;
    for (int c = 5 * D; c < 5 * D + 2; ++c) work_(i, c) = work_(i + taken, c);
  }
  for (int i = left; i < work_.rows(); ++i) work_.row(i).setZero();
  height_ = static_cast<std::size_t>(left);
  return true;
}

template <int D>
void EdgeNewton<D>::substitute_back() {
  for (std::size_t k = samples_.count(); k-- > 0;)
    for (int i = D; i-- > 0;) {
      const Factor& f = factor_[k];
      double sum = f(i, 5 * D) - dtau_ * f(i, 5 * D + 1);
      for (int c = i + 1; c < 5 * D; ++c) {
        const std::size_t m = k + static_cast<std::size_t>(c / D);
        if (m < samples_.count()) sum -= f(i, c) * dx_[m][static_cast<std::size_t>(c % D)];
      }
      dx_[k][static_cast<std::size_t>(i)] = samples_.fixed(k) ? 0 : sum / f(i, i);
    }
}

template class EdgeNewton<1>;
template class EdgeNewton<2>;
template class EdgeNewton<3>;

}  // namespace bahnwerk
