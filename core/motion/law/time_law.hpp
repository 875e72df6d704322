#pragma once
/// A motion law s(t): path length over time as a piecewise polynomial of degree ≤ 4, continuous in s and v, and in a
/// where jerk is limited.
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/base/progress_scope.hpp"
#include "core/numeric/grow.hpp"
#include "core/numeric/large_pages.hpp"

namespace bahnwerk {

/// State of the law: path length s, mm; speed v, mm/s; acceleration a, mm/s²; jerk j, mm/s³.
struct LawState {
  double s = 0, v = 0, a = 0, j = 0;
};

/// A piece of the law: s(t) = s + v τ + a τ²/2 + j τ³/6 + snap τ⁴/24 with τ = t − t0 ∈ [0, duration]; it ends at path
/// length `s_end`.
struct LawPiece {
  double t0 = 0, duration = 0;  ///< s
  double s = 0, s_end = 0;      ///< mm
  double v = 0, a = 0, j = 0;   ///< state at the beginning, mm/s, mm/s², mm/s³
  std::size_t segment = 0;      ///< the path segment in which the whole piece lies
  double snap = 0;              ///< mm/s⁴; jerk is linear over the piece

  LawState at(double tau) const {
    return {s + tau * (v + tau * (a / 2 + tau * (j / 6 + tau * snap / 24))),
            v + tau * (a + tau * (j / 2 + tau * snap / 6)), a + tau * (j + tau * snap / 2), j + tau * snap};
  }
  bool constant_acceleration() const { return j == 0 && snap == 0; }
  /// Slows the motion to last `factor` ≥ 1 times as long; t0 is scaled, too.
  void slow(double factor) {
    t0 *= factor;
    duration *= factor;
    v /= factor;
    a /= factor * factor;
    j /= factor * factor * factor;
    snap /= factor * factor * factor * factor;
  }
};

/// Returns, as τ, the possible extrema of v (a = 0: the first two) and of a (j = 0: the last) of a piece; infinite
/// where there are none. They may lie outside the piece.
std::array<double, 3> turning_points(const LawPiece& piece);

/// Pieces in the order of time, without gaps.
class TimeLaw {
 public:
  /// Appends a piece; its t0 is set here.
  void append(LawPiece piece);
  /// Appends all pieces and sets their t0. Leaves `pieces` empty; an empty law takes over their memory. O(pieces).
  void append_all(LargeVector<LawPiece>& pieces);
  /// Appends a piece that the caller fills in, without a copy.
  LawPiece& next() {
    const double t = duration();
    LawPiece& piece = pieces_.emplace_back();
    piece.t0 = t;
    return piece;
  }
  /// Reserves memory for `more` pieces; if the vector has to grow, for `all` if that is known. Unused memory costs
  /// nothing, growing again does.
  void reserve(std::size_t more, std::size_t all = 0) {
    const std::size_t least = pieces_.size() + more;
    if (least > pieces_.capacity()) pieces_.reserve(std::max({least, all, 3 * pieces_.capacity() / 2}));
  }
  void reserve(std::size_t more, std::size_t all, ProgressScope& progress) {
    const std::size_t least = pieces_.size() + more;
    if (least > pieces_.capacity()) grow(pieces_, std::max(least, all), progress);
  }
  /// Extends the last piece, which has to run at constant speed, to path length `s_end`.
  void extend(double s_end) {
    LawPiece& last = pieces_.back();
    last.s_end = s_end;
    last.duration = (s_end - last.s) / last.v;  // a quotient; a sum would round over many cells
  }
  const LargeVector<LawPiece>& pieces() const { return pieces_; }
  double duration() const { return pieces_.empty() ? 0.0 : pieces_.back().t0 + pieces_.back().duration; }
  /// Returns the index of the piece that holds t. O(log n); O(log m) for the piece m behind the hint.
  std::size_t find(double t, std::size_t hint = 0) const {
    const std::size_t n = pieces_.size();
    const auto holds = [&](std::size_t i) { return pieces_[i].t0 <= t && (i + 1 == n || t < pieces_[i + 1].t0); };
    if (hint < n && holds(hint)) return hint;
    if (hint + 1 < n && holds(hint + 1)) return hint + 1;
    return search(t, hint);
  }
  /// Slows the part between the two rests around each t to last `factor` ≥ 1 times as long, by the largest factor where
  /// there are several; later pieces are shifted. O(pieces).
  struct Slowing {
    double t, factor;
  };
  void slow_sections(std::vector<Slowing> sections);
  /// Keeps the first `pieces` pieces only.
  void truncate(std::size_t pieces) { pieces_.resize(pieces); }
  /// Slows the pieces from `first` on, so that they last `factor` ≥ 1 times as long. O(pieces).
  void slow_from(std::size_t first, double factor);
  /// Slows the whole law uniformly to last `factor` times as long. O(pieces).
  void slow(double factor);
  /// Returns a slowed copy.
  TimeLaw slowed(double factor) const {
    TimeLaw law = *this;
    law.slow(factor);
    return law;
  }

 private:
  std::size_t search(double t, std::size_t hint) const;

  LargeVector<LawPiece> pieces_;
};

/// Returns the largest speed of a law, mm/s. O(pieces).
double peak_speed(const TimeLaw& law);

}  // namespace bahnwerk
