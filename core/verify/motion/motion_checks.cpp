#include "core/verify/motion/motion_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/base/progress_scope.hpp"
#include "core/numeric/peak.hpp"
#include "core/verify/motion/bernstein.hpp"
#include "core/verify/rounding.hpp"
#include "core/verify/worst.hpp"

namespace bahnwerk {
namespace verify {
namespace {

constexpr std::size_t derivatives = 4;  // velocity, acceleration, jerk, snap

double limit(const AxisLimits& axis, std::size_t derivative) { return axis.of(static_cast<int>(derivative)); }

/// Σ |x⁽ᵈ⁺ⁱ⁾| Tⁱ/i!: what the d-th derivative is summed up from within a piece, and hence what its rounding follows.
double terms(const MotionState& x, std::size_t derivative, std::size_t axis, double duration) {
  double sum = 0, factor = 1;
  for (std::size_t i = 0; derivative + i <= derivatives; ++i) {
    sum += factor * std::abs(x[derivative + i][axis]);
    factor *= duration / static_cast<double>(i + 1);
  }
  return sum;
}

class Checker {
 public:
  explicit Checker(const MotionToVerify& in) : in_(in), sweep_(scales(in)), range_(in.axes.size()) {
    for (auto& peaks : peaks_) peaks.resize(in.axes.size());
  }

  std::vector<Check> run(ProgressScope& stage_progress) {
    const Motion& motion = in_.motion;
    for (std::size_t i = 0; i < motion.pieces(); ++i) {
      stage_progress.now(i, motion.pieces());
      piece(i);
      if (i > 0) joint(i);
    }
    if (in_.rests_at_begin) rest(start_, motion.in_piece(0, 0), motion.end(0), 0);
    const std::size_t last = motion.pieces() - 1;
    if (in_.rests_at_end)
      rest(end_, motion.in_piece(last, motion.duration()), motion.duration() - motion.begin(last), motion.duration());
    return report();
  }

 private:
  static std::vector<double> scales(const MotionToVerify& in) {
    std::vector<double> list;
    for (std::size_t d = 1; d <= derivatives; ++d)
      for (const AxisLimits& axis : in.axes) list.push_back(std::isfinite(limit(axis, d)) ? limit(axis, d) : 1);
    return list;
  }

  void piece(std::size_t i) {
    const double t0 = in_.motion.begin(i), T = in_.motion.end(i) - t0;
    bool sampled = false;
    for (std::size_t k = 0; k < in_.axes.size(); ++k) {
      Polynomial p;
      if (!in_.motion.polynomial(i, k, p)) {
        sampled = true;
        continue;
      }
      reach(k, p, t0, T);
      for (std::size_t d = 1; d <= derivatives; ++d) {
        p = derivative(p);
        Bernstein b{};
        const std::size_t n = bernstein(p, T, 0, b);
        Worst& peak = peaks_[d - 1][k];
        if (!std::all_of(b.begin(), b.begin() + static_cast<std::ptrdiff_t>(n),
                         [](double x) { return std::isfinite(x); })) {
          peak.raise(std::nan(""), t0);
          continue;
        }
        const PolynomialPeak found = polynomial_peak(b.data(), static_cast<int>(n), peak.value);
        if (found.at >= 0) peak.raise(found.value, t0 + found.at * T);
      }
    }
    if (sampled) sample(i, t0, T);
  }

  /// Records how far positions lie outside the range: the part of |x − middle| beyond half of it.
  void reach(std::size_t k, const Polynomial& p, double t0, double T) {
    const AxisLimits& axis = in_.axes[k];
    for (const double sign : {1.0, -1.0}) {
      const double border = sign > 0 ? axis.highest : axis.lowest;
      if (!std::isfinite(border)) continue;
      // The excess of a polynomial over a border is its largest magnitude about a far place, far enough for the other
      // side not to count.
      Bernstein b{};
      const std::size_t n = bernstein(p, T, -border, b);
      double most = 0;
      for (std::size_t j = 0; j < n; ++j) most = std::isnan(b[j]) ? b[j] : std::max(most, std::abs(b[j]));
      for (std::size_t j = 0; j < n; ++j) b[j] = sign * b[j] + most;
      const PolynomialPeak found = polynomial_peak(b.data(), static_cast<int>(n), most);
      const double beyond = std::isnan(most) ? most : found.at >= 0 ? found.value - most : 0;
      range_[k].raise(beyond, rounding * (std::abs(border) + most), t0 + std::max(found.at, 0.0) * T);
    }
  }

  void sample(std::size_t i, double t0, double T) {
    sweep_.sweep(t0, t0 + T, false, i, [&](PeakSamples& samples) {
      const auto points = static_cast<std::size_t>(samples.rule.points), axes = in_.axes.size();
      for (std::size_t n = 0; n < points; ++n) {
        const double t = samples.at(static_cast<int>(n));
        const MotionState x = in_.motion.in_piece(i, t);
        for (std::size_t k = 0; k < axes; ++k) {
          for (std::size_t d = 1; d <= derivatives; ++d) samples.values[((d - 1) * axes + k) * points + n] = x[d][k];
          const AxisLimits& axis = in_.axes[k];
          const double beyond = std::max({0.0, x[0][k] - axis.highest, axis.lowest - x[0][k]});
          range_[k].raise(std::isnan(x[0][k]) ? x[0][k] : beyond, rounding * std::abs(x[0][k]), t);
        }
      }
      return true;
    });
  }

