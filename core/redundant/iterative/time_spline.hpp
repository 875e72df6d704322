#pragma once
/// One axis over time as consecutive polynomials: the form that a coarse axis' spline has for evaluation.
#include <array>
#include <cstddef>
#include <vector>

namespace bahnwerk {

inline constexpr std::size_t max_spline_degree = 5;

/// State of an axis: position mm, velocity mm/s, acceleration mm/s², jerk mm/s³.
struct AxisState {
  double x = 0, v = 0, a = 0, j = 0;
};

class TimeSpline {
 public:
  using Coefficients = std::array<double, max_spline_degree + 1>;  ///< by powers of t − begin, lowest first

  std::size_t pieces() const { return pieces_.size(); }
  double begin(std::size_t i) const { return pieces_[i].begin; }
  double end(std::size_t i) const { return i + 1 < pieces_.size() ? pieces_[i + 1].begin : end_; }
  double duration() const { return end_; }
  const Coefficients& coefficients(std::size_t i) const { return pieces_[i].coefficients; }

  /// Appends a piece that reaches from the current end to `end`, s.
  void append(double end, const Coefficients& coefficients) {
    pieces_.push_back({end_, coefficients});
    end_ = end;
  }
  /// Returns the piece that holds t, searched from `hint` on; at a border the later one.
  std::size_t find(double t, std::size_t hint) const {
    std::size_t i = hint < pieces_.size() && pieces_[hint].begin <= t ? hint : 0;
    while (i + 1 < pieces_.size() && pieces_[i + 1].begin <= t) ++i;
    return i;
  }
  /// Returns the state by the polynomial of piece i at time t, s.
  AxisState in_piece(std::size_t i, double t) const;
  /// Returns the coefficients of piece i by powers of (time − t).
  Coefficients from(std::size_t i, double t) const;
  /// Appends the motion of `other` from 0 to `until`, s, shifted to the current end; the new end is `end`, which equals
  /// their sum up to rounding.
  void append(const TimeSpline& other, double until, double end);
  /// Scales time so that the motion lasts `factor` times as long. O(pieces).
  void slow(double factor);

 private:
  struct Piece {
    double begin;
    Coefficients coefficients;
  };
  std::vector<Piece> pieces_;
  double end_ = 0;
};

}  // namespace bahnwerk
