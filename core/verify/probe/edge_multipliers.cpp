#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/verify/probe/edge_bound.hpp"

namespace bahnwerk {
namespace {

constexpr double no_limit = 1e300;

/// min h over samples x and h: a feasible primal-dual interior-point method on a band with a border.
template <int D>
class Search {
  using Point = std::array<double, D>;

 public:
  explicit Search(const EdgeBoundProblem<D>& problem)
      : problem_(problem), rows_(difference_rows(problem.grid)), samples_(problem.grid.size()) {
    x_.resize(samples_);
    fixed_.resize(samples_);
    radius_.resize(samples_);
    const double length = distance(problem.set[first(0)].p, problem.set[first(1)].p);
    for (std::size_t k = 0; k < samples_; ++k) {
      const double g = std::clamp(problem.grid[k], 0.0, 1.0);
      const double s = g * g * g * g * (35 + g * (-84 + g * (70 - 20 * g)));
      const Point& a = problem.set[first(0)].p;
      const Point& b = problem.set[first(1)].p;
      for (int i = 0; i < D; ++i) x_[k][i] = a[i] + s * (b[i] - a[i]);
      // Where there is next to no room the search takes the point as given, or gives it some: the certificate knows.
      const SampleSet<D>& set = problem.set[k];
      fixed_[k] = set.p == set.q && set.radius < 1e-3 * length;
      radius_[k] = std::max(set.radius, 1e-4 * length);
      if (fixed_[k]) x_[k] = set.p;
    }
    begin_slacks();
  }

  EdgeMultipliers<D> run(int iterations) {
    h_ = slowest() * 1.1;
    evaluate(x_, h_, slack_);
    count_ = 0;
    for (double g : slack_) count_ += g < no_limit;
    double mu = 0.3 / count_;  // of ln h
    dual_.resize(slack_.size());
    for (std::size_t s = 0; s < slack_.size(); ++s) dual_[s] = slack_[s] < no_limit ? mu / slack_[s] : 0;
    EdgeMultipliers<D> best = multipliers();
    double best_time = 0;
    int extra = 0;
    for (int i = 0; i < iterations; ++i) {
      double alpha = 0;
      for (int attempt = 0; attempt < 8 && alpha == 0; ++attempt) {
        if (direction(mu, attempt == 0 ? 1.0 : 0.0)) alpha = step(mu);
        if (alpha == 0) damping_ = std::max(1e-8, damping_ * 100);
      }
      if (alpha == 0) break;
      if (alpha > 0.5) damping_ = std::max(damping_ * 0.1, 1e-12);
      double sum = 0;
      for (std::size_t s = 0; s < slack_.size(); ++s)
        if (slack_[s] < no_limit) sum += slack_[s] * dual_[s];
      if (sum < 0.1) {
        EdgeMultipliers<D> y = multipliers();
        const double time = certified_time<D>(problem_, y);
        if (time > best_time) {
          best_time = time;
          best = std::move(y);
        }
        if (sum < 1.5 * gap && (h_ - best_time < 3 * gap * h_ || ++extra > 8)) break;
      }
      const double factor = alpha > 0.9 ? 0.15 : alpha > 0.5 ? 0.4 : alpha > 0.1 ? 0.7 : 1.0;
      mu = std::max(std::min(mu, factor * sum / count_), 0.3 * gap / count_);
    }
    return best;
  }

