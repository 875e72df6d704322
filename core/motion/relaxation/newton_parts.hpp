#pragma once
/// Step lengths of a Newton step for each place of a relaxation (core/numeric/gradual.hpp).
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/numeric/gradual.hpp"
#include "core/numeric/lanes.hpp"

namespace bahnwerk {

/// The step lengths of primal and dual variables at each place.
class NewtonParts {
 public:
  using Both = Lanes<2>;  ///< primal, dual

  /// Starts a step without any restriction. `even` gives all places one step length.
  void begin(std::size_t places, bool even) {
    even_ = even;
    mean_ = Both{};
    part_.assign(places, Both{});
  }
  /// Restricts the step at a place at which slacks, and multipliers, change by at most −`reach` of themselves; with
  /// `even` the place does not matter.
  void stop(std::size_t place, Both reach) { part_[place] = larger(part_[place], reach); }
  /// Chooses the predictor's step lengths, the largest that keep slacks and multipliers positive. O(places).
  void predicted() {
    const Both one{1, 1};
    if (even_) {
      fit_even(1);
      return product_.assign(part_.size(), std::sqrt(mean_[0] * mean_[1]));
    }
    product_.resize(part_.size());
    Both sum{};
    for (std::size_t i = 0; i < part_.size(); ++i) {
      const Both p = 1.0 / larger(part_[i], one);
      sum = sum + p, product_[i] = std::sqrt(p[0] * p[1]);
    }
    mean_ = sum / static_cast<double>(part_.size());
  }
  /// Chooses the step lengths: `most` of what keeps them positive, and not much more than at the neighbours. A value
  /// that is not a number is propagated to mean(). O(places).
  void taken(double most) {
    if (even_) return fit_even(most);
    Both last{1, 1}, sum{};
    for (Both& p : part_) p = last = smaller(next_part(last), most / larger(Both{most, most}, p));
    last = Both{1, 1};
    for (std::size_t i = part_.size(); i-- > 0;) sum = sum + (last = part_[i] = smaller(next_part(last), part_[i]));
    mean_ = sum / static_cast<double>(part_.size());
  }

  double primal(std::size_t place) const { return part_[place][0]; }
  double dual(std::size_t place) const { return part_[place][1]; }
  Both mean() const { return mean_; }
  /// Returns the weight of the product of both steps of the predictor at a place.
  double of_product(std::size_t place) const { return product_[place]; }

 private:
  void fit_even(double most) {
    Both farthest{most, most}, sum{};
    for (const Both& p : part_) farthest = larger(farthest, p), sum = sum + p;
    mean_ = most / farthest + 0.0 * sum;
    part_.assign(part_.size(), mean_);
  }

  bool even_ = false;
  std::vector<Both> part_;
  std::vector<double> product_;
  Both mean_{};
};

}  // namespace bahnwerk
