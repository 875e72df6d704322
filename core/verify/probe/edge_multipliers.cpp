#include <algorithm>
#include <cmath>
#include <utility>

#include "core/verify/probe/edge_newton.hpp"

namespace bahnwerk {
namespace {

/// min h over samples x and h: a feasible primal-dual interior-point method on a band with a border.
template <int D>
class Search {
  using Point = std::array<double, D>;
  static constexpr double no_limit = EdgeSamples<D>::no_limit;

 public:
  explicit Search(const EdgeBoundProblem<D>& problem) : samples_(problem), newton_(samples_) {
    at_.x = samples_.start();
  }

  EdgeMultipliers<D> run(int iterations) {
    at_.h = samples_.slowest(at_.x) * 1.1;
    samples_.evaluate(at_.x, at_.h, at_.slack);
    count_ = 0;
    for (double g : at_.slack) count_ += g < no_limit;
    double mu = 0.3 / count_;  // barrier parameter for ln h
    at_.dual.resize(at_.slack.size());
    for (std::size_t s = 0; s < at_.slack.size(); ++s) at_.dual[s] = at_.slack[s] < no_limit ? mu / at_.slack[s] : 0;
    EdgeMultipliers<D> best = multipliers();
    double best_time = 0;
    int extra = 0;
    for (int i = 0; i < iterations; ++i) {
      double alpha = 0;
      for (int attempt = 0; attempt < 8 && alpha == 0; ++attempt) {
        if (newton_.step(at_, mu, attempt == 0 ? 1.0 : 0.0, damping_)) alpha = step(mu);
        if (alpha == 0) damping_ = std::max(1e-8, damping_ * 100);
      }
      if (alpha == 0) break;
      if (alpha > 0.5) damping_ = std::max(damping_ * 0.1, 1e-12);
      double sum = 0;
      for (std::size_t s = 0; s < at_.slack.size(); ++s)
        if (at_.slack[s] < no_limit) sum += at_.slack[s] * at_.dual[s];
      if (sum < 0.1) {
        EdgeMultipliers<D> y = multipliers();
        const double time = certified_time<D>(samples_.problem(), y);
        if (time > best_time) {
          best_time = time;
          best = std::move(y);
        }
        if (sum < 1.5 * gap && (at_.h - best_time < 3 * gap * at_.h || ++extra > 8)) break;
      }
      const double factor = alpha > 0.9 ? 0.15 : alpha > 0.5 ? 0.4 : alpha > 0.1 ? 0.7 : 1.0;
      mu = std::max(std::min(mu, factor * sum / count_), 0.3 * gap / count_);
    }
    return best;
  }

 private:
  static constexpr double gap = 2e-4;  // gap of ln h
  double merit(const std::vector<double>& slack, double h, double mu) const {
    double product = 1, sum = 0;
    for (double g : slack) {
      if (g >= no_limit) continue;
      product *= g;
      if (product < 1e-200) {
        sum += std::log(product);
        product = 1;
      }
    }
    return std::log(h) - mu * (sum + std::log(product));
  }

