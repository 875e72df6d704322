#include "core/cam/optimal/spline_program.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "core/base/progress.hpp"
#include "core/cam/optimal/extrema.hpp"
#include "core/cam/optimal/vibration.hpp"

namespace bahnwerk::cam {
namespace {

constexpr double first_units[limited_orders] = {1, 2, 6, 60};  // of a rest-to-rest law over the mean section
constexpr double significant = 0.01;  // part of the largest multiplier of a section that makes a contact
constexpr double near_peak = 0.9;     // extrema above this part of a peak become sample points

}  // namespace

SplineProgram::SplineProgram(const LawTask& task, const SectionBasis& basis, const std::vector<double>& times,
                             const JointReference* reference)
    : task_(task), basis_(basis), reference_(reference), times_(times), breaks_(task.breaks(times)) {
  for (std::size_t i = 0; i + 1 < breaks_.size(); ++i) lengths_.push_back(breaks_[i + 1] - breaks_[i]);
  for (std::size_t r = 1; r < limited_orders; ++r)
    if (counted(static_cast<int>(r)))
      peak_border_[r] = task.largest_peak && band_.borders() > 0 ? 0 : band_.add_border(1);
  time_border_.assign(task.points(), BorderedRow::none);
  if (reference)
    for (std::size_t i = 0; i < task.points(); ++i)
      if (reference->radius[i] > 0) time_border_[i] = band_.add_border(0);
  build_equalities();
}

void SplineProgram::add_time_terms(std::size_t section, std::size_t first, const std::vector<double>& weights,
                                   int order, double factor, std::vector<BorderedRow::Term>& out) const {
  if (!reference_ || order == 0) return;
  double value = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) value += weights[k] * reference_->coefficients[first + k];
  const double slope = -factor * value * order / lengths_[section];  // over the section's length
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
  for (std::size_t point = 0; point < task_.points(); ++point) {
    const bool last = point == sections;  // of an open law
    if (point > 0 && !last) joint(point - 1, point, point, false);
    for (std::size_t c = 0; c < task_.conditions.size(); ++c) {
      const LawTask::Condition& condition = task_.conditions[c];
      if (condition.point != point) continue;
      if (!condition.range.fixed()) {
        ranges_.push_back(c);
        continue;
      }
      terms.clear();
      times.clear();
      append(last ? point - 1 : point, last, condition.order, 1);
      const double side = scaled(condition.range.min);
      equality_condition_.resize(band_.equality_side().size(), BorderedRow::none);
      band_.add_equality(terms, side, times);
      equality_condition_.push_back(c);
    }
    if (last) continue;
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
  for (const LawTask::Vibration& vibration : task_.vibration)
    for (const VibrationRow& row : vibration_rows(task_, basis_, breaks_, vibration)) {
      terms = row.terms;
      times.clear();
      band_.add_far_equality(terms, scaled(0));
    }
  equality_condition_.resize(band_.equality_side().size(), BorderedRow::none);
  find_contacts();
  range_state_.resize(fixed_rows());
}

/// Where a section begins or ends at a value that is its limit, the first derivative that is not a condition there has
/// to lead back into the limits: what samples near the end say only in the second or third power of their distance.
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

/// Whether the section before has the same value at its end.
bool SplineProgram::shared_begin(const LawSample& sample) const {
  return sample.piece == 0 && sample.v == 0 && task_.joint(sample.section) && task_.sections() > 1 &&
         task_.continuity[sample.section] >= sample.order;
}

/// Whether the value there is a condition: a row without slack would leave the program without interior.
bool SplineProgram::pinned(const LawSample& sample) const {
  const bool begin = sample.piece == 0 && sample.v == 0, end = sample.piece + 1 == basis_.pieces() && sample.v == 1;
  if (!begin && !end) return false;

  const std::size_t at = begin ? sample.section : task_.periodic ? task_.end_point(sample.section) : sample.section + 1;
  return std::any_of(task_.conditions.begin(), task_.conditions.end(), [&](const LawTask::Condition& condition) {
    return condition.point == at && condition.order == sample.order && condition.range.fixed();
  });
}

void SplineProgram::initial_samples() {
  samples_.clear();
  const std::size_t n = basis_.degree();
  for (std::size_t section = 0; section < task_.sections(); ++section)
    for (int r = 0; r < limited_orders; ++r) {
      const Range& limit = task_.limits[section][static_cast<std::size_t>(r)];
      const bool peak = r > 0 && counted(r), limited = !limit.free() && !limit.fixed();
      if (!peak && !limited) continue;
      const std::size_t degree = n > static_cast<std::size_t>(r) ? n - static_cast<std::size_t>(r) : 0;
      const std::size_t count = degree + 2;
      for (std::size_t piece = 0; piece < basis_.pieces(); ++piece)
        for (std::size_t k = 0; k < count; ++k) {
          const double share = static_cast<double>(k) / static_cast<double>(count - 1);
          const double v = 0.5 - 0.5 * std::cos(std::numbers::pi * share);
          // Where pieces meet one of them has the sample.
          if (k + 1 == count && piece + 1 < basis_.pieces() && degree > 0) continue;
          if (peak && !shared_begin({section, piece, v, r, false})) samples_.push_back({{section, piece, v, r, false}});
          if (limited && !pinned({section, piece, v, r, true})) samples_.push_back({{section, piece, v, r, true}});
        }
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

/// The smoothest law of values and continuity, ranges in their middle, in the sense of least squares.
bool SplineProgram::find_start() {
  for (std::size_t r = 0; r < limited_orders; ++r) unit_[r] = first_units[r];
  add_rows();
  const std::size_t sides = band_.inequality_side().size();
  // The squares of rows are kept to the order of the equalities.
  double steepest = 1;
  std::vector<double> magnitudes(basis_.degree() + 1);
  for (const int order : {1, 2, 3}) {
    basis_.weights(0, 0, static_cast<std::size_t>(order), magnitudes.data());
    for (const double length : lengths_)
      for (const double weight : magnitudes)
        steepest =
            std::max(steepest, std::abs(weight) / std::pow(length, order) / unit_[static_cast<std::size_t>(order)]);
  }
  std::vector<double> weights(sides, 1 / (steepest * steepest)), target(sides, 0);
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    const std::size_t upper = band_.upper_side(i), lower = band_.lower_side(i);
    const double above = upper != BorderedRow::none ? band_.inequality_side()[upper] : 0;
    const double below = lower != BorderedRow::none ? -band_.inequality_side()[lower] : 0;
    const bool both = upper != BorderedRow::none && lower != BorderedRow::none;
    const double aim = both ? (above + below) / 2 : upper != BorderedRow::none ? above : below;
    constexpr double strong = 1;
    if (upper != BorderedRow::none) weights[upper] = strong, target[upper] = strong * aim;
    if (lower != BorderedRow::none) weights[lower] = strong, target[lower] = -strong * aim;
  }
  if (!band_.factor(weights)) return false;
  const std::size_t variables = band_.band_variables() + band_.borders();
  point_.x.assign(variables, 0);
  point_.y.assign(band_.equality_side().size(), 0);
  std::vector<double> gx(sides), ex(point_.y.size()), x(variables), y(point_.y.size()), push(sides);
  for (int refinement = 0; refinement < 3; ++refinement) {
    band_.multiply(point_.x, gx, ex);
    for (std::size_t i = 0; i < sides; ++i) push[i] = target[i] - weights[i] * gx[i];
    std::fill(x.begin(), x.end(), 0.0);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = -point_.y[i];
    band_.add_transposed(push, y, x);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = band_.equality_side()[i] - ex[i];
    band_.solve(x, y);
    for (std::size_t i = 0; i < variables; ++i) point_.x[i] += x[i];
    for (std::size_t i = 0; i < y.size(); ++i) point_.y[i] += y[i];
  }
  band_.multiply(point_.x, gx, ex);
  double worst = 0;
  for (std::size_t i = 0; i < ex.size(); ++i) worst = std::max(worst, std::abs(ex[i] - band_.equality_side()[i]));
  start_multipliers_ = point_.y;
  std::fill(point_.y.begin(), point_.y.end(), 0.0);
  return worst < 1e-7;
}

std::vector<double> SplineProgram::derivative(const double* x, std::size_t section, std::size_t piece,
                                              int order) const {
  std::vector<double> b(basis_.degree() + 1);
  basis_.bernstein(piece, x + section * basis_.size(), b.data());
  const double scale = static_cast<double>(basis_.pieces()) / lengths_[section];
  for (int r = 0; r < order; ++r) {
    differentiate_bernstein(b);
    for (double& value : b) value *= scale;
  }
  return b;
}

void SplineProgram::evaluate(SplineResult& result, bool enclosed) {
  found_.clear();
  result.peaks = {};
  result.violation = 0;
  std::vector<Extremum> extrema;
  std::array<double, limited_orders> peaks{};
  for (std::size_t section = 0; section < task_.sections(); ++section)
    for (int order = 0; order < limited_orders; ++order) {
      const auto r = static_cast<std::size_t>(order);
      const Range& limit = task_.limits[section][r];
      const bool peak = order > 0 && counted(order);
      if (!peak && limit.free()) continue;
      for (std::size_t piece = 0; piece < basis_.pieces(); ++piece) {
        const std::vector<double> b = derivative(point_.x.data(), section, piece, order);
        double highest = -std::numeric_limits<double>::infinity(), lowest = -highest;
        if (enclosed) {
          if (peak) peaks[r] = std::max(peaks[r], greatest_magnitude(b).value);
          if (!limit.free()) {
            highest = greatest_value(b).value;
            std::vector<double> minus = b;
            for (double& value : minus) value = -value;
            lowest = -greatest_value(minus).value;
          }
        } else {
          find_extrema(b, extrema);
          for (const Extremum& each : extrema) {
            highest = std::max(highest, each.value);
            lowest = std::min(lowest, each.value);
          }
          if (peak) peaks[r] = std::max({peaks[r], highest, -lowest});
          const double last_peak = peak ? point_.x[band_.border_index(peak_border_[r])] * unit_[r] : 0;
          for (const Extremum& each : extrema) {
            const LawSample peak_sample{section, piece, each.at, order, false};
            const LawSample limit_sample{section, piece, each.at, order, true};
            if (peak && std::abs(each.value) > near_peak * last_peak && !shared_begin(peak_sample))
              found_.push_back(peak_sample);
            if (limit.fixed()) continue;
            if ((each.value > limit.max - 1e-3 * unit_[r] || each.value < limit.min + 1e-3 * unit_[r]) &&
                !pinned(limit_sample))
              found_.push_back(limit_sample);
          }
        }
        if (!limit.free())
          result.violation =
              std::max({result.violation, (highest - limit.max) / unit_[r], (limit.min - lowest) / unit_[r]});
      }
    }
  result.peaks = peaks;
  result.objective = 0;
  for (std::size_t r = 1; r < limited_orders; ++r) {
    const double part = task_.weight[r] * peaks[r];
    result.objective = task_.largest_peak ? std::max(result.objective, part) : result.objective + part;
  }
  std::vector<double> gx(band_.inequality_side().size()), ex(point_.y.size());
  band_.multiply(point_.x, gx, ex);
  for (std::size_t i = 0; i < ex.size(); ++i) {  // rounding aside, these hold
    const double missing = std::abs(ex[i] - band_.equality_side()[i]);
    if (missing > 1e-9) result.violation = std::max(result.violation, missing);
  }
  for (std::size_t i = 0; i < ranges_.size(); ++i)
    for (const std::size_t side : {band_.upper_side(i), band_.lower_side(i)})
      if (side != BorderedRow::none)
        result.violation = std::max(result.violation, gx[side] - band_.inequality_side()[side]);
}

double position_bound(const LawTask& task, double upper) {
  double position = -1, velocity = -1, acceleration = -1;
  std::vector<std::pair<double, double>> known;  // time, |s| at most
  for (const LawTask::Condition& condition : task.conditions) {
    const double most = std::max(std::abs(condition.range.min), std::abs(condition.range.max));
    if (!std::isfinite(most)) continue;
    if (condition.order == 0) position = most;
    if (condition.order == 1) velocity = most;
    if (condition.order == 2) acceleration = most;
  }
  if (position < 0) return 0;
  const double t = task.cycle;
  if (task.weight[1] > 0) return position + upper / task.weight[1] * t;
  if (task.periodic) velocity = acceleration = 0;  // somewhere
  if (velocity < 0) return 0;
  if (task.weight[2] > 0) return position + (velocity + upper / task.weight[2] * t) * t;
  if (acceleration < 0 || !(task.weight[3] > 0)) return 0;
  return position + (velocity + (acceleration + upper / task.weight[3] * t) * t) * t;
}

/// The least change, in the last factors' measure, that makes the multipliers dual feasible but for rounding.
void SplineProgram::settle_multipliers() {
  std::vector<double> gx(point_.z.size()), ex(point_.y.size()), y(point_.y.size());
  for (int refinement = 0; refinement < 3; ++refinement) {
    DualValue dual = dual_value(band_, point_.y, point_.z);
    for (double& value : dual.residual) value = -value;
    std::fill(y.begin(), y.end(), 0.0);
    solve_refined(band_, band_.weights(), dual.residual, y);
    band_.multiply(dual.residual, gx, ex);
    for (std::size_t i = 0; i < point_.z.size(); ++i)
      point_.z[i] = std::max(point_.z[i] * 1e-3, point_.z[i] + band_.weights()[i] * gx[i]);
    for (std::size_t i = 0; i < y.size(); ++i) point_.y[i] += y[i];
  }
}

double SplineProgram::lower_bound(double upper) const {
  const DualValue dual = dual_value(band_, point_.y, point_.z);
  double bound = dual.value;
  const std::size_t size = basis_.size(), n = basis_.degree();
  double magnitude = position_bound(task_, upper);
  if (magnitude == 0) {
    for (std::size_t i = 0; i < band_.band_variables(); ++i)
      magnitude = std::max(magnitude, 1e3 * std::abs(point_.x[i]));
  }
  // What the residual of a section's coefficients is worth, as a sum of values of the law at points.
  Eigen::MatrixXd collocation = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size));
  std::vector<double> weights(n + 1);
  for (std::size_t j = 0; j < size; ++j) {
    double sum = 0;  // Greville abscissa, in pieces
    for (std::size_t k = 1; k <= n; ++k)
      sum += std::clamp(static_cast<double>(j + k) - static_cast<double>(n), 0.0, static_cast<double>(basis_.pieces()));
    const double u = sum / static_cast<double>(n);
    const std::size_t piece = std::min(basis_.pieces() - 1, static_cast<std::size_t>(u));
    basis_.weights(piece, u - static_cast<double>(piece), 0, weights.data());
    for (std::size_t k = 0; k <= n; ++k)
      collocation(static_cast<Eigen::Index>(piece + k), static_cast<Eigen::Index>(j)) = weights[k];
  }
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(collocation);
  for (std::size_t section = 0; section < task_.sections(); ++section) {
    const Eigen::Map<const Eigen::VectorXd> residual(dual.residual.data() + section * size,
                                                     static_cast<Eigen::Index>(size));
    bound -= factors.solve(residual).lpNorm<1>() * magnitude;
  }
  for (std::size_t r = 1; r < limited_orders; ++r)
    if (counted(static_cast<int>(r))) {
      bound -= std::abs(dual.residual[band_.border_index(peak_border_[r])]) * upper / (task_.weight[r] * unit_[r]);
      if (task_.largest_peak) break;
    }
  return bound * unit_objective_;
}

