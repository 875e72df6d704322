#include "core/redundant/known/lag_compensation.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "core/redundant/known/cycle_spline.hpp"
#include "core/redundant/known/filters.hpp"
#include "core/redundant/known/reference_search.hpp"

namespace bahnwerk {
namespace {

constexpr double settled = 1e-5;  // mm: remaining lag at which the coarse axes are told to stand at the end

/// Simulates the drives: the tool's true position and its distance from the setpoint.
RedundancyLag simulated(const PathMotion& head, const RedundancyOptions& options, std::size_t cells, bool prefilter) {
  RedundancyLag lag;
  lag.prefilter = prefilter;
  const double step = head.duration() / static_cast<double>(cells);
  const std::vector<std::vector<double>> x = sampled(head, cells);
  std::vector<std::vector<double>> error(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    std::vector<double> tool = lagged(x[k], options.fine_lag, step);
    if (!prefilter) {
      const std::vector<double> coarse = lagged(x[k], options.coarse_lag, step);
      std::vector<double> following(coarse.size());
      for (std::size_t i = 0; i < coarse.size(); ++i) following[i] = x[k][i] - coarse[i];
      tool = lagged(following, options.fine_lag, step);
      for (std::size_t i = 0; i < coarse.size(); ++i) tool[i] += coarse[i];
    }
    for (std::size_t i = 0; i <= cells; ++i) error[k].push_back(tool[i] - x[k][i]);
  }
  std::size_t piece = 0;
  for (std::size_t i = 0; i <= cells; ++i) {
    const MotionState at = head.evaluate(step * static_cast<double>(i), piece);
    double along = 0, square = 0, speed = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      along += error[k][i] * at[1][k];
      square += error[k][i] * error[k][i];
      speed += at[1][k] * at[1][k];
    }
    lag.following_error = std::fmax(lag.following_error, std::sqrt(square));
    if (speed > 0)
      lag.contour_error = std::fmax(lag.contour_error, std::sqrt(std::fmax(0, square - along * along / speed)));
  }
  lag.overshoot = prefilter ? 0 : step_overshoot(options.coarse_lag, options.fine_lag);
  lag.circle_growth = circle_gain(options.coarse_lag, options.fine_lag, 100, prefilter) - 1;
  return lag;
}

}  // namespace

double step_overshoot(double coarse_lag, double fine_lag) {
  const double r = fine_lag / coarse_lag;
  return std::pow(r, (1 + r) / (1 - r));
}

double circle_gain(double coarse_lag, double fine_lag, double rate, bool prefilter) {
  const std::complex<double> i(0, 1), coarse = 1.0 / (1.0 + i * rate * coarse_lag),
                                      fine = 1.0 / (1.0 + i * rate * fine_lag);
  return std::abs(prefilter ? fine : 1.0 - (1.0 - coarse) * (1.0 - fine));
}

Prefilter prefilter(double coarse_lag, double fine_lag, double cycle_time) {
  // y = x − (T_f/T_c) · lag with lag_i = d lag_{i−1} + (1 − d) T_c/h (x_i − x_{i−1}), see lagged().
  const double decay = std::exp(-cycle_time / coarse_lag), gain = (1 - decay) * fine_lag / cycle_time;
  return {{1, coarse_lag - fine_lag}, {1, coarse_lag}, {1 - gain, gain - decay}, -decay};
}

Expected<RedundancyResult, NoPlan> plan_lag_compensation(const RedundancyTask& task, const RedundancyOptions& options,
                                                         Progress progress) {
  const double cycle = task.machine.cycle_time, lag = options.coarse_lag;
  double stroke = 0;
  for (const CoarseFineAxis& axis : task.machine.axes) stroke = std::fmax(stroke, axis.stroke);
  FilterSearch search;
  search.lead = 3 * cycle;
  search.tail = lag * std::log(std::fmax(stroke / settled, 1.0)) + 4 * cycle;
  search.filter = [&](const std::vector<double>& x, double step) {
    std::vector<double> y = lagged(x, lag, step);
    std::fill(y.end() - 3, y.end(), x.back());
    return y;
  };
  Expected<RedundancyResult, NoPlan> result = search_reference(task, options, search, progress);
  if (!result) return result;
  const auto cells = static_cast<std::size_t>(std::ceil(result->head->duration() / cycle));
  for (const bool prefilter : {false, true})
    result->lags.push_back(simulated(*result->head, options, cells, prefilter));
  return result;
}

}  // namespace bahnwerk
