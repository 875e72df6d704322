#pragma once
/// The true continuous maximum of |f| over an interval, for several functions that share their evaluations.
///
/// Each interval is sampled at Chebyshev points. The interpolant's Bernstein coefficients bound it from outside
/// (Farouki, "The Bernstein polynomial basis: a centennial retrospective", CAGD 29, 2012); only where that bound
/// exceeds the highest value so far is the maximum located through the roots of the derivative. The caller proves a
/// bound of the function's distance from the interpolant (`PeakSamples::missing`, interpolation_error()). It is added,
/// so the peak is an enclosure, never below the truth but for rounding of the samples. An interval where that bound is
/// above the resolution and could matter is halved. Without a bound the decay of the Chebyshev coefficients is used: an
/// estimate, which content that aliases on the points can defeat.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace bahnwerk {

/// Interpolation points on [0,1], ascending, with the maps from samples to coefficients.
struct ChebyshevRule {
  static constexpr int max_points = 13;
  int points = 0;  ///< degree + 1
  std::array<double, max_points> node{};
  std::array<std::array<double, max_points>, max_points> chebyshev{};  ///< [row = coefficient][column = sample]
  std::array<std::array<double, max_points>, max_points> bernstein{};
  std::array<std::array<double, max_points>, max_points>
      integral{};                          ///< row i: weights of ∫ from 0 to node i; see `whole`
  std::array<double, max_points> whole{};  ///< weights of ∫ from 0 to 1
  double rounding = 0;                     ///< rounding error of Bernstein coefficients, relative to the largest sample
};
/// Returns the Chebyshev–Lobatto points, ends included: 5, 9 or 13 of them.
const ChebyshevRule& lobatto_rule(int points);
/// Returns 9 points without the ends, for functions that cannot be evaluated there.
const ChebyshevRule& open_rule();

inline constexpr int max_coefficients =
    22;  ///< largest number of coefficients of a polynomial whose peak is searched: degree 21

/// The largest magnitude of a polynomial.
struct PolynomialPeak {
  double value = 0;  ///< max |p| over [0,1]
  double at = 0;     ///< place of the maximum, in [0, 1]
};
/// Returns the largest |p| of a polynomial in Bernstein form (n ≤ max_coefficients, overwritten), to 1e-13 relative, or
/// `floor` with at = −1 when nothing exceeds it. Cost: ≈ 30 ns when the coefficients do not exceed `floor`, else ≈ 200
/// ns.
PolynomialPeak polynomial_peak(double* coefficients, int n, double floor);

/// The largest |value| of a function so far.
struct Peak {
  double value = 0;
  double at = 0;        ///< argument of the peak, in the variable of the sweep that found it
  std::size_t tag = 0;  ///< the caller's number of that sweep
  bool finite = true;   ///< whether all samples were finite
};

/// Returns a bound of the distance of the interpolant in Chebyshev points (with or without the ends) from a function
/// that is analytic with |f| ≤ 1 within `reach` half widths of the middle of its interval: 4 ρ⁻ⁿ/(ρ − 1), n = points −
/// 1, where the ellipse with foci ±1 and semi-axis sum ρ just fits that disc [Trefethen, Approximation Theory and
/// Approximation Practice, 2013, theorem 8.2]. Infinite for reach ≤ 1.
double interpolation_error(int points, double reach);

/// Samples of a function over an interval.
struct PeakSamples {
  const ChebyshevRule& rule;
  double begin, end;
  bool last;        ///< whether the interval will not be halved any more
  bool more;        ///< whether more points follow if these do not suffice
  double* values;   ///< output: channel c at rule.node[i] of [begin, end] at values[c · rule.points + i]
  double* missing;  ///< output: for each channel a proven bound of |f − interpolant|; NaN, its initial value: unknown
  bool empty = false;  ///< output: whether nothing was written because the bound is useless; not when `last`
  double at(int i) const { return begin + rule.node[static_cast<std::size_t>(i)] * (end - begin); }
};

/// Running peaks of several functions over many intervals. `scale` of a function is its reference magnitude (its
/// limit): values are resolved to twice `resolution` of it (or of the function itself if that is larger); where halving
/// does not achieve that, the outer bound and the missing part count. `rounding` times its magnitude is the error of a
/// sample; it is added to the missing part where that is known.
class PeakSweep {
 public:
  explicit PeakSweep(std::vector<double> scales, double resolution = 1e-11, double rounding = 0);

  std::size_t channels() const { return peaks_.size(); }
  const Peak& operator[](std::size_t channel) const { return peaks_[channel]; }
  double scale(std::size_t channel) const { return scales_[channel]; }
  std::size_t evaluations() const { return evaluations_; }