/// Slacks and multipliers for the rows as they are: what a row had, else such that s z = mu.
void SplineProgram::set_point(double mu) {
  const std::vector<double>& g = band_.inequality_side();
  std::vector<double> gx(g.size()), ex(point_.y.size());
  band_.multiply(point_.x, gx, ex);
  point_.s.assign(g.size(), 0);
  point_.z.assign(g.size(), 0);
  const auto set = [&](std::size_t side, double multiplier) {
    if (side == BorderedRow::none) return;
    point_.s[side] = std::max(g[side] - gx[side], std::sqrt(mu) * 1e-2);
    const double centred = mu / point_.s[side];
    point_.z[side] = multiplier < 0 ? centred : std::clamp(multiplier, 0.01 * centred, 100 * centred);
  };
  static const Sampled unknown{};
  for (std::size_t row = 0; row < band_.rows(); ++row) {
    const Sampled& from = row >= fixed_rows() + samples_.size() ? unknown
                          : row < fixed_rows()                  ? range_state_[row]
                                                                : samples_[row - fixed_rows()];
    set(band_.upper_side(row), from.upper);
    set(band_.lower_side(row), from.lower);
  }
}

/// Multipliers of equalities may be large: what is missing there is taken out with the last factors.
void SplineProgram::settle_equalities() {
  std::vector<double> gx(band_.inequality_side().size()), ex(point_.y.size()), x(point_.x.size());
  for (int refinement = 0; refinement < 2; ++refinement) {
    band_.multiply(point_.x, gx, ex);
    for (std::size_t i = 0; i < ex.size(); ++i) ex[i] = band_.equality_side()[i] - ex[i];
    std::fill(x.begin(), x.end(), 0.0);
    band_.solve(x, ex);
    for (std::size_t i = 0; i < band_.band_variables(); ++i) point_.x[i] += x[i];
  }
}

