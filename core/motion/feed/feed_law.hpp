#pragma once
/// Writes a law of constant feeds and changes between them.
#include "core/geometry/path/path.hpp"
#include "core/motion/feed/feed_change.hpp"
#include "core/motion/law/time_law.hpp"

namespace bahnwerk {

/// Writes in order along the path, without gaps; pieces end where a segment of the path does. O(pieces + segments).
class FeedLawWriter {
 public:
  /// `law` and `path` have to outlive the object; the law continues at `begin`.
  FeedLawWriter(TimeLaw& law, const Path& path, double begin)
      : law_(law), path_(path), s_(begin), segment_(path.find(begin)) {}
  /// Continues at speed v from the end of the law to s.
  void hold(double v, double s);
  /// Appends the change, from the end of the law to `s_end`, which is the end of the change but for rounding.
  void change(const FeedChange& change, double s_end);

 private:
  void write(const LawPiece& whole, const LawState& goal);

  TimeLaw& law_;
  const Path& path_;
  double s_;
  std::size_t segment_;
};

}  // namespace bahnwerk
