#include "core/redundant/known/filters.hpp"

#include <cmath>
#include <numbers>

namespace bahnwerk {

std::vector<double> low_pass(std::size_t taps, double cutoff, double step) {
  std::vector<double> h(taps, 1);
  const double middle = 0.5 * static_cast<double>(taps - 1), pi = std::numbers::pi;
  double sum = 0;
  for (std::size_t j = 0; j < taps; ++j) {
    const double at = static_cast<double>(j) - middle, x = 2 * pi * cutoff * step * at;
    const double window = taps == 1 ? 1 : 0.54 + 0.46 * std::cos(pi * at / middle);
    h[j] = window * (at == 0 ? 1 : std::sin(x) / x);
    sum += h[j];
  }
  for (double& c : h) c /= sum;
  return h;
}

std::vector<double> filtered(const std::vector<double>& x, const std::vector<double>& taps) {
  const std::size_t n = x.size(), delay = (taps.size() - 1) / 2;
  std::vector<double> y(n);
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;  // a sum of differences, so that a motion at rest stays exactly where it is
    for (std::size_t j = 0; j < taps.size(); ++j) {
      const std::size_t at = i + j < delay ? 0 : i + j - delay;
      sum += taps[j] * (x[at < n ? at : n - 1] - x[i]);
    }
    y[i] = x[i] + sum;
  }
  return y;
}

std::vector<double> lagged(const std::vector<double>& x, double time_constant, double step) {
  const double decay = std::exp(-step / time_constant);
  std::vector<double> y(x.size());
  double lag = 0;  // x − y
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (i > 0) {
      const double ramp = time_constant * (x[i] - x[i - 1]) / step;  // the lag behind a ramp that never ends
      lag = ramp + (lag - ramp) * decay;
    }
    y[i] = x[i] - lag;
  }
  return y;
}

}  // namespace bahnwerk
