/// The rows of a program: values, continuity, ranges, section limits and peaks at sample points.
#include <algorithm>
#include <cmath>
#include <span>

#include "core/cam/optimal/program/spline_program.hpp"
#include "core/cam/optimal/program/vibration.hpp"

namespace bahnwerk::cam {

/// Writes the weights with which the variables of a section enter s^(order), or the effort, at v of a piece.
void SplineProgram::law_weights(std::size_t section, std::size_t piece, double v, int order,
                                std::vector<double>& out) const {
  if (order == effort_order) {
    std::vector<double> part;
    out.assign(basis_.section(section).size(), 0);
    for (int r = 0; r < 3; ++r) {
      law_weights(section, piece, v, r, part);
      for (std::size_t k = 0; k < out.size(); ++k)
        out[k] += task_.effort->factor[static_cast<std::size_t>(r)] * part[k];
    }
    return;
  }
  const SectionBasis& basis = basis_.section(section);
  out.resize(basis.size());
  basis.weights(piece, v, static_cast<std::size_t>(order), out.data());
  const double length = lengths_[section], power = std::pow(length, -order);
  for (std::size_t k = 0; k < out.size(); ++k)
    if (out[k] != 0) out[k] *= power * coefficient_of_variable(length, k);
}

/// Returns whether the derivatives from an order on are numbers at an end of a section that variables express: where
/// times change, a derivative other than 0 is not one variable's number.
bool SplineProgram::known_at(bool end, std::size_t section, int order) const {
  const Numbers& values = (end ? end_values_ : begin_values_)[section];
  for (auto k = static_cast<std::size_t>(order); k < values.size(); ++k)
    if (!values[k] || (reference_ && k > 0 && *values[k] != 0)) return false;
  return true;
}

/// Writes the weights of s^(order) from the section's end, where the states are numbers: seen backwards the section is
/// one of the mirrored basis. Returns what these numbers contribute. Near the end the weights are as small as the
/// value; those from the begin would only cancel.
double SplineProgram::law_weights_from_end(std::size_t section, std::size_t piece, double v, int order,
                                           std::vector<double>& out) const {
  const SectionBasis& basis = basis_.mirrored(section);
  std::vector<double> mirrored(basis.size());
  basis.weights(basis.pieces() - 1 - piece, 1 - v, static_cast<std::size_t>(order), mirrored.data());
  const double length = lengths_[section], sign = order % 2 == 0 ? 1 : -1;
  const double power = sign * std::pow(length, -order);
  out.assign(basis.size(), 0);
  double known = 0;
  for (auto k = static_cast<std::size_t>(order); k < SectionBasis::states; ++k)
    known += power * (k % 2 == 0 ? 1 : -1) * mirrored[k] * std::pow(length, k) * *end_values_[section][k];
  for (std::size_t k = SectionBasis::states; k < basis.size(); ++k)
    if (mirrored[k] != 0)
      out[SectionBasis::states + basis.size() - 1 - k] = -power * mirrored[k] * coefficient_of_variable(length, k);
  return known;
}

/// Writes the weights of a sample of a section's limit. Where an end of the section has numbers, these are left out of
/// the weights and returned: what is left is as small near that end as the value's distance from them, and the row can
/// be scaled to say what the limit asks of the derivatives that are free.
double SplineProgram::limit_weights(const LawSample& at, std::vector<double>& out) const {
  const SectionBasis& basis = basis_.section(at.section);
  const double place = basis.begin(at.piece) + at.v * basis.length(at.piece);
  if (at.order >= static_cast<int>(SectionBasis::states) || !known_at(place > 0.5, at.section, at.order)) {
    law_weights(at.section, at.piece, at.v, at.order, out);
    return 0;
  }
  if (place > 0.5) return law_weights_from_end(at.section, at.piece, at.v, at.order, out);
  law_weights(at.section, at.piece, at.v, at.order, out);
  const double length = lengths_[at.section];
  double known = 0;
  for (std::size_t k = 0; k < SectionBasis::states; ++k) {
    if (k >= static_cast<std::size_t>(at.order))
      known += out[k] / coefficient_of_variable(length, k) * std::pow(length, k) * *begin_values_[at.section][k];
    out[k] = 0;
  }
  return known;
}

/// Sets variables and weights of a row without the zeros at both ends.
void SplineProgram::set_row(std::size_t section, const std::vector<double>& weights, BorderedRow& row) const {
  std::size_t from = 0, to = weights.size();
  while (to > 1 && weights[to - 1] == 0) --to;
  while (from + 1 < to && weights[from] == 0) ++from;
  row.first = basis_.first(section) + from;
  row.weights = std::span(weights).subspan(from, to - from);
}

void SplineProgram::add_time_terms(std::size_t section, const std::vector<double>& weights, int order, double factor,
                                   std::vector<BorderedRow::Term>& out) const {
  if (!reference_ || order == 0) return;
  double value = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) value += weights[k] * reference_x_[basis_.first(section) + k];
  const double slope = -factor * value * order / lengths_[section];  // change with the section's length
  const std::size_t end = task_.periodic ? task_.end_point(section) : section + 1;
  if (time_border_[section] != BorderedRow::none)
    out.push_back({time_border_[section], -slope * reference_->radius[section]});
  if (time_border_[end] != BorderedRow::none) out.push_back({time_border_[end], slope * reference_->radius[end]});
}

