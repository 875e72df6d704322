#include "api/views/declared_limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace bahnwerk::api {
namespace {

constexpr std::array<std::string_view, 5> per_time{"", "/s", "/s²", "/s³", "/s⁴"};

Permitted within(double limit) { return {-limit, limit}; }

}  // namespace

void declare_axes(DeclaredLimits& list, const Machine& machine) {
  for (int order = 1; order <= Limits::highest_order; ++order) {
    const auto r = static_cast<std::size_t>(order);
    for (const AxisLimits& axis : machine.axes) {
      const double limit = axis.of(order);
      if (!std::isfinite(limit) || !(limit > 0)) continue;
      list.push_back({std::string(derivative_name(order)) + " " + axis.name, axis.unit + std::string(per_time[r]),
                      axis.name, order, within(limit)});
    }
  }
}

void declare_path(DeclaredLimits& list, const Limits& along) {
  for (int order = 1; order <= 3; ++order) {
    const double limit = along.of(order);
    if (!std::isfinite(limit) || !(limit > 0)) continue;
    const auto r = static_cast<std::size_t>(order);
    const std::string name = order == 1 ? "feed" : "path " + std::string(derivative_name(order));
    list.push_back({name, "mm" + std::string(per_time[r]), "", order, within(limit)});
  }
}

void declare_feeds(DeclaredLimits& list, const std::vector<double>& feed_of_block) {
  DeclaredLimit limit{"feed", "mm/s", "", 1};
  limit.key = "block";
  for (std::size_t b = 0; b < feed_of_block.size(); ++b) {
    const Permitted permitted = within(feed_of_block[b]);
    if (limit.steps.empty() || !(limit.steps.back().permitted == permitted))
      limit.steps.push_back({static_cast<double>(b), permitted});
  }
  const auto is_none = [](const LimitStep& step) { return step.permitted.none(); };
  if (std::all_of(limit.steps.begin(), limit.steps.end(), is_none)) return;
  if (limit.steps.size() == 1) limit.permitted = limit.steps.front().permitted, limit.key.clear(), limit.steps.clear();
  list.push_back(std::move(limit));
}

}  // namespace bahnwerk::api
