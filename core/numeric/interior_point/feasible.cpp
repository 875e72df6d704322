#include "core/numeric/interior_point/feasible.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/numeric/interior_point/driver.hpp"

namespace bahnwerk {
namespace {

using Vector = std::vector<double>;

class FeasibleDriver {
 public:
  FeasibleDriver(FeasibleProblem& problem, const FeasibleOptions& options) : problem_(problem), options_(options) {}

  FeasibleResult run() {
    FeasibleResult result;
    if (!problem_.slacks(slack_)) return result;
    trial_ = change_ = slack_;
    weight_ = options_.weights;
    weight_.resize(slack_.size(), 1.0);
    total_ = std::accumulate(weight_.begin(), weight_.end(), 0.0);
    double mu = (options_.start_mu > 0 ? options_.start_mu : 0.3) * problem_.scale() / total_;
    multiplier_ = options_.start_multipliers;
    for (std::size_t s = multiplier_.size(); s < slack_.size(); ++s) multiplier_.push_back(mu * weight_[s] / slack_[s]);
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
      if (decrease_ > (stiff ? 0.02 : options_.centred) * mu * total_) continue;
      stiffness_ *= 0.25;
      mu = std::max(std::min(mu, mu_factor(length) * (sum / total_)), 0.2 * options_.gap * scale / total_);
    }
    return result;
  }

 private:
  /// Returns Σ w ln x. Products of many factors of one weight cost one logarithm.
  double sum_of_logarithms(const Vector& x) const {
    double product = 1, sum = 0, weight = 1;
    for (std::size_t s = 0; s < x.size(); ++s) {
      if (weight_[s] != weight || product < 1e-200 || product > 1e200) {
        sum += weight * std::log(product);
        product = 1, weight = weight_[s];
      }
      product *= x[s];
    }
    return sum + weight * std::log(product);
  }

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
    double reach = 0, dual_reach = 0, slope = problem_.changes(change_);
    for (std::size_t s = 0; s < slack_.size(); ++s) {
      const double g = slack_[s], l = multiplier_[s], dg = change_[s], target = mu * weight_[s] / g;
      slope -= target * dg;
      reach = std::max(reach, -dg / g);
      dual_reach = std::max(dual_reach, -(target - l - l / g * dg) / l);
    }
    const double dual_length = step_length(dual_reach);
    double length = std::min(problem_.longest(), step_length(reach));
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
      const double g = slack_[s], l = multiplier_[s], target = mu * weight_[s];
      multiplier_[s] = std::clamp(l + dual_length * (target / g - l - l / g * change_[s]), 1e-3 * target / trial_[s],
                                  1e3 * target / trial_[s]);
    }
    problem_.accept();
    std::swap(slack_, trial_);
    stiffness_ = length < 0.1    ? std::min(std::max(4 * stiffness_, 0.01), 1e6)
                 : length > 0.25 ? 0.25 * stiffness_
                                 : stiffness_;
    if (length > 0.1) damping_ = std::max(damping_ * 0.1, 1e-10);
  }

  static constexpr double soft = 0.3;
  static constexpr std::size_t lengths = 30;

  FeasibleProblem& problem_;
  const FeasibleOptions& options_;
  Vector slack_, trial_, change_, multiplier_, weight_;
  double total_ = 0;  // Σ w
  double damping_ = 1e-8, stiffness_ = 0;
  double decrease_ = 0;  // twice what Newton's model predicts for the merit function
};

}  // namespace

FeasibleResult solve_feasible(FeasibleProblem& problem, const FeasibleOptions& options) {
  return FeasibleDriver(problem, options).run();
}

}  // namespace bahnwerk
