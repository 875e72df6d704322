/// The rows of a program: values, continuity, ranges, section limits and peaks at sample points.
#include <algorithm>
#include <cmath>

#include "core/cam/optimal/program/spline_program.hpp"
#include "core/cam/optimal/vibration.hpp"

namespace bahnwerk::cam {

void SplineProgram::add_time_terms(std::size_t section, std::size_t first, const std::vector<double>& weights,
                                   int order, double factor, std::vector<BorderedRow::Term>& out) const {
  if (!reference_ || order == 0) return;
  double value = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) value += weights[k] * reference_->coefficients[first + k];
  const double slope = -factor * value * order / lengths_[section];  // change with the section's length
  const std::size_t end = task_.periodic ? task_.end_point(section) : section + 1;
  if (time_border_[section] != BorderedRow::none) out.push_back({time_border_[section], -slope});
  if (time_border_[end] != BorderedRow::none) out.push_back({time_border_[end], slope});
}

void SplineProgram::build_equalities() {
  const std::size_t n = basis_.degree(), size = basis_.size(), sections = task_.sections();
  std::vector<double> weights(n + 1);
  std::vector<std::pair<std::size_t, double>> terms;
  std::vector<BorderedRow::Term> times;
  // Appends derivative `order` at the begin or the end of a section, times `sign`.
  const auto append = [&](std::size_t section, bool end, int order, double sign) {
    const std::size_t piece = end ? basis_.pieces() - 1 : 0;
    basis_.weights(piece, end ? 1 : 0, static_cast<std::size_t>(order), weights.data());
    const double scale = sign / std::pow(lengths_[section], order);
    for (std::size_t k = 0; k <= n; ++k)
      if (weights[k] != 0) terms.emplace_back(section * size + piece + k, scale * weights[k]);
    add_time_terms(section, section * size + piece, weights, order, scale, times);
  };
  const auto scaled = [&](double side) {
    double most = 0;
    for (const auto& term : terms) most = std::max(most, std::abs(term.second));
    if (most > 0)
      for (auto& term : terms) term.second /= most;
    if (most > 0)
      for (auto& term : times) term.weight /= most;
    return most > 0 ? side / most : side;
  };
  const auto joint = [&](std::size_t left, std::size_t right, std::size_t point, bool far) {
    if (task_.is_given(left) || task_.is_given(right)) return;
    for (int r = 0; r <= std::min(task_.continuity[point], static_cast<int>(n)); ++r) {
      terms.clear();
      times.clear();
      append(left, true, r, 1);
      append(right, false, r, -1);
      scaled(0);
      if (far)
        band_.add_far_equality(terms, 0, times);
      else
        band_.add_equality(terms, 0, times);
    }
  };
  // Conditions at a point for the section that begins there, or for the one that ends there.
  const auto conditions = [&](std::size_t point, std::size_t section, bool end) {
    for (std::size_t c = 0; c < task_.conditions.size(); ++c) {
      const LawTask::Condition& condition = task_.conditions[c];
      if (condition.point != point) continue;
      if (!condition.range.fixed()) {
        ranges_.push_back(c);
        continue;
      }
      terms.clear();
      times.clear();
      append(section, end, condition.order, 1);
      const double side = scaled(condition.range.min);
      equality_condition_.resize(band_.equality_side().size(), BorderedRow::none);
      band_.add_equality(terms, side, times);
      equality_condition_.push_back(c);
    }
  };
  for (std::size_t point = 0; point < task_.points(); ++point) {
    const bool last = point == sections;  // the end of an open law
    if (point > 0 && !last) joint(point - 1, point, point, false);
    if (!last && !task_.is_given(point))
      conditions(point, point, false);
    else if (point > 0 && !task_.is_given(point - 1))
      conditions(point, point - 1, true);
    if (last) continue;
    if (task_.is_given(point)) {
      for (std::size_t k = 0; k < size; ++k) {
        const std::pair<std::size_t, double> variable[] = {{band_.add_variables(1), 1}};
        band_.add_equality(variable, 0);
      }
      continue;
    }
    band_.add_variables(size);
    // A limit that is a value holds where as many values say so as the derivative has coefficients.
    for (int r = 0; r < limited_orders; ++r) {
      const Range& limit = task_.limits[point][static_cast<std::size_t>(r)];
      if (!limit.fixed()) continue;
      const std::size_t count = size - std::min(size, static_cast<std::size_t>(r));
      for (std::size_t k = 0; k < count; ++k) {
        const double u =
            (static_cast<double>(k) + 0.5) / static_cast<double>(count) * static_cast<double>(basis_.pieces());
        const std::size_t piece = std::min(static_cast<std::size_t>(u), basis_.pieces() - 1);
        basis_.weights(piece, u - static_cast<double>(piece), static_cast<std::size_t>(r), weights.data());
        const double scale = 1 / std::pow(lengths_[point], r);
        terms.clear();
        times.clear();
        for (double& weight : weights) weight *= scale;
        for (std::size_t i = 0; i <= n; ++i)
          if (weights[i] != 0) terms.emplace_back(point * size + piece + i, weights[i]);
        add_time_terms(point, point * size + piece, weights, r, 1, times);
        const double side = scaled(limit.min);
        band_.add_equality(terms, side, times);
      }
    }
  }
  if (task_.periodic) joint(sections - 1, 0, 0, true);
  if (task_.periodic && task_.is_given(0) && !task_.is_given(sections - 1)) conditions(0, sections - 1, true);
  for (const LawTask::Vibration& vibration : task_.vibration)
    for (const VibrationRow& row : vibration_rows(task_, basis_, breaks_, vibration)) {
      terms = row.terms;
      times.clear();
      const double side = scaled(-row.given);
      band_.add_far_equality(terms, side);
    }
  equality_condition_.resize(band_.equality_side().size(), BorderedRow::none);
  find_contacts();
  range_state_.resize(fixed_rows());
}