  double step(double mu) {
    const std::vector<Point>& dx = newton_.of_samples();
    const double dtau = newton_.of_logarithm();
    change_.assign(at_.slack.size(), 0.0);
    for (std::size_t k = 0; k < samples_.count(); ++k) {
      if (samples_.fixed(k)) continue;
      bool cap;
      Point u;
      const Point d = samples_.offset(k, at_.x[k], cap, u);
      for (int a = 0; a < D; ++a) change_[k] -= 2 * d[a] / (samples_.radius(k) * samples_.radius(k)) * dx[k][a];
    }
    double power = 1;
    for (std::size_t r = 1; r <= 4; ++r) {
      power /= at_.h;
      for (std::size_t k = 0; k < samples_.rows(r); ++k) {
        if (!samples_.free_row(r, k)) continue;
        const Point q = samples_.value(at_.x, r, k, power), dq = samples_.value(dx, r, k, power);
        for (int a = 0; a < D; ++a) {
          const double change = dq[a] - static_cast<double>(r) * q[a] * dtau;
          if (r == 1) {
            change_[samples_.speed_slack(k)] -=
                2 * q[a] / (samples_.problem().speed * samples_.problem().speed) * change;
          } else {
            const std::size_t s = samples_.axis_slack(r, k, a);
            change_[s] = -change / samples_.problem().derivative[r - 2][a];
            change_[s + 1] = -change_[s];
          }
        }
      }
    }
    double alpha = std::min(1.0, 1 / std::abs(dtau)), alpha_dual = 1, slope = dtau;
    for (std::size_t s = 0; s < at_.slack.size(); ++s) {
      if (at_.slack[s] >= no_limit) continue;
      const double g = at_.slack[s], l = at_.dual[s], dg = change_[s], dl = mu / g - l - l / g * dg;
      slope -= mu / g * dg;
      if (dg < -0.995 * g) alpha = std::min(alpha, -0.995 * g / dg);
      if (dl < -0.995 * l) alpha_dual = std::min(alpha_dual, -0.995 * l / dl);
    }
    const double before = merit(at_.slack, at_.h, mu);
    for (int attempt = 0; attempt < 25; ++attempt, alpha *= 0.6) {
      trial_ = at_.x;
      for (std::size_t k = 0; k < samples_.count(); ++k)
        for (int a = 0; a < D; ++a) trial_[k][a] += alpha * dx[k][a];
      const double h = at_.h * std::exp(alpha * dtau);
      if (!samples_.evaluate(trial_, h, trial_slack_)) continue;
      if (merit(trial_slack_, h, mu) > before + 1e-4 * alpha * slope + 1e-13) continue;
      for (std::size_t s = 0; s < at_.slack.size(); ++s) {
        if (at_.slack[s] >= no_limit) continue;
        at_.dual[s] += alpha_dual * (mu / at_.slack[s] - at_.dual[s] - at_.dual[s] / at_.slack[s] * change_[s]);
      }
      at_.h = h;
      std::swap(at_.x, trial_);
      std::swap(at_.slack, trial_slack_);
      return alpha;
    }
    return 0;
  }

  EdgeMultipliers<D> multipliers() const {
    EdgeMultipliers<D> y;
    double power = 1;
    for (std::size_t r = 1; r <= 4; ++r) {
      power /= at_.h;
      y[r - 1].assign(samples_.rows(r), Point{});
      for (std::size_t k = 0; k < samples_.rows(r); ++k) {
        if (!samples_.free_row(r, k)) continue;
        const Point q = samples_.value(at_.x, r, k, power);
        for (int a = 0; a < D; ++a) {
          if (r == 1) {
            y[0][k][a] = at_.dual[samples_.speed_slack(k)] * 2 * q[a] /
                         (samples_.problem().speed * samples_.problem().speed) * power;
          } else {
            const std::size_t s = samples_.axis_slack(r, k, a);
            y[r - 1][k][a] = (at_.dual[s] - at_.dual[s + 1]) / samples_.problem().derivative[r - 2][a] * power;
          }
        }
      }
    }
    return y;
  }

  EdgeSamples<D> samples_;
  EdgeNewton<D> newton_;
  EdgeIterate<D> at_;
  std::vector<Point> trial_;
  std::vector<double> trial_slack_, change_;
  double damping_ = 1e-12, count_ = 0;
};

}  // namespace

template <int D>
EdgeMultipliers<D> edge_multipliers(const EdgeBoundProblem<D>& problem, int iterations) {
  return Search<D>(problem).run(iterations);
}

template EdgeMultipliers<1> edge_multipliers<1>(const EdgeBoundProblem<1>&, int);
template EdgeMultipliers<2> edge_multipliers<2>(const EdgeBoundProblem<2>&, int);
template EdgeMultipliers<3> edge_multipliers<3>(const EdgeBoundProblem<3>&, int);

}  // namespace bahnwerk
