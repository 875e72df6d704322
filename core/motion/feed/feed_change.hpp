#pragma once
/// The fastest change from one constant feed to another at a place of the path.
#include <cmath>
#include <optional>

#include "core/motion/feed/feed_limits.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/motion/profile/speed_profile.hpp"

namespace bahnwerk {

/// A rise placed on a path: forwards from the place of the lowest speed, or mirrored, so that the speed falls to it.
struct FeedChange {
  Rise rise;
  double low = 0;        ///< lower speed, mm/s
  double s = 0;          ///< place at which the speed is `low`, mm
  bool forwards = true;  ///< whether the speed rises from s; otherwise it falls to s

  double distance() const { return rise.distance(low); }
  double high() const { return low + rise.height; }
  double far_end() const { return forwards ? s + distance() : s - distance(); }
};

/// Returns a piece of a rise, whose speed is above `low` mm/s, as a piece of a law that begins at s = 0.
inline LawPiece law_piece(const RisePiece& piece, double low) {
  LawPiece law;
  law.duration = piece.duration;
  law.v = low + piece.v, law.a = piece.a, law.j = piece.j, law.snap = piece.snap;
  return law;
}
/// Returns the time between `from` and `to` at which a piece that moves forwards reaches s; to `exact` s or rounding.
double time_at(const LawPiece& piece, double s, double from, double to, double exact);

/// `grid` has to outlive the object.
class FeedChanges {
 public:
  FeedChanges(const FeedGrid& grid, SpeedProfile profile) : grid_(grid), profile_(speed_profile_row(profile)) {}

  /// Returns the fastest change between `low` and `high` > low at s that takes at most `room` mm. It starts from the
  /// acceleration and jerk that the limits along the path and the axes allow at s, and is slowed as a whole
  /// (acceleration λ-fold, jerk λ²-fold) until every limit holds at all nodes and at the ends of its pieces, with a
  /// margin of 0.1 % of acceleration and jerk. Returns nothing if it does not fit, or λ falls below 0.02. About 0.1 µs
  /// per node and trial.
  std::optional<FeedChange> find(double s, double low, double high, bool forwards, double room) const;

 private:
  double share(const FeedChange& change) const;

  const FeedGrid& grid_;
  const SpeedProfileRow& profile_;
};

}  // namespace bahnwerk
