#pragma once
/// Where the pieces of a law lie within their segment, mm from its begin.
#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/verify/verifier.hpp"

namespace bahnwerk::verify {

/// A law counts s from the begin of the path and rounds it to ε s. Next to a vanishing tangent, or a tangent that all
/// but vanishes, curvature may change by its whole size within less than that, while v² falls as quickly as curvature
/// grows: what an axis does there cannot be told from rounded places. On such segments places are added up from the
/// pieces' own ways ∫v dt, beginning at the end of the segment where the tangent vanishes; that these ways agree with s
/// is another check (continuity of position). On all other segments a place is s − s0.
class LocalPlaces {
 public:
  explicit LocalPlaces(const VerifierInput& input) : in_(input) {}
  /// Of piece i, which lies in a segment of the path. O(1) where pieces are asked for in order.
  double begin(std::size_t i) { return summed(i) ? places_[i - first_] : piece(i).s - segment(i).s0(); }
  double end(std::size_t i) { return summed(i) ? places_[i - first_ + 1] : piece(i).s_end - segment(i).s0(); }
  /// Whether the piece ends where its segment does.
  bool at_end(std::size_t i) {
    return summed(i) ? !(end(i) < length(segment(i))) : !(piece(i).s_end < segment(i).s1());
  }
  /// The place at which the curve is looked at where piece i is at `s`: no nearer to a cusp than 64 ε of the segment's
  /// length, where u(s) is rounding and curvature anything. What bends there times v² is less than where it is looked
  /// at.
  double looked_at(std::size_t i, double s) { return summed(i) ? std::clamp(s, nearest_begin_, nearest_end_) : s; }

 private:
  const LawPiece& piece(std::size_t i) const { return in_.law.pieces()[i]; }
  const Segment& segment(std::size_t i) const { return in_.path[piece(i).segment]; }
  bool summed(std::size_t i);
  /// Of the curve itself: s1 − s0 is rounded as places are.
  static double length(const Segment& segment);

  const VerifierInput& in_;
  std::size_t first_ = 0, last_ = 0;  ///< pieces of the segment looked at last
  std::vector<double> places_;        ///< their ends; empty where s − s0 serves
  double nearest_begin_ = 0, nearest_end_ = 0;
};

}  // namespace bahnwerk::verify
