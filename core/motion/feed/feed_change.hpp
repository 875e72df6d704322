#pragma once
/// A change from one constant feed to another at a place of the path, as quick as all limits allow.
#include <cmath>
#include <optional>

#include "core/motion/feed/feed_limits.hpp"
#include "core/motion/law/time_law.hpp"
#include "core/motion/profile/speed_profile.hpp"

namespace bahnwerk {

/// A rise placed on a path: forwards from where the speed is lowest, or mirrored, so that the speed falls to there.
struct FeedChange {
  Rise rise;
  double low = 0;        ///< mm/s
  double s = 0;          ///< where the speed is `low`, mm
  bool forwards = true;  ///< rises from s; else falls to s

  double distance() const { return rise.distance(low); }
  double high() const { return low + rise.height; }
  double far_end() const { return forwards ? s + distance() : s - distance(); }
};

/// A piece of a rise, in its own direction, above the speed `low`, mm/s: as one of a law that begins at s = 0.
inline LawPiece law_piece(const RisePiece& piece, double low) {
  LawPiece law;
  law.duration = piece.duration;
  law.v = low + piece.v, law.a = piece.a, law.j = piece.j, law.q = piece.q;
  return law;
}
/// When a piece that goes forwards gets to s, between two times of it; to `exact` s or rounding.
double time_at(const LawPiece& piece, double s, double from, double to, double exact);

/// `grid` outlives it.
class FeedChanges {
 public:
  FeedChanges(const FeedGrid& grid, SpeedProfile profile) : grid_(grid), profile_(speed_profile_row(profile)) {}

  /// The quickest change between `low` and `high` > low at s that takes no more than `room` mm: with the acceleration
  /// and jerk that the limits along the path and the axes, standing, leave there; slowed as a whole (acceleration λ-,
  /// jerk λ²-fold) until all of it keeps every limit, at all nodes and at the ends of its pieces, with 0.1 % to spare
  /// of acceleration and jerk. None if there is no room, or λ falls below 0.02. About 0.1 µs per node and try.
  std::optional<FeedChange> find(double s, double low, double high, bool forwards, double room) const;

 private:
  double share(const FeedChange& change) const;

  const FeedGrid& grid_;
  const SpeedProfileRow& profile_;
};

}  // namespace bahnwerk