/// Sample points of the next round: the extrema of the last law, and for each contact where the multipliers have their
/// centre with two points close by. Where a peak is touched by a maximum that can move, the law of a program with some
/// points leans on the two next to it, and the multipliers' centre is the contact but for the square of their distance;
/// extrema alone would only halve it each round.
void SplineProgram::exchange() {
  const auto keep = [&](Sampled& sampled, std::size_t row) {
    const std::size_t upper = band_.upper_side(row), lower = band_.lower_side(row);
    sampled.slack = BorderedRow::unlimited;
    if (upper != BorderedRow::none) sampled.upper = point_.z[upper], sampled.slack = point_.s[upper];
    if (lower != BorderedRow::none)
      sampled.lower = point_.z[lower], sampled.slack = std::min(sampled.slack, point_.s[lower]);
  };
  for (std::size_t i = 0; i < fixed_rows(); ++i) keep(range_state_[i], i);
  for (std::size_t i = 0; i < samples_.size(); ++i) keep(samples_[i], fixed_rows() + i);
  const auto group = [](const LawSample& a) { return std::tuple(a.section, a.order, a.limit); };
  const auto place = [](const LawSample& a) { return static_cast<double>(a.piece) + a.v; };
  // Rows of one section, order and kind, ascending.
  std::vector<std::size_t> order(samples_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const LawSample &x = samples_[a].sample, &y = samples_[b].sample;
    return std::tuple(group(x), place(x)) < std::tuple(group(y), place(y));
  });
  const auto add = [&](LawSample sample, double at) {
    at = std::clamp(at, 0.0, static_cast<double>(basis_.pieces()));
    sample.piece = std::min(static_cast<std::size_t>(at), basis_.pieces() - 1);
    sample.v = at - static_cast<double>(sample.piece);
    found_.push_back(sample);
  };
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && group(samples_[order[end]].sample) == group(samples_[order[begin]].sample)) ++end;
    for (const auto side : {&Sampled::upper, &Sampled::lower}) {
      double most = 0;
      for (std::size_t k = begin; k < end; ++k) most = std::max(most, samples_[order[k]].*side);
      for (std::size_t k = begin; k < end && most > 0;) {
        if (samples_[order[k]].*side < significant * most) {
          ++k;
          continue;
        }
        double mass = 0, moment = 0;
        const std::size_t from = k;
        for (; k < end && samples_[order[k]].*side >= significant * most; ++k) {
          const double z = samples_[order[k]].*side;
          mass += z;
          moment += z * place(samples_[order[k]].sample);
        }
        if (k - from < 2) continue;
        const LawSample& first = samples_[order[from]].sample;
        const double width = place(samples_[order[k - 1]].sample) - place(first), centre = moment / mass;
        if (width < 1e-5) continue;
        for (const double share : {-0.05, 0.0, 0.05}) add(first, centre + share * width);
      }
    }
    begin = end;
  }
  // Points far from any contact have done their part.
  std::size_t kept = initial_;
  for (std::size_t i = initial_; i < samples_.size(); ++i)
    if (samples_[i].slack < 0.3) samples_[kept++] = samples_[i];
  samples_.resize(kept);
  for (const LawSample& sample : found_) {
    const bool known = std::any_of(samples_.begin(), samples_.end(), [&](const Sampled& other) {
      return group(other.sample) == group(sample) && std::abs(place(other.sample) - place(sample)) < 1e-6;
    });
    if (!known) samples_.push_back({sample});
  }
}

