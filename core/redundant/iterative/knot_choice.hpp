#pragma once
/// Which knots a coarse axis' spline has: chosen from the largest sensible ones, T_max, where the approximation is
/// worst [Bock 4.2.3, 4.3.1].
#include <cstddef>
#include <vector>

namespace bahnwerk {

/// Places for inner knots, evenly spaced over [0, duration]; each, if chosen, counts `multiplicity` times.
class KnotChoice {
 public:
  /// `places` ≥ 0 inner ones. `wide` is K*: gaps of more places are always divided themselves, unless there is a
  /// `grading` > 0: gaps with a neighbour more than so many times as long are not, that neighbour is in their place.
  /// Next to a long gap splines swing in a short one.
  KnotChoice(double duration, std::size_t places, std::size_t degree, std::size_t multiplicity, std::size_t wide,
             double grading = 0);
  /// As many as interpolating `samples` values takes (4.11), but never more than that: knots beyond would leave the
  /// approximation undetermined.
  static std::size_t interpolating(std::size_t samples, std::size_t degree, std::size_t multiplicity);

  std::size_t places() const { return places_; }
  std::size_t chosen() const { return chosen_.size() - 2; }
  bool full() const { return chosen() == places_; }
  std::vector<double> knots() const;

  /// Chooses one more place because of the error at time t. False: there is none left.
  bool insert(double t);
  /// One more in the middle of the widest gap.
  bool insert_in_widest();
  /// One at each of several times, the most important first. Those that would fall closer than `apart` chosen knots to
  /// one that was inserted before are left out, because that one may have helped there, too. Returns how many.
  std::size_t insert_apart(const std::vector<double>& times, std::size_t apart);
  /// The places nearest to `times`, ascending, in addition.
  void choose_nearest(const std::vector<double>& times);
  /// Even choice of `count` places, at most all; replaces what was chosen (4.39).
  void choose_evenly(std::size_t count);

 private:
  std::size_t place_at(double t) const;
  /// The place to choose, 0 = none. (4.37), (4.38) and the cases around them.
  std::size_t choice(double t) const;
  std::size_t graded(std::size_t i) const;  ///< the gap to divide in place of gap i
  void add(std::size_t place);
  std::size_t gap(std::size_t i) const { return chosen_[i + 1] - chosen_[i] - 1; }  ///< places behind chosen i
  std::size_t middle(std::size_t i) const { return (chosen_[i] + chosen_[i + 1]) / 2; }

  double duration_;
  std::size_t places_, degree_, multiplicity_, wide_;
  double grading_;
  std::vector<std::size_t> chosen_;  ///< ascending, with both ends 0 and places + 1
};

}  // namespace bahnwerk
