#pragma once
/// A motion law s(t): path length over time as a piecewise polynomial of degree ≤ 4, continuous in s and v,
/// and in a where jerk is limited.
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/numeric/grow.hpp"
#include "core/numeric/large_pages.hpp"

namespace bahnwerk {

/// State of the law: s mm, v mm/s, a mm/s², j mm/s³.
struct LawState {
  double s = 0, v = 0, a = 0, j = 0;
};

/// s(t) = s + v τ + a τ²/2 + j τ³/6 + q τ⁴/24 with τ = t − t0 ∈ [0, duration]; it ends at path length `s_end`.
struct LawPiece {
  double t0 = 0, duration = 0;
  double s = 0, s_end = 0;
  double v = 0, a = 0, j = 0;
  std::size_t segment = 0;  ///< the path segment in which the whole piece lies
  double q = 0;             ///< snap, mm/s⁴: jerk changes evenly over the piece

  LawState at(double tau) const {
    return {s + tau * (v + tau * (a / 2 + tau * (j / 6 + tau * q / 24))), v + tau * (a + tau * (j / 2 + tau * q / 6)),
            a + tau * (j + tau * q / 2), j + tau * q};
  }
  bool constant_acceleration() const { return j == 0 && q == 0; }
  /// The same motion, lasting `factor` ≥ 1 times as long; t0 included.
  void slow(double factor) {
    t0 *= factor;
    duration *= factor;
    v /= factor;
    a /= factor * factor;
    j /= factor * factor * factor;
    q /= factor * factor * factor * factor;
  }
};

/// Where v (a = 0: the first two) and a (j = 0: the last) of a piece may turn, as τ; infinite where they do not. They
/// may lie outside the piece.
std::array<double, 3> turning_points(const LawPiece& piece);

class TimeLaw {
 public:
  /// Appends a piece behind the last one; its t0 is set here.
  void append(LawPiece piece);
  /// Appends all of these; their t0 are set here. Leaves `pieces` empty, an empty law takes their memory. O(pieces).
  void append_all(LargeVector<LawPiece>& pieces);
  /// Appends a piece to be filled in by the caller: no copy.
  LawPiece& next() {
    const double t = duration();
    LawPiece& piece = pieces_.emplace_back();
    piece.t0 = t;
    return piece;
  }
  /// Makes room for so many more pieces; where it has to grow, for `all` if that is known. Room that is not used costs
  /// nothing, growing again does.
  void reserve(std::size_t more, std::size_t all = 0) {
    const std::size_t least = pieces_.size() + more;
    if (least > pieces_.capacity()) pieces_.reserve(std::max({least, all, 3 * pieces_.capacity() / 2}));
  }
  void reserve(std::size_t more, std::size_t all, ProgressScope& pulse) {
    const std::size_t least = pieces_.size() + more;
    if (least > pieces_.capacity()) grow(pieces_, std::max(least, all), pulse);
  }
  /// Lets the last piece, which has to run at constant speed, go on to path length `s_end`.
  void extend(double s_end) {
    LawPiece& last = pieces_.back();
    last.s_end = s_end;
    last.duration = (s_end - last.s) / last.v;  // not a sum: over many cells that would round
  }
  const LargeVector<LawPiece>& pieces() const { return pieces_; }
  double duration() const { return pieces_.empty() ? 0.0 : pieces_.back().t0 + pieces_.back().duration; }
  /// Index of the piece that holds t. O(log n); O(log m) for the piece m behind the hint.
  std::size_t find(double t, std::size_t hint = 0) const {
    const std::size_t n = pieces_.size();
    const auto holds = [&](std::size_t i) { return pieces_[i].t0 <= t && (i + 1 == n || t < pieces_[i + 1].t0); };
    if (hint < n && holds(hint)) return hint;
    if (hint + 1 < n && holds(hint + 1)) return hint + 1;
    return search(t, hint);
  }
  /// Slows what lies between the two rests around each t to last `factor` ≥ 1 times as long, the largest one where
  /// there are several; what follows comes later. O(pieces).
  struct Slowing {
    double t, factor;
  };
  void slow_sections(std::vector<Slowing> sections);
  /// Keeps only the first pieces.
  void truncate(std::size_t pieces) { pieces_.resize(pieces); }
  /// Slows everything from piece `first` on to last `factor` ≥ 1 times as long. O(pieces).
  void slow_from(std::size_t first, double factor);
  /// The same motion, uniformly slowed: lasts `factor` times as long. O(pieces).
  void slow(double factor);
  TimeLaw slowed(double factor) const {
    TimeLaw law = *this;
    law.slow(factor);
    return law;
  }

 private:
  std::size_t search(double t, std::size_t hint) const;

  LargeVector<LawPiece> pieces_;
};

/// The largest speed of a law, mm/s. O(pieces).
double peak_speed(const TimeLaw& law);

}  // namespace bahnwerk