/// A section that begins or ends at a value that is its limit has to lead back into the limits: the first derivative
/// that is not a condition there must point inside. Samples near the end say that only in the second or third power of
/// their distance.
void SplineProgram::find_contacts() {
  for (std::size_t section = 0; section < task_.sections(); ++section)
    for (const bool end : {false, true}) {
      const std::size_t point = !end ? section : task_.periodic ? task_.end_point(section) : section + 1;
      const auto fixed = [&](int order) -> const LawTask::Condition* {
        for (const LawTask::Condition& condition : task_.conditions)
          if (condition.point == point && condition.order == order && condition.range.fixed()) return &condition;
        return nullptr;
      };
      for (int r = 0; r < limited_orders; ++r) {
        const Range& limit = task_.limits[section][static_cast<std::size_t>(r)];
        const LawTask::Condition* const value = limit.free() || limit.fixed() ? nullptr : fixed(r);
        if (!value) continue;
        int q = r + 1;
        while (fixed(q) && fixed(q)->range.min == 0) ++q;
        if (fixed(q) || q > static_cast<int>(basis_.degree())) continue;
        const double back = end && (q - r) % 2 == 1 ? -1 : 1;
        const double close = 1e-12 * (1 + std::abs(value->range.min));
        if (value->range.min - limit.min <= close) contacts_.push_back({section, end, q, back});
        if (limit.max - value->range.min <= close) contacts_.push_back({section, end, q, -back});
      }
    }
}

/// Returns whether the section before has the same value at its end.
bool SplineProgram::shared_begin(const LawSample& sample) const {
  return sample.piece == 0 && sample.v == 0 && task_.joint(sample.section) && task_.sections() > 1 &&
         task_.continuity[sample.section] >= sample.order;
}

/// Returns whether the value there is a condition: a row without slack would leave the program without interior.
bool SplineProgram::pinned(const LawSample& sample) const {
  const bool begin = sample.piece == 0 && sample.v == 0, end = sample.piece + 1 == basis_.pieces() && sample.v == 1;
  if (!begin && !end) return false;

  const std::size_t at = begin ? sample.section : task_.periodic ? task_.end_point(sample.section) : sample.section + 1;
  return std::any_of(task_.conditions.begin(), task_.conditions.end(), [&](const LawTask::Condition& condition) {
    return condition.point == at && condition.order == sample.order && condition.range.fixed();
  });
}

