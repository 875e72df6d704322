#pragma once
/// Writes a law of constant feeds and changes between them.
#include "core/geometry/path/path.hpp"
#include "core/motion/feed/feed_change.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// In order along the path, without gaps; pieces end where a segment of the path does. O(pieces + segments).
class FeedLawWriter {
 public:
  /// `law` and `path` outlive it; the law goes on at `begin`.
  FeedLawWriter(TimeLaw& law, const Path& path, double begin)
      : law_(law), path_(path), s_(begin), segment_(path.find(begin)) {}
  /// At speed v from where the law is to s.
  void hold(double v, double s);
  /// The change, from where the law is to `s_end`, which is where the change ends but for rounding.
  void change(const FeedChange& change, double s_end);

 private:
  void write(const LawPiece& whole, const LawState& goal);

  TimeLaw& law_;
  const Path& path_;
  double s_;
  std::size_t segment_;
};

}  // namespace bahnwerk
