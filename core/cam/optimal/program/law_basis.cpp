#include "core/cam/optimal/program/law_basis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bahnwerk::cam {

double published_rounding(const LawTask& task, int degree, double length, int order) {
  double largest = std::abs(task.origin) / task.unit_position + std::abs(task.travel);
  for (const LawTask::Condition& condition : task.conditions)
    for (const double end : {condition.range.min, condition.range.max})
      if (condition.order == 0 && std::isfinite(end))
        largest = std::max(largest, std::abs(end + task.origin / task.unit_position));
  double factor = std::numeric_limits<double>::epsilon() * std::max(largest, 1.0);
  for (int k = 0; k < order; ++k) factor *= 2 * static_cast<double>(degree - k) / length;
  return factor;
}

int kept_order(const LawTask& task, std::size_t section) {
  int order = task.effort ? 2 : 1;
  for (int r = 1; r < limited_orders; ++r)
    if (task.weight[static_cast<std::size_t>(r)] > 0 || !task.limits[section][static_cast<std::size_t>(r)].free())
      order = std::max(order, r);
  for (const std::size_t point : {section, task.periodic ? task.end_point(section) : section + 1})
    if (task.joint(point)) order = std::max(order, std::min(task.continuity[point], limited_orders - 1));
  return order;
}

bool is_expressible(const LawTask& task, std::size_t section, int degree) {
  if (task.is_given(section) || task.constant_velocity(section)) return true;
  const std::vector<double> breaks = task.breaks(task.middle());
  const int order = kept_order(task, section);
  return published_rounding(task, degree, breaks[section + 1] - breaks[section], order) <=
         1e-4 * task.size[static_cast<std::size_t>(order)];
}

bool is_expressible(const LawTask& task, int degree) {
  for (std::size_t s = 0; s < task.sections(); ++s)
    if (!is_expressible(task, s, degree)) return false;
  return true;
}

double coefficient_of_variable(double length, std::size_t k) {
  const double part = length / std::max(1.0, length);
  const std::size_t order = SectionBasis::order_of(k);
  return order == 0 ? 1 : order == 1 ? part : order == 2 ? part * part : part * part * part;
}

LawBasis::LawBasis(const LawTask& task, int degree, int pieces)
    : degree_(static_cast<std::size_t>(degree)), pieces_(static_cast<std::size_t>(pieces)) {
  constexpr double little = 1e-6;
  const std::vector<double> breaks = task.breaks(task.middle());
  for (std::size_t s = 0; s < task.sections(); ++s) {
    const int order = kept_order(task, s);
    const double length = breaks[s + 1] - breaks[s];
    int count = pieces;
    while (count > 1 && (pieces % count != 0 || !(published_rounding(task, degree, length / count, order) <=
                                                  little * task.size[static_cast<std::size_t>(order)])))
      --count;
    add_section(equal_breaks(count));
  }
}

LawBasis::LawBasis(int degree, const std::vector<std::vector<double>>& breaks)
    : degree_(static_cast<std::size_t>(degree)), pieces_(0) {
  for (const std::vector<double>& each : breaks) {
    add_section(each);
    pieces_ = std::max(pieces_, each.size() - 1);
  }
}

std::size_t LawBasis::find(const std::vector<double>& breaks) {
  const auto same = [](double a, double b) { return std::abs(a - b) < 1e-15; };
  std::size_t i = 0;
  while (i < bases_.size() &&
         !std::equal(breaks.begin(), breaks.end(), bases_[i].breaks().begin(), bases_[i].breaks().end(), same))
    ++i;
  if (i == bases_.size()) bases_.emplace_back(static_cast<int>(degree_), breaks);
  return i;
}

void LawBasis::add_section(const std::vector<double>& breaks) {
  std::vector<double> backwards(breaks.rbegin(), breaks.rend());
  for (double& at : backwards) at = 1 - at;
  of_section_.push_back(find(breaks));
  mirrored_.push_back(find(backwards));
  first_.push_back(first_.back() + bases_[of_section_.back()].size());
}

}  // namespace bahnwerk::cam