 private:
  static constexpr double gap = 2e-4;  // of ln h
  static double distance(const Point& a, const Point& b) {
    double sum = 0;
    for (int i = 0; i < D; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum);
  }
  std::size_t first(double g) const {
    std::size_t k = 0;
    while (k + 1 < samples_ && problem_.grid[k] < g) ++k;
    return k;
  }
  // Slacks: one per sample, one per difference of first order, two per axis of the others.
  void begin_slacks() {
    start_[0] = 0;
    start_[1] = samples_;
    start_[2] = start_[1] + rows_[0].size();
    for (std::size_t r = 2; r <= 4; ++r) start_[r + 1] = start_[r] + 2 * D * rows_[r - 1].size();
  }
  Point value(const std::vector<Point>& x, std::size_t r, std::size_t k, double power) const {
    Point q{};
    for (std::size_t i = 1; i <= r; ++i)
      for (int a = 0; a < D; ++a) q[a] += rows_[r - 1][k][i] * (x[k + i][a] - x[k][a]);
    for (int a = 0; a < D; ++a) q[a] *= power;
    return q;
  }
  bool free_row(std::size_t r, std::size_t k) const {
    for (std::size_t i = 0; i <= r; ++i)
      if (!fixed_[k + i]) return true;
    return false;
  }
  Point off(std::size_t k, const Point& x, bool& cap, Point& u) const {
    const SampleSet<D>& s = problem_.set[k];
    double length = distance(s.p, s.q), along = 0;
    for (int a = 0; a < D; ++a) {
      u[a] = length > 0 ? (s.q[a] - s.p[a]) / length : 0;
      along += u[a] * (x[a] - s.p[a]);
    }
    cap = along <= 0 || along >= length;
    along = std::clamp(along, 0.0, length);
    Point d;
    for (int a = 0; a < D; ++a) d[a] = x[a] - s.p[a] - along * u[a];
    return d;
  }
  double slowest() const {
    double h = 0;
    for (std::size_t r = 1; r <= 4; ++r)
      for (std::size_t k = 0; k < rows_[r - 1].size(); ++k) {
        const Point q = value(x_, r, k, 1);
        double ratio = 0;
        for (int a = 0; a < D; ++a)
          ratio = r == 1 ? std::hypot(ratio, q[a] / problem_.speed)
                         : std::max(ratio, std::abs(q[a]) / problem_.derivative[r - 2][a]);
        h = std::max(h, std::pow(ratio, 1.0 / static_cast<double>(r)));
      }
    return h;
  }
  bool evaluate(const std::vector<Point>& x, double h, std::vector<double>& slack) const {
    slack.assign(start_[5], no_limit);
    double least = no_limit;
    for (std::size_t k = 0; k < samples_; ++k) {
      if (fixed_[k]) continue;
      bool cap;
      Point u;
      const Point d = off(k, x[k], cap, u);
      double sum = 0;
      for (int a = 0; a < D; ++a) sum += d[a] * d[a];
      slack[k] = 1 - sum / (radius_[k] * radius_[k]);
      least = std::min(least, slack[k]);
    }
    double power = 1;
    for (std::size_t r = 1; r <= 4; ++r) {
      power /= h;
      for (std::size_t k = 0; k < rows_[r - 1].size(); ++k) {
        if (!free_row(r, k)) continue;
        const Point q = value(x, r, k, power);
        if (r == 1) {
          double sum = 0;
          for (int a = 0; a < D; ++a) sum += q[a] * q[a];
          slack[start_[1] + k] = 1 - sum / (problem_.speed * problem_.speed);
          least = std::min(least, slack[start_[1] + k]);
          continue;
        }
        for (int a = 0; a < D; ++a) {
          const double ratio = q[a] / problem_.derivative[r - 2][a];
          double* s = &slack[start_[r] + 2 * (D * k + static_cast<std::size_t>(a))];
          s[0] = 1 - ratio;
          s[1] = 1 + ratio;
          least = std::min({least, s[0], s[1]});
        }
      }
    }
    return least > 0;
  }
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

