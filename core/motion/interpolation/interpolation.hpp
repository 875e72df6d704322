#pragma once
/// The places of all setpoints along a path, cycle by cycle, and how well they keep the feed.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/motion/interpolation/stepper.hpp"
#include "core/motion/law/path_motion.hpp"

namespace bahnwerk {

/// By how much the steps of all cycles differ from those that were wanted [Herrmann (3.113)]:
///
///   ε = |l̂ − l| / max(l̂, 10⁻³ l_max)
///
/// with l̂ the length that the step aimed at (core/motion/interpolation/stepper.hpp), l the one that it became, and
/// l_max the longest way that the law goes in one cycle: near rest steps are as short as rounding, and their ratio
/// would tell nothing. The source's l is the chord ‖s(u[k+1]) − s(u[k])‖; that of an exact step is shorter than the arc
/// by the fraction κ² l²/24, and the chord across a bend by more. So both are given.
struct FeedFluctuation {
  double mean = 0, largest = 0;  ///< l along the path: by quadrature of |s′|, not by the table of arc lengths
  double chord_mean = 0, chord_largest = 0;  ///< l the chord
  double lag = 0;    ///< the farthest that a setpoint is off the law's place, along the path, mm
  double drift = 0;  ///< the sum of l − l̂ over all steps, mm: what uncorrected steps would add up to
};

/// Places at k · cycle time, k = 0 … cycles, along a motion that lasts so many whole cycles. Row 0 is the path's begin;
/// the last row is its end, onto which the last step goes, whatever the interpolator. Immutable and thread-safe.
class Interpolation {
 public:
  /// Steps through all cycles once: 0.1 to 0.5 µs each (bench_interpolation), half of it the quadrature. Keeps the
  /// place of every 256th row. Tells `scope`.
  Interpolation(std::shared_ptr<const PathMotion> motion, Interpolator interpolator, double cycle_time,
                std::size_t cycles, ProgressScope& scope);

  const FeedFluctuation& fluctuation() const { return fluctuation_; }

  /// A row with its place, and the piece of the law that it lies on.
  struct Row {
    std::size_t index = 0, piece = 0;
    PathPlace place;
    LawState law;
  };
  /// O(256).
  Row row(std::size_t index) const;
  /// To the row after it; none behind the last. O(1).
  void advance(Row& row) const;

 private:
  void law_at(Row& row) const;
  void measure(ProgressScope& scope);

  std::shared_ptr<const PathMotion> motion_;
  Stepper stepper_;
  double cycle_time_;
  std::size_t cycles_;
  std::vector<Row> kept_;
  FeedFluctuation fluctuation_;
};

}  // namespace bahnwerk