  double tolerance(const MotionState& x, std::size_t derivative, std::size_t axis, double T, double t) const {
    const double next = derivative < derivatives ? std::abs(x[derivative + 1][axis]) : 0;
    return rounding * terms(x, derivative, axis, T) + next * (epsilon * t + in_.resolution);
  }

  void joint(std::size_t i) {
    const Motion& motion = in_.motion;
    const double t = motion.begin(i), before = t - motion.begin(i - 1), after = motion.end(i) - t;
    const MotionState left = motion.in_piece(i - 1, t), right = motion.in_piece(i, t);
    // A piece is evaluated from its begin: an axis that comes to rest has the rounding of the states it had there.
    const MotionState begin = motion.in_piece(i - 1, motion.begin(i - 1));
    for (std::size_t d = 0; d <= static_cast<std::size_t>(in_.continuous); ++d)
      for (std::size_t k = 0; k < in_.axes.size(); ++k)
        gaps_[d].raise(std::abs(right[d][k] - left[d][k]),
                       std::max(rounded(i - 1, left, d, k, before, t), rounded(i - 1, begin, d, k, before, t)) +
                           rounded(i, right, d, k, after, t) + (in_.step ? in_.step(k, d, t) : 0),
                       t);
  }

  /// An axis that is no polynomial is a component of a motion along a curve, and rounded as the largest of them is.
  double rounded(std::size_t piece, const MotionState& x, std::size_t d, std::size_t axis, double T, double t) const {
    Polynomial p;
    if (in_.motion.polynomial(piece, axis, p)) return tolerance(x, d, axis, T, t);
    double most = 0;
    for (std::size_t k = 0; k < in_.axes.size(); ++k) most = std::max(most, tolerance(x, d, k, T, t));
    return most;
  }

  void rest(Strained& check, const MotionState& x, double T, double t) const {
    for (std::size_t d = 1; d <= static_cast<std::size_t>(std::max(in_.continuous, 1)); ++d)
      for (std::size_t k = 0; k < in_.axes.size(); ++k)
        check.raise(std::abs(x[d][k]), tolerance_at_rest(x, d, k, T, t), t);
  }
  /// A state at rest has nothing of its own to round but what the piece came from.
  double tolerance_at_rest(const MotionState& x, std::size_t d, std::size_t k, double T, double t) const {
    const std::size_t piece = t > 0 ? in_.motion.pieces() - 1 : 0;
    const MotionState other = in_.motion.in_piece(piece, t > 0 ? in_.motion.begin(piece) : in_.motion.end(piece));
    return tolerance(x, d, k, T, t) + tolerance(other, d, k, T, t);
  }

  /// Returns a check of all axes together.
  Checked whole(const Quantity& quantity, int order) const { return {quantity, order, in_.unit, in_.group}; }

  std::vector<Check> report() const {
    std::vector<Check> list;
    const std::size_t axes = in_.axes.size();
    for (std::size_t k = 0; k < axes; ++k) {
      const AxisLimits& axis = in_.axes[k];
      if (axis.has_range()) list.push_back(make_check({quantity::axis, 0, axis.unit, axis.name}, range_[k]));
      for (std::size_t d = 1; d <= derivatives; ++d) {
        if (!std::isfinite(limit(axis, d))) continue;
        Worst worst = peaks_[d - 1][k];
        const Peak& sampled = sweep_[(d - 1) * axes + k];
        worst.raise(sampled.finite ? sampled.value : std::nan(""), sampled.at);
        if (static_cast<int>(d) > in_.motion.highest_order()) worst.value = std::nan("");
        list.push_back(make_check({quantity::axis, static_cast<int>(d), axis.unit, axis.name}, limit(axis, d), worst));
      }
    }
    for (std::size_t d = 0; d <= static_cast<std::size_t>(in_.continuous); ++d)
      list.push_back(make_check(whole(quantity::continuity, static_cast<int>(d)), gaps_[d]));
    if (in_.rests_at_begin) list.push_back(make_check(whole(quantity::start_rest, 1), start_));
    if (in_.rests_at_end) list.push_back(make_check(whole(quantity::end_rest, 1), end_));
    return list;
  }

  const MotionToVerify& in_;
  std::array<std::vector<Worst>, derivatives> peaks_;  // peaks of polynomials by derivative and axis
  PeakSweep sweep_;                                    // peaks of all other functions
  std::vector<Strained> range_;
  std::array<Strained, 4> gaps_;
  Strained start_, end_;
};

}  // namespace
}  // namespace verify

std::vector<Check> motion_checks(const MotionToVerify& input, Progress progress) {
  if (input.motion.axes() != input.axes.size())
    throw std::invalid_argument("a motion is verified against the limits of as many axes as it has");
  if (input.continuous < 0 || input.continuous > 3)
    throw std::invalid_argument("pieces are compared up to their third derivative");
  ProgressScope stage_progress(progress, "verify");
  stage_progress.report();
  return verify::Checker(input).run(stage_progress);
}

}  // namespace bahnwerk
