#pragma once
/// The true continuous maximum of |f| over an interval, for several functions that share their evaluations.
///
/// Each interval is sampled at Chebyshev points; the interpolant's Chebyshev tail tells whether it is resolved, its
/// Bernstein coefficients bound it from outside (Farouki, "The Bernstein polynomial basis: a centennial retrospective",
/// CAGD 29, 2012), and only where that bound passes the highest value so far is the maximum located through the roots
/// of the derivative. An interval that is not resolved is halved.
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace bahnwerk {

/// Interpolation points on [0,1], rising, with the maps from samples to coefficients.
struct ChebyshevRule {
  static constexpr int max_points = 9;
  int points = 0;  ///< degree + 1
  std::array<double, max_points> node{};
  std::array<std::array<double, max_points>, max_points> chebyshev{};  ///< [row = coefficient][column = sample]
  std::array<std::array<double, max_points>, max_points> bernstein{};
  std::array<std::array<double, max_points>, max_points>
      integral{};                          ///< row i: weights of ∫ from 0 to node i; see `whole`
  std::array<double, max_points> whole{};  ///< weights of ∫ from 0 to 1
};
/// Chebyshev–Lobatto points, ends included: 5 or 9 of them.
const ChebyshevRule& lobatto_rule(bool fine);
/// 9 points without the ends, for functions that cannot be evaluated there.
const ChebyshevRule& open_rule();

struct PolynomialPeak {
  double value = 0;  ///< max |p| over [0,1]
  double at = 0;     ///< where, in [0,1]
};
/// Largest |p| of a polynomial in Bernstein form (n ≤ 9 coefficients, overwritten), to 1e-13 relative. Returns at least
/// `floor`, with at = −1, when nothing exceeds it. Cost: ≈ 30 ns when the coefficients do not pass `floor`, else ≈ 200
/// ns.
PolynomialPeak polynomial_peak(double* coefficients, int n, double floor);

/// The highest |value| of one function so far.
struct Peak {
  double value = 0;
  double at = 0;        ///< argument of the peak, in the variable of the sweep that found it
  std::size_t tag = 0;  ///< the caller's number of that sweep
  bool finite = true;   ///< false once any sample was NaN or infinite
};

/// Running peaks of several functions over many intervals. `scale` of a function is the magnitude that counts (its
/// limit): values are resolved to 2e-11 of it (or of the function itself if that is larger); where halving does not get
/// there, the outer bound counts.
class PeakSweep {
 public:
  explicit PeakSweep(std::vector<double> scales);

  std::size_t channels() const { return peaks_.size(); }
  const Peak& operator[](std::size_t channel) const { return peaks_[channel]; }
  std::size_t evaluations() const { return evaluations_; }

  /// A value known exactly. O(1).
  void raise(std::size_t channel, double value, double at, std::size_t tag);

  /// Sweeps [a, b]. `sample(rule, begin, end, values)` writes channel c at rule.node[i] of [begin, end] to values[c ·
  /// points + i] and returns false when it knows itself unresolved there. `open`: never evaluate at the ends of a
  /// sampled interval.
  template <class Sample>
  void sweep(double a, double b, bool open, std::size_t tag, Sample&& sample) {
    struct Interval {
      double begin, end;
      int depth;
    };
    std::array<Interval, 2 * max_depth + 2> stack;
    std::size_t top = 0;
    stack[top++] = {a, b, 0};
    std::size_t allowance = budget_ / 2 + 128;  // one function gone wild must not use up what the others need
    budget_ -= budget_ / 2;
    while (top > 0) {
      const Interval now = stack[--top];
      if (now.depth > 0 && allowance > 0) --allowance;
      const Patience patience = now.depth >= max_depth || allowance == 0 ? Patience::none
                                : now.depth >= noisy_depth               ? Patience::some
                                                                         : Patience::full;
      bool done = false;
      if (!open && now.depth == 0) {
        const ChebyshevRule& rule = lobatto_rule(false);
        const bool resolved = sample(rule, now.begin, now.end, values_.data());
        done = absorb(rule, now.begin, now.end, tag, resolved, Patience::full);
      }
      if (!done) {
        const ChebyshevRule& rule = open ? open_rule() : lobatto_rule(true);
        const bool resolved = sample(rule, now.begin, now.end, values_.data());
        done = absorb(rule, now.begin, now.end, tag, resolved, patience);
      }
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
  /// full: halve what is not resolved. some: take noise below 5e-11 for what it is. none: take the outer bound.
  enum class Patience { full, some, none };
  /// Takes the samples in; true when the interval needs no halving.
  bool absorb(const ChebyshevRule& rule, double begin, double end, std::size_t tag, bool resolved, Patience patience);

  std::vector<Peak> peaks_;
  std::vector<double> scales_;
  std::vector<double> values_;
  std::size_t evaluations_ = 0;
  std::size_t budget_ =
      budget_cap;  // halvings still allowed over all sweeps: noise must not cost more than linear time
};

}  // namespace bahnwerk
