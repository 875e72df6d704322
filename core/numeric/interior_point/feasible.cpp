#include "core/numeric/interior_point/feasible.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bahnwerk {
namespace {

using Vector = std::vector<double>;

/// Returns Σ ln x. Products of many factors cost one logarithm.
double sum_of_logarithms(const Vector& x) {
  double product = 1, sum = 0;
  for (const double factor : x) {
    product *= factor;
    if (product < 1e-200 || product > 1e200) {
      sum += std::log(product);
      product = 1;
    }
  }
  return sum + std::log(product);
}

class FeasibleDriver {
 public:
  FeasibleDriver(FeasibleProblem& problem, const FeasibleOptions& options) : problem_(problem), options_(options) {}

  FeasibleResult run() {
    FeasibleResult result;
    if (!problem_.slacks(slack_)) return result;
    count_ = static_cast<double>(slack_.size());
    trial_ = change_ = slack_;
    double mu = (options_.start_mu > 0 ? options_.start_mu : 0.3) * problem_.scale() / count_;
    for (const double g : slack_) multiplier_.push_back(mu / g);
    for (int i = 0; i < options_.iterations; ++i) {
      if (options_.tick) options_.tick();
      result.iterations = i + 1;
      const double length = find_step(mu) ? line_search(mu) : 0;
      double sum = 0;
      for (std::size_t s = 0; s < slack_.size(); ++s) sum += slack_[s] * multiplier_[s];
      const double scale = problem_.scale();
      result.gap = sum / scale;
      // The iterate has to be near the minimum for μ, nearer where steps are short.
      const bool stiff = stiffness_ > soft;
      const bool near = result.gap <= options_.gap && decrease_ <= (stiff ? 0.02 : 2) * options_.gap * scale;
      if (options_.certified ? options_.certified(multiplier_, result.gap) : near) break;
      if (decrease_ > (stiff ? 0.02 : 1) * mu * count_) continue;
      stiffness_ *= 0.25;
      const double factor = length > 0.9 ? 0.15 : length > 0.5 ? 0.35 : 0.7;
      mu = std::max(std::min(mu, factor * (sum / count_)), 0.2 * options_.gap * scale / count_);
    }
    return result;
  }

 private:
  bool find_step(double mu) {
    constexpr int attempts = 11;
    for (int attempt = 0; attempt < attempts; ++attempt) {
      if (problem_.step({slack_, multiplier_, mu, damping_, stiffness_})) return true;
      damping_ = std::max(damping_ * 100, 1e-10);
    }
    return false;
  }

  /// Takes the step as far as the merit function falls enough; returns its length, 0 for none.
  double line_search(double mu) {
    double length = problem_.longest(), dual_length = 1, slope = problem_.changes(change_);
    for (std::size_t s = 0; s < slack_.size(); ++s) {
      const double g = slack_[s], l = multiplier_[s], dg = change_[s];
      slope -= mu / g * dg;
      if (dg < -keep * g) length = std::min(length, -keep * g / dg);
      const double dl = mu / g - l - l / g * dg;
      if (dl < -keep * l) dual_length = std::min(dual_length, -keep * l / dl);
    }
    decrease_ = -slope;
    const double before = problem_.objective() - mu * sum_of_logarithms(slack_);
    const std::size_t curves = problem_.curves();
    for (std::size_t attempt = 0; attempt < lengths * curves; ++attempt) {
      const std::size_t curve = attempt % curves;
      if (curve == 0 && attempt > 0) length *= attempt < 4 * curves ? 0.7 : 0.4;
      double objective = 0;
      if (!problem_.go(length, curve, trial_, objective)) continue;
      const double after = objective - mu * sum_of_logarithms(trial_);
      if (after > before + 1e-4 * length * slope + 1e-12 * std::abs(before)) continue;
      take(mu, length, dual_length);
      return length;
    }
    damping_ = std::min(std::max(damping_ * 100, 1e-6), 1e6);
    return 0;
  }

  void take(double mu, double length, double dual_length) {
    for (std::size_t s = 0; s < slack_.size(); ++s) {
      const double g = slack_[s],
                   l = multiplier_[s] + dual_length * (mu / g - multiplier_[s] - multiplier_[s] / g * change_[s]);
      multiplier_[s] = std::clamp(l, 1e-3 * mu / trial_[s], 1e3 * mu / trial_[s]);
    }
    problem_.accept();
    std::swap(slack_, trial_);
    stiffness_ = length < 0.1    ? std::min(std::max(4 * stiffness_, 0.01), 1e6)
                 : length > 0.25 ? 0.25 * stiffness_
                                 : stiffness_;
    if (length > 0.1) damping_ = std::max(damping_ * 0.1, 1e-10);
  }

  static constexpr double keep = 0.995;  // part of the distance to the nearest bound that a step takes
  static constexpr double soft = 0.3;
  static constexpr std::size_t lengths = 30;

  FeasibleProblem& problem_;
  const FeasibleOptions& options_;
  Vector slack_, trial_, change_, multiplier_;
  double count_ = 0, damping_ = 1e-8, stiffness_ = 0;
  double decrease_ = 0;  // twice what Newton's model predicts for the merit function
};

}  // namespace

FeasibleResult solve_feasible(FeasibleProblem& problem, const FeasibleOptions& options) {
  return FeasibleDriver(problem, options).run();
}

}  // namespace bahnwerk