  // The Newton step by orthogonal factors, sample by sample: its matrix in x is JᵀJ, J the weighted differences, and so
  // are both right-hand sides of the form Jᵀv. That costs twice what a Cholesky factor of JᵀJ does, and the condition
  // number, about (samples)^4, is not squared.
  bool direction(double mu, double curvature) {
    double tg = 1, extra = 0, residual = 0;
    factor_.resize(samples_);
    Work work;
    work.setZero();
    std::size_t height = 0;  // rows of `work` in use
    std::array<double, 5> power{1, 1 / h_, 0, 0, 0};
    for (std::size_t r = 2; r <= 4; ++r) power[r] = power[r - 1] / h_;
    for (std::size_t k = 0; k < samples_; ++k) {
      if (!fixed_[k]) tube_rows(k, mu, work, height);
      for (std::size_t r = 1; r <= 4; ++r) {
        if (k >= rows_[r - 1].size() || !free_row(r, k)) continue;
        const double order = static_cast<double>(r);
        const Point q = value(x_, r, k, power[r]);
        if (r == 1) {
          const double v2 = problem_.speed * problem_.speed, l = dual_[start_[1] + k], g = slack_[start_[1] + k];
          const double round = std::sqrt(2 * l / v2), steep = std::sqrt(l / g);
          double along = 0;
          for (int a = 0; a < D; ++a) {
            Point unit{};
            unit[a] = round;
            put(r, k, power[r], unit, 0, -order * (1 + curvature) * round * q[a], work, height);
            extra -= order * order * (curvature + curvature * curvature) * round * round * q[a] * q[a];
            along += q[a] * q[a];
          }
          Point grad;
          for (int a = 0; a < D; ++a) grad[a] = -2 * q[a] / v2 * steep;
          put(r, k, power[r], grad, mu / (g * steep), 2 * order * along / v2 * steep, work, height);
          tg -= order * mu / g * 2 * along / v2;
          continue;
        }
        for (int a = 0; a < D; ++a) {
          const std::size_t s = start_[r] + 2 * (D * k + static_cast<std::size_t>(a));
          const double scale = 1 / problem_.derivative[r - 2][a];
          const double w = std::sqrt(dual_[s] / slack_[s] + dual_[s + 1] / slack_[s + 1]) * scale;
          const double force = mu * (1 / slack_[s] - 1 / slack_[s + 1]) * scale;
          const double pull = curvature * (dual_[s] - dual_[s + 1]) * scale;
          Point unit{};
          unit[a] = w;
          put(r, k, power[r], unit, -force / w, -order * (w * q[a] + pull / w), work, height);
          extra -= order * order * (pull * q[a] + pull * pull / (w * w));
          tg -= order * force * q[a];
        }
      }
      reduce(k, work, height, residual);
      // The rows of this sample are done; what is left moves up and to the left.
      const int taken = fixed_[k] ? 0 : D, left = std::max(0, static_cast<int>(height) - taken);
      if (!fixed_[k]) {
        factor_[k] = work.template topRows<D>();
        for (int i = 0; i < D; ++i)
          if (!(std::abs(factor_[k](i, i)) > 0) || !std::isfinite(factor_[k](i, i))) return false;
      } else {
        factor_[k].setZero();
      }
      for (int i = 0; i < left; ++i) {
        for (int c = 0; c < 4 * D; ++c) work(i, c) = work(i + taken, c + D);
        for (int c = 4 * D; c < 5 * D; ++c) work(i, c) = 0;
        for (int c = 5 * D; c < 5 * D + 2; ++c) work(i, c) = work(i + taken, c);
      }
      for (int i = left; i < work.rows(); ++i) work.row(i).setZero();
      height = static_cast<std::size_t>(left);
    }
    double both = 0;
    for (std::size_t k = 0; k < samples_; ++k)
      for (int i = 0; i < D; ++i) both += factor_[k](i, 5 * D) * factor_[k](i, 5 * D + 1);
    const double schur = (residual + extra) * (1 + damping_);
    if (!(schur > 0)) return false;
    dtau_ = (-tg - both) / schur;
    dx_.resize(samples_);
    for (std::size_t k = samples_; k-- > 0;)
      for (int i = D; i-- > 0;) {
        const Factor& f = factor_[k];
        double sum = f(i, 5 * D) - dtau_ * f(i, 5 * D + 1);
        for (int c = i + 1; c < 5 * D; ++c) {
          const std::size_t m = k + static_cast<std::size_t>(c / D);
          if (m < samples_) sum -= f(i, c) * dx_[m][static_cast<std::size_t>(c % D)];
        }
        dx_[k][static_cast<std::size_t>(i)] = fixed_[k] ? 0 : sum / f(i, i);
      }
    return std::isfinite(dtau_);
  }
  using Work = Eigen::Matrix<double, 10 * D + 4, 5 * D + 2>;
  using Factor = Eigen::Matrix<double, D, 5 * D + 2>;