/// Sets the shared peaks to `factor` times those given.
void SplineProgram::set_peaks(const std::array<double, limited_orders>& peaks, double factor) {
  double most = 0;
  for (std::size_t r = 1; r < limited_orders; ++r)
    if (counted(static_cast<int>(r))) most = std::max(most, peaks[r] / unit_[r]);
  for (std::size_t r = 1; r < limited_orders; ++r)
    if (counted(static_cast<int>(r)))
      point_.x[band_.border_index(peak_border_[r])] = factor * (task_.largest_peak ? most : peaks[r] / unit_[r]);
}

/// The first law with peaks above its own and multipliers of one complementarity.
void SplineProgram::center() {
  point_.x = start_;
  std::fill(point_.y.begin(), point_.y.end(), 0.0);
  for (Sampled& sampled : samples_) sampled.upper = sampled.lower = -1;
  for (Sampled& sampled : range_state_) sampled.upper = sampled.lower = -1;
  set_point(0.2 / static_cast<double>(std::max<std::size_t>(1, band_.rows())));
}

SplineResult SplineProgram::solve(const SplineOptions& options, Progress& progress,
                                  const std::vector<LawSample>* samples) {
  SplineResult result;
  result.breaks = breaks_;
  initial_samples();
  initial_ = samples_.size();
  if (samples)
    for (const LawSample& sample : *samples) samples_.push_back({sample});
  if (!find_start()) return result;
  // Units from the first law's own peaks, the objective's from its J.
  evaluate(result, false);
  set_units(result.peaks);
  set_peaks(result.peaks, 1.2);
  start_ = point_.x;
  add_rows();
  center();
  const double first_objective = std::max(result.objective, 1e-300);
  double gap = 1, last_gap = 1;
  int stalled = 0, failed = 0;
  SplineResult best;
  for (;; ++result.rounds) {
    InteriorPointOptions interior;
    interior.gap = std::max(options.gap * 0.05, std::min(1e-3, 0.02 * gap));
    interior.residual = 1e-9;
    interior.tick = [&] { progress.report("optimal law", 0); };
    interior.max_iterations = 30;
    InteriorPointResult inner = solve_interior_point(band_, point_, interior);
    result.iterations += inner.iterations;
    if (!inner.converged) {  // from the middle again, with the same points
      center();
      interior.max_iterations = 60;
      inner = solve_interior_point(band_, point_, interior);
      result.iterations += inner.iterations;
    }
    settle_equalities();
    settle_multipliers();
    evaluate(result, false);
    const double lower = lower_bound(result.objective);
    if (std::isfinite(lower) && (result.rounds == 0 || lower > result.lower)) result.lower = lower;
    // A law that keeps the limits is kept until a better one is found.
    const bool finite = std::all_of(point_.x.begin(), point_.x.end(), [](double x) { return std::isfinite(x); });
    if (!finite) {  // another set of points may do
      if (++failed > 2) break;
      exchange();
      add_rows();
      center();
      continue;
    }
    const bool holds = result.violation <= options.violation;
    if (!best.feasible || (holds && (best.violation > options.violation || result.objective < best.objective)) ||
        (!holds && best.violation > options.violation && result.violation < best.violation)) {
      best.feasible = true;
      best.objective = result.objective;
      best.violation = result.violation;
      best.coefficients = point_.x;
    }
    gap = (best.objective - std::max(result.lower, 0.0)) / std::max(best.objective, 1e-3 * first_objective);
    if (gap <= options.gap && best.violation <= options.violation) break;
    if ((!inner.converged && ++failed > 2) || result.rounds + 1 >= options.max_rounds) break;
    if (gap < 0.5 * last_gap) {
      last_gap = gap;
      stalled = 0;
    } else if (++stalled >= 5) {
      break;
    }
    exchange();
    add_rows();
    set_peaks(result.peaks, 1 + 0.1 * std::max(gap, 1e-9));
    set_point(10 * std::max(gap, 1e-9) / static_cast<double>(point_.s.size()));
  }
  if (!best.feasible) return result;
  point_.x = best.coefficients;
  evaluate(result, true);
  // A bound above a law's own J is Farkas' certificate that no law keeps all ranges and limits.
  result.feasible = best.feasible && result.violation <= 1e-6 && result.lower <= result.objective * (1 + 1e-6);
  result.lower = std::max(result.lower, 0.0);
  result.converged =
      result.feasible &&
      result.objective - result.lower <= 1.5 * options.gap * std::max(result.objective, 1e-3 * first_objective) &&
      result.violation <= options.violation;
  result.coefficients.assign(point_.x.begin(), point_.x.begin() + static_cast<std::ptrdiff_t>(band_.band_variables()));
  for (std::size_t i = initial_; i < samples_.size(); ++i)
    if (samples_[i].slack < 0.05) result.samples.push_back(samples_[i].sample);
  return result;
}

