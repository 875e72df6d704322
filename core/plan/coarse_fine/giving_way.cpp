#include "core/plan/coarse_fine/giving_way.hpp"

#include <cmath>
#include <iterator>
#include <utility>

namespace bahnwerk {

std::optional<Check> failed_by_most(const Verification& verification) {
  const auto strain = [](const Check& check) {
    const double times = check.limit > 0 ? check.value / check.limit : unlimited;
    return std::isnan(times) ? unlimited : times;
  };
  std::optional<Check> most;
  for (const Check& check : verification.checks)
    if (!check.passed && (!most || strain(check) > strain(*most))) most = check;
  return most;
}

void GivenUpPlans::add_failed(const std::string& planner, double duration, const Verification& verdict) {
  GaveWay row{planner, GivingWay::verification, duration};
  row.failed = failed_by_most(verdict);
  rows_.push_back(std::move(row));
}

void GivenUpPlans::add(std::vector<GaveWay> rows) { std::move(rows.begin(), rows.end(), std::back_inserter(rows_)); }

std::vector<GaveWay> GivenUpPlans::table(std::vector<GaveWay> more, const std::string& planner, double duration) const {
  std::vector<GaveWay> all = rows_;
  std::move(more.begin(), more.end(), std::back_inserter(all));
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].used.empty()) continue;
    const bool last = i + 1 == all.size();
    all[i].used = last ? planner : all[i + 1].planner;
    all[i].used_duration = last ? duration : all[i + 1].duration;
  }
  return all;
}

}  // namespace bahnwerk