  // Row of J: the difference's value times `weight`; right-hand sides of the step and of the border.
  void put(std::size_t r, std::size_t k, double power, const Point& weight, double step, double border, Work& work,
           std::size_t& height) const {
    const int i = static_cast<int>(height++);
    for (std::size_t m = 0; m <= r; ++m) {
      if (fixed_[k + m]) continue;
      const double f = rows_[r - 1][k][m] * power;
      for (int a = 0; a < D; ++a) work(i, static_cast<int>(m) * D + a) = f * weight[a];
    }
    work(i, 5 * D) = step;
    work(i, 5 * D + 1) = border;
  }
  void tube_rows(std::size_t k, double mu, Work& work, std::size_t& height) const {
    bool cap;
    Point u;
    const Point d = off(k, x_[k], cap, u);
    const double r2 = radius_[k] * radius_[k], l = dual_[k], g = slack_[k];
    const double round = std::sqrt(2 * l / r2), steep = std::sqrt(l / g);
    for (int a = 0; a < D; ++a) {
      const int i = static_cast<int>(height++);
      for (int b = 0; b < D; ++b) work(i, b) = round * ((a == b) - (cap ? 0.0 : u[a] * u[b]));
    }
    const int i = static_cast<int>(height++);
    for (int b = 0; b < D; ++b) work(i, b) = -2 * d[b] / r2 * steep;
    work(i, 5 * D) = mu / (g * steep);
  }
  // Householder reflections: the first 5 D columns of the rows in use become a triangle.
  void reduce(std::size_t k, Work& work, std::size_t& height, double& residual) const {
    const int rows = static_cast<int>(height), columns = 5 * D;
    int p = 0;  // the row that this column's reflection fills
    for (int c = 0; c < columns && p < rows; ++c) {
      const std::size_t sample = k + static_cast<std::size_t>(c / D);
      if (sample >= samples_ || fixed_[sample]) continue;
      double sum = 0;
      for (int i = p + 1; i < rows; ++i) sum += work(i, c) * work(i, c);
      if (sum > 0) {
        const double head = work(p, c), norm = std::sqrt(sum + head * head);
        const double v0 = head > 0 ? head + norm : head - norm;
        const double beta = 2 / (v0 * v0 + sum);
        for (int j = c + 1; j < columns + 2; ++j) {
          double dot = v0 * work(p, j);
          for (int i = p + 1; i < rows; ++i) dot += work(i, c) * work(i, j);
          dot *= beta;
          work(p, j) -= dot * v0;
          for (int i = p + 1; i < rows; ++i) work(i, j) -= dot * work(i, c);
        }
        work(p, c) = head > 0 ? -norm : norm;
        for (int i = p + 1; i < rows; ++i) work(i, c) = 0;
      }
      ++p;
    }
    for (int i = p; i < rows; ++i) {
      residual += work(i, columns + 1) * work(i, columns + 1);
      work.row(i).setZero();
    }
    height = static_cast<std::size_t>(p);
  }

