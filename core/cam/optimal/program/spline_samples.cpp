/// Evaluates the current law: its true peaks and violations, and the sample points that its extrema and contacts ask
/// for.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "core/cam/optimal/program/spline_program.hpp"
#include "core/cam/optimal/task/extrema.hpp"

namespace bahnwerk::cam {
namespace {

constexpr double significant = 0.01;  // part of the largest multiplier of a section that makes a contact
constexpr double near_peak = 0.9;     // extrema above this part of a peak become sample points

/// Writes a polynomial in Bernstein form with one degree more.
void raise_degree(std::vector<double>& b) {
  const double degree = static_cast<double>(b.size());
  b.push_back(b.back());
  for (std::size_t k = b.size() - 2; k > 0; --k) {
    const double share = static_cast<double>(k) / degree;
    b[k] = share * b[k - 1] + (1 - share) * b[k];
  }
}

}  // namespace

/// Returns the limit of a derivative, or of the effort, in a section.
Range SplineProgram::limit_of(std::size_t section, int order) const {
  if (order == effort_order) return task_.effort ? task_.effort->range : Range{};
  return task_.limits[section][static_cast<std::size_t>(order)];
}

void SplineProgram::initial_samples() {
  samples_.clear();
  const std::size_t n = basis_.degree();
  for (std::size_t section = 0; section < task_.sections(); ++section)
    for (const int r : {0, 1, 2, 3, effort_order}) {
      if (task_.is_given(section)) break;
      const Range limit = limit_of(section, r);
      const bool peak = r > 0 && r < limited_orders && counted(r), limited = !limit.free() && !limit.fixed();
      if (!peak && !limited) continue;
      const auto order = static_cast<std::size_t>(r);
      const std::size_t degree = r == effort_order ? n : n > order ? n - order : 0;
      const std::size_t count = degree > 0 ? degree + 2 : 1;
      for (std::size_t piece = 0; piece < basis_.section(section).pieces(); ++piece)
        for (std::size_t k = 0; k < count; ++k) {
          const double share = count > 1 ? static_cast<double>(k) / static_cast<double>(count - 1) : 0.5;
          const double v = 0.5 - 0.5 * std::cos(std::numbers::pi * share);
          // Where pieces meet, one of them has the sample.
          if (k + 1 == count && piece + 1 < basis_.section(section).pieces() && degree > 0) continue;
          if (peak && !shared_begin({section, piece, v, r, false})) samples_.push_back({{section, piece, v, r, false}});
          if (limited && !pinned({section, piece, v, r, true})) samples_.push_back({{section, piece, v, r, true}});
        }
    }
}

/// Returns the Bernstein coefficients of s^(order), order ≤ 3, or of the effort on a piece of the current law.
std::vector<double> SplineProgram::derivative(std::size_t section, std::size_t piece, int order) const {
  if (order == effort_order) {
    std::vector<double> sum(basis_.degree() + 1, 0);
    for (int r = 0; r < 3; ++r) {
      std::vector<double> part = derivative(section, piece, r);
      while (part.size() < sum.size()) raise_degree(part);
      for (std::size_t k = 0; k < sum.size(); ++k)
        sum[k] += task_.effort->factor[static_cast<std::size_t>(r)] * part[k];
    }
    return sum;
  }
  const SectionBasis& basis = basis_.section(section);
  std::vector<double> c(point_.x.begin() + static_cast<std::ptrdiff_t>(basis_.first(section)),
                        point_.x.begin() + static_cast<std::ptrdiff_t>(basis_.first(section + 1)));
  for (std::size_t k = 0; k < c.size(); ++k) c[k] *= coefficient_of_variable(lengths_[section], k);
  std::vector<double> b(basis.degree() - static_cast<std::size_t>(order) + 1);
  basis.bernstein(piece, c.data(), static_cast<std::size_t>(order), b.data());
  const double power = std::pow(lengths_[section], -order);
  for (double& value : b) value *= power;
  return b;
}

void SplineProgram::evaluate(SplineResult& result, bool enclosed) {
  found_.clear();
  result.peaks = {};
  result.violation = 0;
  std::vector<Extremum> extrema;
  result.group_peaks.assign(task_.groups.count(), {});
  for (const Floor& floor : floors_) {
    double& peak = result.group_peaks[task_.groups.of_section[floor.section]][static_cast<std::size_t>(floor.order)];
    peak = std::max(peak, floor.peak);
  }
  for (std::size_t section = 0; section < task_.sections(); ++section)
    for (const int order : {0, 1, 2, 3, effort_order}) {
      if (task_.is_given(section)) break;
      const auto r = static_cast<std::size_t>(order);
      const Range limit = limit_of(section, order);
      const double unit = unit_of(order);
      const bool peak = order > 0 && order < limited_orders && counted(order);
      if (!peak && limit.free()) continue;
      double none = 0;
      double& largest = peak ? result.group_peaks[task_.groups.of_section[section]][r] : none;
      for (std::size_t piece = 0; piece < basis_.section(section).pieces(); ++piece) {
        const std::vector<double> b = derivative(section, piece, order);
        double highest = -std::numeric_limits<double>::infinity(), lowest = -highest;
        if (enclosed) {
          if (peak) largest = std::max(largest, greatest_magnitude(b).value);
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
          if (peak) largest = std::max({largest, highest, -lowest});
          const double last_peak =
              peak ? point_.x[band_.border_index(peak_border(section, order))] * peak_unit(section, order) : 0;
          for (const Extremum& each : extrema) {
            const LawSample peak_sample{section, piece, each.at, order, false};
            const LawSample limit_sample{section, piece, each.at, order, true};
            if (peak && std::abs(each.value) > near_peak * last_peak && !shared_begin(peak_sample))
              found_.push_back(peak_sample);
            if (limit.fixed()) continue;
            if ((each.value > limit.max - 1e-3 * unit || each.value < limit.min + 1e-3 * unit) &&
                !pinned(limit_sample)) {
              found_.push_back(limit_sample);
              // Near an end of the section each further extremum is nearer by half: samples are placed ahead of it.
              const bool begins = piece == 0 && each.at > 0 && each.at < 0.1;
              const bool ends = piece + 1 == basis_.section(section).pieces() && each.at < 1 && each.at > 0.9;
              for (const double share : {0.25, 0.0625})
                if (begins || ends)
                  found_.push_back({section, piece, begins ? share * each.at : 1 - share * (1 - each.at), order, true});
            }
          }
        }
        if (!limit.free())
          result.violation = std::max({result.violation, (highest - limit.max) / unit, (limit.min - lowest) / unit});
      }
    }
  result.limit_violation = result.violation;
  result.objective = 0;
  for (std::size_t g = 0; g < task_.groups.count(); ++g)
    for (std::size_t r = 1; r < limited_orders; ++r) {
      result.peaks[r] = std::max(result.peaks[r], result.group_peaks[g][r]);
      const double part = task_.groups.weight[g] * task_.weight[r] * result.group_peaks[g][r];
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
    const std::size_t pieces = basis_.section(sample.section).pieces();
    at = std::clamp(at, 0.0, static_cast<double>(pieces));
    sample.piece = std::min(static_cast<std::size_t>(at), pieces - 1);
    sample.v = at - static_cast<double>(sample.piece);
    found_.push_back(sample);
  };
  const double together = 0.5 / static_cast<double>(basis_.degree());
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
        // A contact consists of points of some weight beside each other, or nearer than contacts of this degree are.
        double mass = 0, moment = 0;
        const std::size_t from = k;
        std::size_t last = k;
        for (; k < end &&
               (k <= last + 1 || place(samples_[order[k]].sample) - place(samples_[order[last]].sample) < together);
             ++k) {
          const double z = samples_[order[k]].*side;
          if (z < significant * most) continue;
          mass += z;
          moment += z * place(samples_[order[k]].sample);
          last = k;
        }
        k = last + 1;
        if (last == from) continue;
        const LawSample& first = samples_[order[from]].sample;
        const double width = place(samples_[order[last]].sample) - place(first), centre = moment / mass;
        if (width < 1e-5) continue;
        for (const double share : {-0.05, 0.0, 0.05}) add(first, centre + share * width);
      }
    }
    begin = end;
  }
  // Peaks far from any contact have done their part. Limits stay: where nothing else holds a law it would leave them
  // again.
  std::size_t kept = initial_;
  for (std::size_t i = initial_; i < samples_.size(); ++i)
    if (samples_[i].sample.limit || samples_[i].slack < 0.3) samples_[kept++] = samples_[i];
  samples_.resize(kept);
  for (const LawSample& sample : found_) {
    const bool known = std::any_of(samples_.begin(), samples_.end(), [&](const Sampled& other) {
      return group(other.sample) == group(sample) && std::abs(place(other.sample) - place(sample)) < 1e-6;
    });
    if (!known) samples_.push_back({sample});
  }
}

}  // namespace bahnwerk::cam