void SplineProgram::build_equalities() {
  const std::size_t n = basis_.degree(), sections = task_.sections();
  std::vector<double> weights;
  std::vector<std::pair<std::size_t, double>> terms;
  std::vector<BorderedRow::Term> times;
  // Appends derivative `order` at the begin or the end of a section, times `sign`. Returns what the numbers at the
  // section's begin contribute where `known` leaves them out: in a short section the others are next to nothing beside
  // them, and the row is scaled to the others.
  const auto append = [&](std::size_t section, bool end, int order, double sign, bool known) {
    law_weights(section, end ? basis_.section(section).pieces() - 1 : 0, end ? 1 : 0, order, weights);
    double constant = 0;
    left_out_.resize(band_.equality_side().size() + 1);
    if (known && !reference_) left_out_.back().push_back(section);
    for (std::size_t k = 0; k < weights.size(); ++k) {
      if (weights[k] == 0) continue;
      if (known && !reference_ && k < SectionBasis::states && begin_values_[section][k])
        constant += sign * weights[k] * *begin_values_[section][k] * std::pow(lengths_[section], k) /
                    coefficient_of_variable(lengths_[section], k);
      else
        terms.emplace_back(basis_.first(section) + k, sign * weights[k]);
    }
    add_time_terms(section, weights, order, sign, times);
    return constant;
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
      const double known = append(left, true, r, 1, true) + append(right, false, r, -1, true);
      const double side = scaled((r == 0 ? task_.travel_at_end(left) : 0) - known);
      if (far)
        band_.add_far_equality(terms, side, times);
      else
        band_.add_equality(terms, side, times);
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
      const double known = append(section, end, condition.order, 1, end);
      const double more = end && condition.order == 0 ? task_.travel_at_end(section) : 0;
      const double side = scaled(condition.range.min + more - known);
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
      for (std::size_t k = basis_.first(point); k < basis_.first(point + 1); ++k) {
        const std::pair<std::size_t, double> variable[] = {{band_.add_variables(1), 1}};
        band_.add_equality(variable, 0);
      }
      continue;
    }
    band_.add_variables(basis_.section(point).size());
    // A limit that is a value is the coefficient of its order; those of higher orders are 0.
    for (int r = 0; r < limited_orders; ++r) {
      const Range& limit = task_.limits[point][static_cast<std::size_t>(r)];
      if (!limit.fixed()) continue;
      for (std::size_t k = static_cast<std::size_t>(r); k < basis_.section(point).size(); ++k) {
        terms.assign(1, {basis_.first(point) + k, 1});
        times.clear();
        const double power = std::pow(lengths_[point], r) / coefficient_of_variable(lengths_[point], k);
        const bool own = SectionBasis::order_of(k) == static_cast<std::size_t>(r);
        if (own && reference_ && limit.min != 0) {  // the variable is the derivative times length^r
          const double slope = limit.min * power * r / lengths_[point];
          const std::size_t end = task_.periodic ? task_.end_point(point) : point + 1;
          if (time_border_[point] != BorderedRow::none)
            times.push_back({time_border_[point], slope * reference_->radius[point]});
          if (time_border_[end] != BorderedRow::none)
            times.push_back({time_border_[end], -slope * reference_->radius[end]});
        }
        band_.add_equality(terms, own ? limit.min * power : 0, times);
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
        const double here = value->range.min + (end && r == 0 ? task_.travel_at_end(section) : 0);
        const double close = 1e-12 * (1 + std::abs(here));
        if (here - limit.min <= close) contacts_.push_back({section, end, q, back});
        if (limit.max - here <= close) contacts_.push_back({section, end, q, -back});
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
  const bool begin = sample.piece == 0 && sample.v == 0,
             end = sample.piece + 1 == basis_.section(sample.section).pieces() && sample.v == 1;
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
    const double unit = peak_unit(floor.section, floor.order);
    terms.assign(1, {peak_border(floor.section, floor.order), 1});
    // d(C/T^r) = −r C/T^(r+1) dT: the tangent of a convex function.
    const double slope = floor.order * floor.peak / lengths_[floor.section] / unit;
    const std::size_t end = task_.periodic ? task_.end_point(floor.section) : floor.section + 1;
    if (time_border_[floor.section] != BorderedRow::none)
      terms.push_back({time_border_[floor.section], -slope * reference_->radius[floor.section]});
    if (time_border_[end] != BorderedRow::none) terms.push_back({time_border_[end], slope * reference_->radius[end]});
    BorderedRow row;
    row.border = terms;
    row.lower = floor.peak / unit;
    band_.add_row(row);
  }
}

void SplineProgram::add_rows() {
  band_.clear_rows();
  std::vector<double> weights;
  std::vector<BorderedRow::Term> times;
  // Adds a derivative at an end of a section, in parts of its largest weight.
  const auto add_end = [&](std::size_t section, bool end, int order, double sign, Range range) {
    law_weights(section, end ? basis_.section(section).pieces() - 1 : 0, end ? 1 : 0, order, weights);
    double most = 0;
    for (const double weight : weights) most = std::max(most, std::abs(weight));
    const double scale = most > 0 ? 1 / most : 1;
    for (double& weight : weights) weight *= sign * scale;
    BorderedRow row;
    set_row(section, weights, row);
    times.clear();
    add_time_terms(section, weights, order, 1, times);
    row.border = times;
    row.lower = range.min * scale;
    row.upper = range.max * scale;
    row.elastic = give_;
    band_.add_row(row);
  };
  for (const std::size_t c : ranges_) {
    const LawTask::Condition& condition = task_.conditions[c];
    const bool last = condition.point == task_.sections();
    add_end(last ? condition.point - 1 : condition.point, last, condition.order, 1, condition.range);
  }
  for (const Contact& contact : contacts_)
    add_end(contact.section, contact.end, contact.order, contact.sign, {0, BorderedRow::unlimited});
  add_floors();
  for (const Sampled& sampled : samples_) {
    const LawSample& at = sampled.sample;
    double known = 0, scale = at.limit ? unit_of(at.order) : peak_unit(at.section, at.order);
    if (at.limit) {
      known = limit_weights(at, weights);
      double most = 0;
      for (const double weight : weights) most = std::max(most, std::abs(weight));
      if (most > 0) scale = std::min(scale, most);
    } else {
      law_weights(at.section, at.piece, at.v, at.order, weights);
    }
    for (double& weight : weights) weight /= scale;
    BorderedRow row;
    set_row(at.section, weights, row);
    times.clear();
    if (at.order == effort_order) {
      std::vector<double> part;
      for (int r = 1; r < 3 && reference_; ++r) {
        law_weights(at.section, at.piece, at.v, r, part);
        add_time_terms(at.section, part, r, task_.effort->factor[static_cast<std::size_t>(r)] / scale, times);
      }
    } else {
      add_time_terms(at.section, weights, at.order, 1, times);
    }
    row.border = times;
    if (at.limit) {
      const Range limit = limit_of(at.section, at.order);
      row.lower = (limit.min - known) / scale;
      row.upper = (limit.max - known) / scale;
      row.elastic = give_;
      row.elastic_weight = unit_of(at.order) / scale;
    } else {
      row.lower = row.upper = 0;
      row.elastic = peak_border(at.section, at.order);
    }
    band_.add_row(row);
  }
  if (objective_limit_ == BorderedRow::unlimited) return;
  std::vector<BorderedRow::Term> terms;
  for (std::size_t g = 0; g < task_.groups.count(); ++g)
    for (std::size_t r = 1; r < limited_orders; ++r)
      if (counted(static_cast<int>(r))) terms.push_back({peak_border_[g][r], peak_cost(g, r)});
  BorderedRow row;
  row.border = terms;
  row.upper = objective_limit_;
  band_.add_row(row);
}

}  // namespace bahnwerk::cam
