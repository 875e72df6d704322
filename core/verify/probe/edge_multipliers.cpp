#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numeric/interior_point/feasible.hpp"
#include "core/numeric/linear/banded_qr.hpp"
#include "core/verify/probe/edge_samples.hpp"

namespace bahnwerk {
namespace {

/// min ln h over samples x and h. The matrix in the samples is JᵀJ, J the weighted differences, whose condition number
/// grows as (samples)^4; both right-hand sides, that of the step and the column of ln h, have the form Jᵀv.
template <int D>
class EdgeProblem final : public FeasibleProblem {
  using Point = std::array<double, D>;

 public:
  explicit EdgeProblem(const EdgeBoundProblem<D>& problem)
      : samples_(problem), x_(samples_.start()), h_(1.1 * samples_.slowest(x_)), system_(x_.size()), dx_(x_.size()) {}

  double h() const { return h_; }
  double objective() const override { return std::log(h_); }
  double scale() const override { return 1; }
  bool slacks(std::vector<double>& slack) const override { return samples_.evaluate(x_, h_, slack); }
  /// The second derivatives of products of samples and h are left out where they are too much.
  bool step(const BarrierPoint& at) override { return step(at, 1) || step(at, 0); }
  double changes(std::vector<double>& change) const override;
  double longest() const override { return std::min(1.0, 1 / std::abs(dtau_)); }
  bool go(double length, std::size_t, std::vector<double>& slack, double& objective) override {
    trial_ = x_;
    for (std::size_t k = 0; k < trial_.size(); ++k)
      for (int a = 0; a < D; ++a) trial_[k][a] += length * dx_[k][a];
    trial_h_ = h_ * std::exp(length * dtau_);
    objective = std::log(trial_h_);
    return samples_.evaluate(trial_, trial_h_, slack);
  }
  void accept() override {
    std::swap(x_, trial_);
    h_ = trial_h_;
  }

  EdgeMultipliers<D> multipliers(const std::vector<double>& dual) const;

 private:
  enum Right { of_step, of_logarithm, rights };
  static constexpr int unknowns = 5 * D;
  using System = BandedQr<D, 5, rights, 10 * D + 4>;

  double power(std::size_t r) const {
    double power = 1;
    for (std::size_t i = 0; i < r; ++i) power /= h_;
    return power;
  }
  bool step(const BarrierPoint& at, double curvature);
  void add_row(std::size_t r, std::size_t k, const Point& weight, double step, double logarithm);
  void add_tube(std::size_t k, const BarrierPoint& at);
  void add_difference(std::size_t r, std::size_t k, const BarrierPoint& at, double curvature);

