#pragma once
/// The places of all setpoints along a path, cycle by cycle, and the error of their feed.
#include <cstddef>
#include <memory>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/motion/interpolation/stepper.hpp"
#include "core/motion/law/path_motion.hpp"

namespace bahnwerk {

/// Relative error of the steps of all cycles [Herrmann (3.113)]:
///
///   ε = |l̂ − l| / max(l̂, 10⁻³ l_max)
///
/// with l̂ the length that the step aimed at (core/motion/interpolation/stepper.hpp), l the length that it has, and
/// l_max the largest length that the law covers in one cycle: near rest steps are as short as rounding, and their ratio
/// would have no meaning. The source's l is the chord ‖s(u[k+1]) − s(u[k])‖; the chord of an exact step is shorter than
/// the arc by the fraction κ² l²/24, and by more across a corner. Both are therefore computed.
struct FeedFluctuation {
  double mean = 0, largest = 0;  ///< l along the path: by quadrature of |s′|, independent of the table of arc lengths
  double chord_mean = 0, chord_largest = 0;  ///< l along the chord
  double lag = 0;    ///< largest distance of a setpoint from the law's place, along the path, mm
  double drift = 0;  ///< the sum of l − l̂ over all steps, mm: the error of uncorrected steps
};

/// Places at k · cycle time, k = 0 … cycles, along a motion that lasts a whole number of cycles. Row 0 is the path's
/// beginning, the last row its end for every interpolator. Immutable and thread-safe.
class Interpolation {
 public:
  /// Steps through all cycles once: 0.1 to 0.5 µs each (bench_interpolation), half of it for the quadrature. Stores the
  /// place of every 256th row. Reports to `progress`.
  Interpolation(std::shared_ptr<const PathMotion> motion, Interpolator interpolator, double cycle_time,
                std::size_t cycles, ProgressScope& progress);

  const FeedFluctuation& fluctuation() const { return fluctuation_; }

  /// A row with its place, and the piece of the law that contains it.
  struct Row {
    std::size_t index = 0, piece = 0;
    PathPlace place;
    LawState law;
  };
  /// O(256).
  Row row(std::size_t index) const;
  /// Advances to the next row; the last row has none. O(1).
  void advance(Row& row) const;

 private:
  void law_at(Row& row) const;
  void measure(ProgressScope& progress);

  std::shared_ptr<const PathMotion> motion_;
  Stepper stepper_;
  double cycle_time_;
  std::size_t cycles_;
  std::vector<Row> kept_;
  FeedFluctuation fluctuation_;
};

}  // namespace bahnwerk