/// Adds the rows that keep peaks at least as large as those of given sections, which fall as sections get longer.
void SplineProgram::add_floors() {
  std::vector<BorderedRow::Term> terms;
  for (const Floor& floor : floors_) {
    const auto r = static_cast<std::size_t>(floor.order);
    terms.assign(1, {peak_border_[r], 1});
    // d(C/T^r) = −r C/T^(r+1) dT: the tangent of a convex function.
    const double slope = floor.order * floor.peak / lengths_[floor.section] / unit_[r];
    const std::size_t end = task_.periodic ? task_.end_point(floor.section) : floor.section + 1;
    if (time_border_[floor.section] != BorderedRow::none) terms.push_back({time_border_[floor.section], -slope});
    if (time_border_[end] != BorderedRow::none) terms.push_back({time_border_[end], slope});
    BorderedRow row;
    row.border = terms;
    row.lower = floor.peak / unit_[r];
    band_.add_row(row);
  }
}

void SplineProgram::add_rows() {
  band_.clear_rows();
  const std::size_t n = basis_.degree(), size = basis_.size();
  std::vector<double> weights(n + 1);
  std::vector<BorderedRow::Term> times;
  for (const std::size_t c : ranges_) {
    const LawTask::Condition& condition = task_.conditions[c];
    const bool last = condition.point == task_.sections();
    const std::size_t section = last ? condition.point - 1 : condition.point, piece = last ? basis_.pieces() - 1 : 0;
    basis_.weights(piece, last ? 1 : 0, static_cast<std::size_t>(condition.order), weights.data());
    double most = 0;
    for (const double weight : weights) most = std::max(most, std::abs(weight));
    const double scale = most > 0 ? 1 / most : 1, power = std::pow(lengths_[section], condition.order);
    for (double& weight : weights) weight *= scale;
    BorderedRow row;
    row.first = section * size + piece;
    times.clear();
    add_time_terms(section, row.first, weights, condition.order, 1, times);
    row.border = times;
    row.weights = weights;
    row.lower = condition.range.min * power * scale;
    row.upper = condition.range.max * power * scale;
    row.elastic = give_;
    band_.add_row(row);
  }
  for (const Contact& contact : contacts_) {
    const std::size_t piece = contact.end ? basis_.pieces() - 1 : 0;
    basis_.weights(piece, contact.end ? 1 : 0, static_cast<std::size_t>(contact.order), weights.data());
    double most = 0;
    for (const double weight : weights) most = std::max(most, std::abs(weight));
    for (double& weight : weights) weight *= contact.sign / most;
    BorderedRow row;
    row.first = contact.section * size + piece;
    times.clear();
    add_time_terms(contact.section, row.first, weights, contact.order, 1, times);
    row.border = times;
    row.weights = weights;
    row.lower = 0;
    row.elastic = give_;
    band_.add_row(row);
  }
  add_floors();
  for (const Sampled& sampled : samples_) {
    const LawSample& at = sampled.sample;
    const auto r = static_cast<std::size_t>(at.order);
    basis_.weights(at.piece, at.v, r, weights.data());
    const double scale = 1 / (std::pow(lengths_[at.section], at.order) * unit_[r]);
    for (double& weight : weights) weight *= scale;
    BorderedRow row;
    row.first = at.section * size + at.piece;
    times.clear();
    add_time_terms(at.section, row.first, weights, at.order, 1, times);
    row.border = times;
    row.weights = weights;
    if (at.limit) {
      const Range& limit = task_.limits[at.section][r];
      row.lower = limit.min / unit_[r];
      row.upper = limit.max / unit_[r];
      row.elastic = give_;
    } else {
      row.lower = row.upper = 0;
      row.elastic = peak_border_[r];
    }
    band_.add_row(row);
  }
}

}  // namespace bahnwerk::cam