void SplineProgram::set_units(const std::array<double, limited_orders>& peaks) {
  unit_[0] = first_units[0];
  if (task_.largest_peak) {  // the limits themselves
    unit_objective_ = 1;
    for (std::size_t r = 1; r < limited_orders; ++r)
      unit_[r] = counted(static_cast<int>(r)) ? 1 / task_.weight[r] : first_units[r];
    band_.set_border_cost(0, 1);
    return;
  }
  unit_objective_ = 0;
  for (std::size_t r = 1; r < limited_orders; ++r) {
    unit_[r] = first_units[r];
    if (!counted(static_cast<int>(r))) continue;
    unit_[r] = std::max(peaks[r], 1e-6 * first_units[r]);
    unit_objective_ += task_.weight[r] * unit_[r];
  }
  for (std::size_t r = 1; r < limited_orders; ++r)
    if (counted(static_cast<int>(r)))
      band_.set_border_cost(peak_border_[r], task_.weight[r] * unit_[r] / unit_objective_);
}

LawConflict SplineProgram::find_conflict(Progress& progress) {
  LawConflict conflict;
  initial_samples();
  if (!find_start()) {
    // The multipliers of a contradiction grow along the null vector of the conditions.
    conflict.values = true;
    double most = 0;
    for (const double y : start_multipliers_) most = std::max(most, std::abs(y));
    for (std::size_t i = 0; i < start_multipliers_.size(); ++i)
      if (equality_condition_[i] != BorderedRow::none && std::abs(start_multipliers_[i]) > 1e-3 * most)
        conflict.conditions.push_back(equality_condition_[i]);
    return conflict;
  }
  SplineResult law;
  evaluate(law, false);
  const std::vector<double> smooth(point_.x.begin(),
                                   point_.x.begin() + static_cast<std::ptrdiff_t>(band_.band_variables()));
  give_ = band_.add_border(1);
  set_units(law.peaks);
  const std::array<double, limited_orders> smooth_peaks = law.peaks;
  constexpr double little = 1e-4;  // cost of the peaks, for a law that is bounded
  for (std::size_t r = 1; r < limited_orders; ++r)
    if (counted(static_cast<int>(r)))
      band_.set_border_cost(peak_border_[r], little * task_.weight[r] * unit_[r] / unit_objective_);
  double give = 1 + 2 * law.violation;
  InteriorPointOptions interior;
  interior.gap = 1e-6;
  interior.residual = 1e-7;
  interior.tick = [&] { progress.report("optimal law", 0); };
  for (int round = 0; round < 4; ++round) {
    add_rows();
    point_.x.assign(band_.band_variables() + band_.borders(), 0);
    std::copy(smooth.begin(), smooth.end(), point_.x.begin());
    std::fill(point_.y.begin(), point_.y.end(), 0.0);
    set_peaks(smooth_peaks, 1.2);
    const std::vector<double>& g = band_.inequality_side();
    std::vector<double> gx(g.size()), ex(point_.y.size());
    band_.multiply(point_.x, gx, ex);
    for (std::size_t i = 0; i < g.size(); ++i) give = std::max(give, 1.1 * (gx[i] - g[i]));
    point_.x[band_.border_index(give_)] = give;
    for (Sampled& sampled : samples_) sampled.upper = sampled.lower = -1;
    for (Sampled& sampled : range_state_) sampled.upper = sampled.lower = -1;
    set_point(0.2 * (1 + give) / static_cast<double>(std::max<std::size_t>(1, band_.rows())));
    solve_interior_point(band_, point_, interior);
    conflict.violation = point_.x[band_.border_index(give_)];
    evaluate(law, false);
    if (conflict.violation > 1e-3) break;
    exchange();
  }
  double most = 0;
  for (const double z : point_.z) most = std::max(most, z);
  const auto taken = [&](std::size_t row) {
    for (const std::size_t side : {band_.upper_side(row), band_.lower_side(row)})
      if (side != BorderedRow::none && point_.z[side] > 1e-2 * most) return true;
    return false;
  };
  for (std::size_t i = 0; i < ranges_.size(); ++i)
    if (taken(i)) conflict.conditions.push_back(ranges_[i]);
  for (std::size_t i = 0; i < samples_.size() && fixed_rows() + i < band_.rows(); ++i) {
    const LawSample& sample = samples_[i].sample;
    const std::pair<std::size_t, int> limit{sample.section, sample.order};
    if (sample.limit && taken(fixed_rows() + i) &&
        std::find(conflict.limits.begin(), conflict.limits.end(), limit) == conflict.limits.end())
      conflict.limits.push_back(limit);
  }
  return conflict;
}