  double step(double mu) {
    change_.assign(slack_.size(), 0.0);
    for (std::size_t k = 0; k < samples_; ++k) {
      if (fixed_[k]) continue;
      bool cap;
      Point u;
      const Point d = off(k, x_[k], cap, u);
      for (int a = 0; a < D; ++a) change_[k] -= 2 * d[a] / (radius_[k] * radius_[k]) * dx_[k][a];
    }
    double power = 1;
    for (std::size_t r = 1; r <= 4; ++r) {
      power /= h_;
      for (std::size_t k = 0; k < rows_[r - 1].size(); ++k) {
        if (!free_row(r, k)) continue;
        const Point q = value(x_, r, k, power), dq = value(dx_, r, k, power);
        for (int a = 0; a < D; ++a) {
          const double change = dq[a] - static_cast<double>(r) * q[a] * dtau_;
          if (r == 1) {
            change_[start_[1] + k] -= 2 * q[a] / (problem_.speed * problem_.speed) * change;
          } else {
            const std::size_t s = start_[r] + 2 * (D * k + static_cast<std::size_t>(a));
            change_[s] = -change / problem_.derivative[r - 2][a];
            change_[s + 1] = -change_[s];
          }
        }
      }
    }
    double alpha = std::min(1.0, 1 / std::abs(dtau_)), alpha_dual = 1, slope = dtau_;
    for (std::size_t s = 0; s < slack_.size(); ++s) {
      if (slack_[s] >= no_limit) continue;
      const double g = slack_[s], l = dual_[s], dg = change_[s], dl = mu / g - l - l / g * dg;
      slope -= mu / g * dg;
      if (dg < -0.995 * g) alpha = std::min(alpha, -0.995 * g / dg);
      if (dl < -0.995 * l) alpha_dual = std::min(alpha_dual, -0.995 * l / dl);
    }
    const double before = merit(slack_, h_, mu);
    for (int attempt = 0; attempt < 25; ++attempt, alpha *= 0.6) {
      trial_ = x_;
      for (std::size_t k = 0; k < samples_; ++k)
        for (int a = 0; a < D; ++a) trial_[k][a] += alpha * dx_[k][a];
      const double h = h_ * std::exp(alpha * dtau_);
      if (!evaluate(trial_, h, trial_slack_)) continue;
      if (merit(trial_slack_, h, mu) > before + 1e-4 * alpha * slope + 1e-13) continue;
      for (std::size_t s = 0; s < slack_.size(); ++s) {
        if (slack_[s] >= no_limit) continue;
        dual_[s] += alpha_dual * (mu / slack_[s] - dual_[s] - dual_[s] / slack_[s] * change_[s]);
      }
      h_ = h;
      std::swap(x_, trial_);
      std::swap(slack_, trial_slack_);
      return alpha;
    }
    return 0;
  }

  EdgeMultipliers<D> multipliers() const {
    EdgeMultipliers<D> y;
    double power = 1;
    for (std::size_t r = 1; r <= 4; ++r) {
      power /= h_;
      y[r - 1].assign(rows_[r - 1].size(), Point{});
      for (std::size_t k = 0; k < rows_[r - 1].size(); ++k) {
        if (!free_row(r, k)) continue;
        const Point q = value(x_, r, k, power);
        for (int a = 0; a < D; ++a) {
          if (r == 1) {
            y[0][k][a] = dual_[start_[1] + k] * 2 * q[a] / (problem_.speed * problem_.speed) * power;
          } else {
            const std::size_t s = start_[r] + 2 * (D * k + static_cast<std::size_t>(a));
            y[r - 1][k][a] = (dual_[s] - dual_[s + 1]) / problem_.derivative[r - 2][a] * power;
          }
        }
      }
    }
    return y;
  }

  const EdgeBoundProblem<D>& problem_;
  std::array<std::vector<std::array<double, 5>>, 4> rows_;
  std::size_t samples_;
  std::array<std::size_t, 6> start_{};
  std::vector<Point> x_, dx_, trial_;
  std::vector<char> fixed_;
  std::vector<double> radius_, slack_, trial_slack_, dual_, change_;
  std::vector<Factor, Eigen::aligned_allocator<Factor>> factor_;
  double h_ = 0, dtau_ = 0, damping_ = 1e-12, count_ = 0;
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
