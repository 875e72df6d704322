#include "core/redundant/iterative/limit_adaptation.hpp"

#include <algorithm>
#include <cmath>

namespace bahnwerk {
namespace {

constexpr double growth = 1.5;        // factor of the least decrease from one such pass to the next
constexpr double largest_least = 30;  // largest multiple of the first least decrease

}  // namespace

AdaptationOptions with_larger_steps(AdaptationOptions options, int passes) {
  options.proportional = true;
  options.least_change *= std::min(std::pow(growth, passes - 1), largest_least);
  return options;
}

bool adapt(std::vector<double>& limits, std::size_t first, const LimitedPeaks& coarse, const LimitedPeaks& fine,
           int iteration, const AdaptationOptions& options) {
  const std::size_t n = coarse.peaks.size();
  const std::vector<double> old(limits.begin() + static_cast<std::ptrdiff_t>(first),
                                limits.begin() + static_cast<std::ptrdiff_t>(first + n));
  const double least = coarse.limit / options.anchor_steps;
  const double anchor = std::max(coarse.limit - (iteration - 1) * least, least);
  bool fell = false;
  const auto lower = [&](std::size_t block, double to, double floor) {
    double& limit = limits[first + block];
    const double next = std::min(limit, std::max(to, floor));
    fell = fell || next < limit;
    limit = next;
  };
  for (std::size_t j = 0; j < n; ++j) {
    if (coarse.peaks[j] > coarse.limit * (1 + options.rounding)) {
      double excess = std::max(coarse.peaks[j] - coarse.limit, options.least_change * old[j]);
      if (options.proportional) excess = std::max(excess, (1 - coarse.limit / coarse.peaks[j]) * old[j]);
      const std::size_t reach = options.spread.size() - 1;
      for (std::size_t i = j - std::min(j, reach); i <= std::min(j + reach, n - 1); ++i)
        lower(i, old[i] - options.spread[i > j ? i - j : j - i] * excess, anchor);
    } else if (fine.peaks[j] > fine.limit * (1 + options.rounding)) {
      const double excess = std::max(fine.peaks[j] - fine.limit, options.least_change * old[j]);
      lower(j, old[j] - options.fine_factor * excess, least);
    }
  }
  return fell;
}

bool adapt_feed(double& feed, double first_feed, const std::vector<SplitPeaks>& peaks, const CoarseFineMachine& machine,
                const AdaptationOptions& options) {
  double excess = 0;
  for (std::size_t k = 0; k < peaks.size(); ++k) {
    const double coarse = machine.axes[k].coarse.velocity, fine = machine.axes[k].fine.velocity;
    if (peaks[k].coarse_velocity > coarse * (1 + options.rounding))
      excess = std::max(excess, peaks[k].coarse_velocity - coarse);
    if (peaks[k].fine_velocity > fine * (1 + options.rounding))
      excess = std::max(excess, peaks[k].fine_velocity - fine);
  }
  if (!(excess > 0)) return false;
  excess = std::max(excess, options.least_change * feed);
  const double next = std::min(feed, std::max(feed - options.feed_factor * excess, first_feed / options.anchor_steps));
  const bool fell = next < feed;
  feed = next;
  return fell;
}

double first_feed(const AxisPath& path, std::size_t segment, double feed, const CoarseFineMachine& machine) {
  const double u0 = path[segment].curve().begin(), u1 = path[segment].curve().end();
  const int places = path.linear(segment) ? 1 : 17;
  for (std::size_t k = 0; k < machine.axes.size(); ++k) {
    double rate = 0;
    for (int i = 0; i < places; ++i)
      rate = std::max(rate, std::abs(path.at_parameter(segment, u0 + (u1 - u0) * i / std::max(1, places - 1)).d1[k]));
    if (rate > 0) feed = std::min(feed, machine.axes[k].coarse.velocity / rate);
  }
  return feed;
}

}  // namespace bahnwerk