JointStep SplineProgram::joint_step(const std::vector<LawSample>& samples, Progress& progress) {
  initial_samples();
  for (const LawSample& sample : samples) samples_.push_back({sample});
  // The law at the times as they are is the start: it keeps all rows, with peaks above its own.
  point_.x.assign(band_.band_variables() + band_.borders(), 0);
  std::copy(reference_->coefficients.begin(), reference_->coefficients.end(), point_.x.begin());
  point_.y.assign(band_.equality_side().size(), 0);
  SplineResult law;
  for (std::size_t r = 0; r < limited_orders; ++r) unit_[r] = first_units[r];
  add_rows();
  evaluate(law, false);
  set_units(law.peaks);
  set_peaks(law.peaks, 1.1);
  add_rows();
  for (std::size_t i = 0; i < task_.points(); ++i) {
    if (time_border_[i] == BorderedRow::none) continue;
    const BorderedRow::Term one[] = {{time_border_[i], 1}};
    BorderedRow row;
    row.border = one;
    const double radius = reference_->radius[i];
    row.lower = std::max(-radius, task_.at[i].min - times_[i]);
    row.upper = std::min(radius, task_.at[i].max - times_[i]);
    // Rows are of the order of 1.
    const BorderedRow::Term scaled[] = {{time_border_[i], 1 / radius}};
    row.border = scaled;
    row.lower /= radius;
    row.upper /= radius;
    band_.add_row(row);
    point_.x[band_.border_index(time_border_[i])] = radius * std::clamp((row.lower + row.upper) / 2, -0.2, 0.2);
  }
  range_state_.resize(fixed_rows());
  set_point(0.05 / static_cast<double>(band_.rows()));
  InteriorPointOptions interior;
  interior.gap = 1e-8;
  interior.residual = 1e-8;
  interior.max_iterations = 50;
  interior.tick = [&] { progress.report("optimal law", 0); };
  const InteriorPointResult inner = solve_interior_point(band_, point_, interior);
  JointStep step;
  step.converged = inner.gap < 1e-3 && inner.primal_residual < 1e-4;
  step.times = times_;
  for (std::size_t i = 0; i < task_.points(); ++i)
    if (time_border_[i] != BorderedRow::none)
      step.times[i] =
          std::clamp(times_[i] + point_.x[band_.border_index(time_border_[i])], task_.at[i].min, task_.at[i].max);
  for (std::size_t r = 1; r < limited_orders; ++r)
    if (task_.largest_peak)
      step.objective = point_.x[band_.border_index(0)];
    else if (counted(static_cast<int>(r)))
      step.objective += task_.weight[r] * unit_[r] * point_.x[band_.border_index(peak_border_[r])];
  return step;
}

}  // namespace bahnwerk::cam
