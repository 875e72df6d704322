#pragma once
/// Choice of the knots of a coarse axis' spline: from the finest sensible knots, T_max, those are chosen where the
/// approximation is worst [Bock 4.2.3, 4.3.1].
#include <cstddef>
#include <vector>

namespace bahnwerk {

/// Evenly spaced places for inner knots over [0, duration], s; a chosen place has `multiplicity` equal knots.
class KnotChoice {
 public:
  /// There are `places` ≥ 0 inner places. `wide` is K*: a gap of more places is divided itself. With `grading` > 0, a
  /// gap whose neighbour is more than `grading` times as long is not divided; the neighbour is divided instead, because
  /// splines oscillate in a short gap beside a long one.
  KnotChoice(double duration, std::size_t places, std::size_t degree, std::size_t multiplicity, std::size_t wide,
             double grading = 0);
  /// Returns the number of places with which the spline interpolates `samples` values (4.11), at most; more would make
  /// the approximation singular.
  static std::size_t interpolating(std::size_t samples, std::size_t degree, std::size_t multiplicity);

  std::size_t places() const { return places_; }
  std::size_t chosen() const { return chosen_.size() - 2; }
  bool full() const { return chosen() == places_; }
  std::vector<double> knots() const;

  /// Chooses one more place because of the error at time t, s. Returns false if none is left.
  bool insert(double t);
  /// Chooses one more place in the middle of the widest gap. Returns false if none is left.
  bool insert_in_widest();
  /// Chooses one place at each of `times`, s, the most important first. A place closer than `apart` chosen knots to one
  /// inserted by this call is left out, because that knot may have helped there as well. Returns the number of new
  /// places.
  std::size_t insert_apart(const std::vector<double>& times, std::size_t apart);
  /// Chooses the places nearest to `times`, s, ascending, in addition.
  void choose_nearest(const std::vector<double>& times);
  /// Replaces the choice by `count` evenly distributed places, at most all (4.39).
  void choose_evenly(std::size_t count);

 private:
  std::size_t place_at(double t) const;
  /// Returns the place to choose because of an error at t by (4.37), (4.38) and their special cases; 0: none.
  std::size_t choice(double t) const;
  std::size_t graded(std::size_t i) const;  ///< the gap to divide instead of gap i, see `grading`
  void add(std::size_t place);
  std::size_t gap(std::size_t i) const { return chosen_[i + 1] - chosen_[i] - 1; }  ///< places behind chosen i
  std::size_t middle(std::size_t i) const { return (chosen_[i] + chosen_[i + 1]) / 2; }

  double duration_;
  std::size_t places_, degree_, multiplicity_, wide_;
  double grading_;
  std::vector<std::size_t> chosen_;  ///< ascending, with both ends 0 and places + 1
};

}  // namespace bahnwerk