  /// Continues as if the peak had been `value`, and returns the previous one: smaller values are not searched. O(1).
  Peak restart(std::size_t channel, double value) { return std::exchange(peaks_[channel], Peak{value, 0, 0, true}); }
  /// Raises the peak to an exactly known value. O(1).
  void raise(std::size_t channel, double value, double at, std::size_t tag);

  /// Returns whether these samples may settle an interval, by the missing part and by the distance of the previous
  /// samples from the peaks, since neighbours are similar. A caller of this function is offered 5 points on every
  /// interval, and after 9 points 13 before it is halved. O(channels).
  bool promising(const double* missing) {
    asked_ = true;
    for (std::size_t c = 0; c < peaks_.size(); ++c)
      if (!(missing[c] <= std::max(room_[c], resolution_ * scales_[c]))) return false;
    return true;
  }

  /// Returns the number of sampled intervals decided by an estimate: no bound was known, or halving ended before one
  /// was finite.
  std::size_t estimated() const { return estimated_; }

  /// Sweeps [a, b]. `sample(PeakSamples&)` fills values and missing, and returns false if it knows that it is
  /// unresolved there. `open` avoids the ends of a sampled interval.
  template <class Sample>
  void sweep(double a, double b, bool open, std::size_t tag, Sample&& sample) {
    struct Interval {
      double begin, end;
      int depth;
    };
    std::array<Interval, 2 * max_depth + 2> stack;
    std::size_t top = 0;
    stack[top++] = {a, b, 0};
    std::size_t allowance =
        budget_ / 2 + 128;  // evaluations allowed here, so that one irregular function leaves some to the others
    budget_ -= budget_ / 2;
    while (top > 0) {
      const Interval now = stack[--top];
      if (now.depth > 0 && allowance > 0) --allowance;
      const Patience patience = now.depth >= max_depth || allowance == 0 ? Patience::none
                                : now.depth >= noisy_depth               ? Patience::some
                                                                         : Patience::full;
      bool done = false;
      const auto attempt = [&](const ChebyshevRule& rule, Patience limit, bool more) {
        std::fill(missing_.begin(), missing_.end(), std::numeric_limits<double>::quiet_NaN());
        PeakSamples samples{rule, now.begin, now.end, limit == Patience::none, more, values_.data(), missing_.data()};
        const bool resolved = sample(samples);
        return !samples.empty && absorb(rule, now.begin, now.end, tag, resolved, limit);
      };
      if (!open && now.depth == 0 && coarse_may_do())
        coarse_done(done = attempt(lobatto_rule(5), Patience::full, true));
      const bool more = !open && asked_ && patience == Patience::full;
      if (!done) done = attempt(open ? open_rule() : lobatto_rule(9), patience, more);
      if (!done && more) done = attempt(lobatto_rule(13), patience, false);
      const double middle = now.begin + (now.end - now.begin) / 2;
      if (done || !(middle > now.begin && middle < now.end)) continue;
      stack[top++] = {middle, now.end, now.depth + 1};
      stack[top++] = {now.begin, middle, now.depth + 1};
    }
    budget_ += std::min(allowance, budget_cap - budget_);
  }

 private:
  static constexpr int max_depth = 40, noisy_depth = 12;
  static constexpr std::size_t budget_cap = 100000;
  /// full: halve what is not resolved. some: accept noise below 5e-11. none: take the outer bound.
  enum class Patience { full, some, none };
  /// Evaluates the samples; returns true when the interval needs no halving.
  bool absorb(const ChebyshevRule& rule, double begin, double end, std::size_t tag, bool resolved, Patience patience);

  // Neighbours are similar: where five points did not suffice, they are tried again every fourth time.
  bool coarse_may_do() { return missing_.empty() || asked_ || coarse_failed_ == 0 || --coarse_failed_ == 0; }
  void coarse_done(bool done) { coarse_failed_ = done || missing_.empty() || std::isnan(missing_.front()) ? 0 : 4; }

  std::vector<Peak> peaks_;
  std::vector<double> scales_;
  double resolution_, rounding_;
  std::vector<double> values_, missing_;
  std::vector<double> room_;  // distance of the previous samples below the peaks
  bool asked_ = false;        // whether promising() was called
  int coarse_failed_ = 0;
  std::size_t estimated_ = 0;
  std::size_t evaluations_ = 0;
  std::size_t budget_ = budget_cap;  // halvings still allowed over all sweeps, so that noise costs linear time
};

}  // namespace bahnwerk
