#pragma once
/// N axes over time, in pieces. Setpoints, verifier and drawings take any motion: an axis path driven by a time law, a
/// spline in time, a sum of two motions.
#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "core/machine/axis_jet.hpp"
#include "core/numeric/polynomial.hpp"

namespace bahnwerk {

/// Position and derivatives of every axis by time: state[order][axis], of order 0 to 4 (snap), in unit/s^order.
class MotionState {
 public:
  static constexpr std::size_t orders = 5;
  AxisArray& operator[](std::size_t order) { return values_[order]; }
  const AxisArray& operator[](std::size_t order) const { return values_[order]; }

 private:
  std::array<AxisArray, orders> values_{};
};

/// Immutable and thread-safe. Inside a piece every axis is smooth; where pieces meet, derivatives may jump.
class Motion {
 public:
  virtual ~Motion() = default;
  virtual std::size_t axes() const = 0;               ///< 1 … max_axes
  virtual std::size_t pieces() const = 0;             ///< number of pieces, at least 1
  virtual double begin(std::size_t piece) const = 0;  ///< time at which a piece begins, s; 0 for the first, ascending
  virtual double duration() const = 0;                ///< s; the last piece ends there
  /// Returns the state at t inside piece `piece`; at its ends the one-sided limits.
  virtual MotionState in_piece(std::size_t piece, double t) const = 0;
  /// Returns the state in which the motion ends: the last piece's at its end, unless the motion knows it without
  /// rounding.
  virtual MotionState final_state() const { return in_piece(pieces() - 1, duration()); }
  /// Returns the highest order of the state that is computed, 3 or 4; what is above is 0.
  virtual int highest_order() const { return 3; }
  /// Writes the position of an axis in a piece as a polynomial of t − begin(piece), lowest coefficient first, if it is
  /// one; then its peaks can be enclosed. Returns false, and leaves `out` unchanged, if it is none.
  virtual bool polynomial(std::size_t /*piece*/, std::size_t /*axis*/, Polynomial& /*out*/) const { return false; }

  double end(std::size_t piece) const { return piece + 1 < pieces() ? begin(piece + 1) : duration(); }
  /// Returns the state just after t ∈ [0, duration()]: right limits. `piece` is a hint and is updated. O(log pieces),
  /// O(1) with a good hint.
  MotionState evaluate(double t, std::size_t& piece) const;
  MotionState evaluate(double t) const {
    std::size_t piece = 0;
    return evaluate(t, piece);
  }
};

/// Coarse + fine = tool: the sum of two motions with equally many axes and equal durations. Its pieces end where a
/// piece of either summand ends.
class SumOfMotions final : public Motion {
 public:
  /// Throws std::invalid_argument if the numbers of axes differ, or the durations by more than rounding.
  SumOfMotions(std::shared_ptr<const Motion> first, std::shared_ptr<const Motion> second);
  std::size_t axes() const override { return first_->axes(); }
  std::size_t pieces() const override { return begin_.size(); }
  double begin(std::size_t piece) const override { return begin_[piece].t; }
  double duration() const override { return first_->duration(); }
  MotionState in_piece(std::size_t piece, double t) const override;
  int highest_order() const override { return std::min(first_->highest_order(), second_->highest_order()); }
  bool polynomial(std::size_t piece, std::size_t axis, Polynomial& out) const override;

 private:
  struct Begin {
    double t;
    std::size_t first, second;  // the piece of each summand
  };
  std::shared_ptr<const Motion> first_, second_;
  std::vector<Begin> begin_;
};

}  // namespace bahnwerk