  EdgeSamples<D> samples_;
  std::vector<Point> x_, trial_;
  double h_, trial_h_ = 0;
  System system_;
  double gradient_ = 0, extra_ = 0;  // of ln h; addition to its diagonal beside the rows
  std::vector<Point> dx_;
  double dtau_ = 0;  // the step of ln h
};

template <int D>
bool EdgeProblem<D>::step(const BarrierPoint& at, double curvature) {
  gradient_ = 1, extra_ = 0;
  system_.clear();
  const auto known = [&](std::size_t k) { return samples_.fixed(k); };
  for (std::size_t k = 0; k < x_.size(); ++k) {
    if (!samples_.fixed(k)) add_tube(k, at);
    for (std::size_t r = 1; r <= 4; ++r)
      if (k < samples_.rows(r) && samples_.free_row(r, k)) add_difference(r, k, at, curvature);
    if (!system_.close(k, known)) return false;
  }
  const double schur = (system_.residual(of_logarithm) + extra_) * (1 + at.damping);
  if (!(schur > 0)) return false;
  dtau_ = (-gradient_ - system_.product(of_step, of_logarithm)) / schur;
  system_.solve({1, -dtau_}, known, dx_);
  return std::isfinite(dtau_);
}

// A row of J: the difference's value times `weight`; its parts of both right-hand sides.
template <int D>
void EdgeProblem<D>::add_row(std::size_t r, std::size_t k, const Point& weight, double step, double logarithm) {
  auto row = system_.add_row();
  for (std::size_t m = 0; m <= r; ++m) {
    if (samples_.fixed(k + m)) continue;
    const double f = samples_.row(r, k)[m] * power(r);
    for (int a = 0; a < D; ++a) row(static_cast<int>(m) * D + a) = f * weight[a];
  }
  row(unknowns + of_step) = step;
  row(unknowns + of_logarithm) = logarithm;
}

template <int D>
void EdgeProblem<D>::add_tube(std::size_t k, const BarrierPoint& at) {
  bool cap;
  Point u;
  const Point d = samples_.offset(k, x_[k], cap, u);
  const std::size_t s = samples_.tube_slack(k);
  const double r2 = samples_.radius(k) * samples_.radius(k), l = at.multiplier[s], g = at.slack[s];
  const double round = std::sqrt(2 * l / r2), steep = std::sqrt(l / g);
  for (int a = 0; a < D; ++a) {
    auto row = system_.add_row();
    for (int b = 0; b < D; ++b) row(b) = round * ((a == b) - (cap ? 0.0 : u[a] * u[b]));
  }
  auto row = system_.add_row();
  for (int b = 0; b < D; ++b) row(b) = -2 * d[b] / r2 * steep;
  row(unknowns + of_step) = at.mu / (g * steep);
}

template <int D>
void EdgeProblem<D>::add_difference(std::size_t r, std::size_t k, const BarrierPoint& at, double curvature) {
  const double order = static_cast<double>(r);
  const Point q = samples_.value(x_, r, k, power(r));
  if (r == 1) {
    const std::size_t s = samples_.speed_slack(k);
    const double v2 = samples_.problem().speed * samples_.problem().speed, l = at.multiplier[s], g = at.slack[s];
    const double round = std::sqrt(2 * l / v2), steep = std::sqrt(l / g);
    double along = 0;
    for (int a = 0; a < D; ++a) {
      Point unit{};
      unit[a] = round;
      add_row(r, k, unit, 0, -order * (1 + curvature) * round * q[a]);
      extra_ -= order * order * (curvature + curvature * curvature) * round * round * q[a] * q[a];
      along += q[a] * q[a];
    }
    Point slope;
    for (int a = 0; a < D; ++a) slope[a] = -2 * q[a] / v2 * steep;
    add_row(r, k, slope, at.mu / (g * steep), 2 * order * along / v2 * steep);
    gradient_ -= order * at.mu / g * 2 * along / v2;
    return;
  }
  for (int a = 0; a < D; ++a) {
    const std::size_t s = samples_.axis_slack(r, k, a);
    const double *l = &at.multiplier[s], *g = &at.slack[s];
    const double scale = 1 / samples_.problem().derivative[r - 2][a];
    const double w = std::sqrt(l[0] / g[0] + l[1] / g[1]) * scale;
    const double force = at.mu * (1 / g[0] - 1 / g[1]) * scale;
    const double pull = curvature * (l[0] - l[1]) * scale;
    Point unit{};
    unit[a] = w;
    add_row(r, k, unit, -force / w, -order * (w * q[a] + pull / w));
    extra_ -= order * order * (pull * q[a] + pull * pull / (w * w));
    gradient_ -= order * force * q[a];
  }
}

template <int D>
double EdgeProblem<D>::changes(std::vector<double>& change) const {
  for (std::size_t k = 0; k < x_.size(); ++k) {
    if (samples_.fixed(k)) continue;
    bool cap;
    Point u;
    const Point d = samples_.offset(k, x_[k], cap, u);
    double& dg = change[samples_.tube_slack(k)] = 0;
    for (int a = 0; a < D; ++a) dg -= 2 * d[a] / (samples_.radius(k) * samples_.radius(k)) * dx_[k][a];
  }
  for (std::size_t r = 1; r <= 4; ++r)
    for (std::size_t k = 0; k < samples_.rows(r); ++k) {
      if (!samples_.free_row(r, k)) continue;
      const Point q = samples_.value(x_, r, k, power(r)), dq = samples_.value(dx_, r, k, power(r));
      if (r == 1) change[samples_.speed_slack(k)] = 0;
      for (int a = 0; a < D; ++a) {
        const double dv = dq[a] - static_cast<double>(r) * q[a] * dtau_;
        if (r == 1) {
          change[samples_.speed_slack(k)] -= 2 * q[a] / (samples_.problem().speed * samples_.problem().speed) * dv;
        } else {
          const std::size_t s = samples_.axis_slack(r, k, a);
          change[s] = -dv / samples_.problem().derivative[r - 2][a];
          change[s + 1] = -change[s];
        }
      }
    }
  return dtau_;
}

template <int D>
EdgeMultipliers<D> EdgeProblem<D>::multipliers(const std::vector<double>& dual) const {
  EdgeMultipliers<D> y;
  for (std::size_t r = 1; r <= 4; ++r) {
    y[r - 1].assign(samples_.rows(r), Point{});
    for (std::size_t k = 0; k < samples_.rows(r); ++k) {
      if (!samples_.free_row(r, k)) continue;
      const Point q = samples_.value(x_, r, k, power(r));
      for (int a = 0; a < D; ++a) {
        if (r == 1) {
          y[0][k][a] = dual[samples_.speed_slack(k)] * 2 * q[a] /
                       (samples_.problem().speed * samples_.problem().speed) * power(r);
        } else {
          const std::size_t s = samples_.axis_slack(r, k, a);
          y[r - 1][k][a] = (dual[s] - dual[s + 1]) / samples_.problem().derivative[r - 2][a] * power(r);
        }
      }
    }
  }
  return y;
}

}  // namespace

template <int D>
EdgeMultipliers<D> edge_multipliers(const EdgeBoundProblem<D>& problem, int iterations) {
  constexpr double gap = 2e-4;  // of ln h
  constexpr int most_extra = 8;
  EdgeProblem<D> search(problem);
  EdgeMultipliers<D> best;  // all 0: they prove nothing
  for (std::size_t r = 1; r <= 4; ++r) best[r - 1].resize(problem.grid.size() - r);
  double best_time = 0;
  int extra = 0;
  FeasibleOptions options;
  options.gap = gap;
  options.iterations = iterations;
  options.certified = [&](const std::vector<double>& dual, double now) {
    if (now >= 0.1) return false;
    EdgeMultipliers<D> y = search.multipliers(dual);
    const double time = certified_time<D>(problem, y);
    if (time > best_time) best_time = time, best = std::move(y);
    return now < 1.5 * gap && (search.h() - best_time < 3 * gap * search.h() || ++extra > most_extra);
  };
  solve_feasible(search, options);
  return best;
}

template EdgeMultipliers<1> edge_multipliers<1>(const EdgeBoundProblem<1>&, int);
template EdgeMultipliers<2> edge_multipliers<2>(const EdgeBoundProblem<2>&, int);
template EdgeMultipliers<3> edge_multipliers<3>(const EdgeBoundProblem<3>&, int);

}  // namespace bahnwerk
