#pragma once
/// Places of the pieces of a law within their segment, mm from its beginning.
#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/verify/law/verifier.hpp"

namespace bahnwerk::verify {

/// A law counts s from the beginning of the path and rounds it to ε s. Next to a (nearly) vanishing tangent curvature
/// may change by its own magnitude over a shorter distance, while v² falls as quickly as curvature grows: the motion of
/// an axis cannot be computed there from rounded places. On such segments places are summed from the pieces' own
/// lengths ∫v dt, beginning at the end of the segment where the tangent vanishes; another check (continuity of
/// position) compares these lengths with s. On all other segments a place is s − s0.
class LocalPlaces {
 public:
  explicit LocalPlaces(const VerifierInput& input) : in_(input) {}
  /// Returns the beginning of piece i, which lies in a segment of the path. O(1) for queries in order.
  double begin(std::size_t i) { return summed(i) ? places_[i - first_] : piece(i).s - segment(i).s0(); }
  /// Returns the end of piece i.
  double end(std::size_t i) { return summed(i) ? places_[i - first_ + 1] : piece(i).s_end - segment(i).s0(); }
  /// Returns whether the piece ends where its segment does.
  bool at_end(std::size_t i) {
    return summed(i) ? !(end(i) < length(segment(i))) : !(piece(i).s_end < segment(i).s1());
  }
  /// Returns the place at which the curve is evaluated where piece i is at `s`: no nearer to a cusp than 64 ε of the
  /// segment's length. Nearer, rounding determines u(s), and curvature is arbitrary. Curvature times v² is smaller
  /// there than at the place returned.
  double looked_at(std::size_t i, double s) { return summed(i) ? std::clamp(s, nearest_begin_, nearest_end_) : s; }

 private:
  const LawPiece& piece(std::size_t i) const { return in_.law.pieces()[i]; }
  const Segment& segment(std::size_t i) const { return in_.path[piece(i).segment]; }
  bool summed(std::size_t i);
  /// Returns the length of the curve itself: s1 − s0 is rounded as places are.
  static double length(const Segment& segment);

  const VerifierInput& in_;
  std::size_t first_ = 0, last_ = 0;  ///< pieces of the segment of the last query
  std::vector<double> places_;        ///< places of the pieces' ends; empty where s − s0 suffices
  double nearest_begin_ = 0, nearest_end_ = 0;
};

}  // namespace bahnwerk::verify
