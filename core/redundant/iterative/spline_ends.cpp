#include "core/redundant/iterative/spline_ends.hpp"

#include <algorithm>
#include <stdexcept>

namespace bahnwerk {

SplineEnds::SplineEnds(const SplineSpace& space, const SplineBegin& begin) : size_(space.size()), end_(begin.end) {
  if (size_ < least(begin)) throw std::invalid_argument("too few control points for the ends");
  const std::vector<double>& k = space.knots();
  const auto m = static_cast<double>(space.degree());
  const std::size_t p = space.degree();
  fixed_.push_back(begin.position);
  fixed_.push_back(begin.position + begin.velocity * (k[p + 1] - k[1]) / m);  // M₁
  if (begin.order == 3) {
    // K₁: the acceleration's first control point is m (m − 1)/(ζ₁) · (Δ₂ − Δ₁).
    const double first = k[p + 1] - k[2], second = k[p + 2] - k[2];
    fixed_.push_back(fixed_[1] + second * (begin.velocity / m + begin.acceleration * first / (m * (m - 1))));
  }
  variables_ = size_ - (least(begin) - 1);
}

VariableRow SplineEnds::reduced(const SplineRow& row) const {
  if (fixes_none_of(row.first, row.count))  // away from the ends
    return {row.first - fixed_.size(), row.count, row.weights, 0};
  VariableRow r;
  bool any = false;
  for (std::size_t i = 0; i < row.count; ++i) {
    const std::size_t control = row.first + i;
    if (control < fixed_.size()) {
      r.offset += row.weights[i] * fixed_[control];
      continue;
    }
    if (end_ && control >= fixed_.size() + variables_) {
      r.offset += row.weights[i] * *end_;
      continue;
    }
    const std::size_t variable = std::min(control - fixed_.size(), variables_ - 1);
    if (!any) r.first = variable, any = true;
    r.weights[variable - r.first] += row.weights[i];
    r.count = std::max(r.count, variable - r.first + 1);
  }
  return r;
}

std::vector<double> SplineEnds::controls(const std::vector<double>& variables) const {
  std::vector<double> d = fixed_;
  d.insert(d.end(), variables.begin(), variables.end());
  d.resize(size_, end_.value_or(variables.back()));
  return d;
}

}  // namespace bahnwerk
