#include "core/motion/feed/feed_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bahnwerk {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double nothing = 1e-9;  // part of the peak acceleration that counts as none

/// Returns a rise backwards in time.
RisePiece mirrored(const RisePiece& p) {
  const double T = p.duration;
  return {T, p.v + T * (p.a + T * (p.j / 2 + T * p.snap / 6)), -(p.a + T * (p.j + T * p.snap / 2)), p.j + T * p.snap,
          -p.snap};
}

}  // namespace

void FeedLawWriter::hold(double v, double s) {
  while (s_ < s) {
    const Segment& segment = path_[segment_];
    const double end = segment_ + 1 < path_.size() ? std::min(s, segment.s1()) : s;
    if (end - s_ > 8 * epsilon * end) {
      LawPiece& piece = law_.next();
      piece.duration = (end - s_) / v, piece.s = s_, piece.s_end = end, piece.v = v, piece.segment = segment_;
      s_ = end;
    } else {
      if (!law_.pieces().empty() && s == end) {  // it is shorter than s resolves: the piece before takes it
        break;
      }
      s_ = std::max(s_, end);
    }
    if (segment_ + 1 < path_.size() && s_ >= segment.s1()) ++segment_;
  }
}

void FeedLawWriter::change(const FeedChange& change, double s_end) {
  const auto pieces = change.rise.pieces();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const RisePiece p = change.forwards ? pieces[i] : mirrored(pieces[pieces.size() - 1 - i]);
    LawPiece piece = law_piece(p, change.low);
    piece.s = s_;
    const bool last = i + 1 == pieces.size();
    LawState end;  // state in which the next piece begins
    end.s = last ? s_end : piece.at(p.duration).s;
    if (last) {
      end.v = change.forwards ? change.high() : change.low;
      end.a = p.a + p.duration * (p.j + p.duration * p.snap / 2);
      if (std::abs(end.a) < nothing * change.rise.acceleration)
        end.a = 0;  // it is rounding, unless the profile's acceleration jumps
    } else {
      const RisePiece next = change.forwards ? pieces[i + 1] : mirrored(pieces[pieces.size() - 2 - i]);
      end.v = change.low + next.v, end.a = next.a;
    }
    write(piece, end);
  }
}

void FeedLawWriter::write(const LawPiece& whole, const LawState& goal) {
  const double s_end = goal.s;
  double tau = 0;
  while (segment_ + 1 < path_.size() && path_[segment_].s1() < s_end) {
    const double border = path_[segment_].s1();
    const bool there = s_end - border <= 8 * epsilon * s_end;
    if (there) break;
    if (border - s_ > 8 * epsilon * border) {
      const double until = time_at(whole, border, tau, whole.duration, epsilon * whole.duration);
      const LawState x = whole.at(tau);
      LawPiece& piece = law_.next();
      piece.duration = until - tau, piece.s = s_, piece.s_end = border, piece.segment = segment_;
      piece.v = x.v, piece.a = x.a, piece.j = x.j, piece.snap = whole.snap;
      tau = until;
    }
    s_ = std::max(s_, border);
    ++segment_;
  }
  const LawState x = whole.at(tau);
  LawPiece& piece = law_.next();
  piece.duration = whole.duration - tau, piece.s = s_, piece.segment = segment_;
  piece.v = x.v, piece.a = x.a, piece.j = x.j, piece.snap = whole.snap;
  if (tau > 0) {  // the rest is computed from its end: the rounding of the whole piece would be much for a short rest
    const double T = piece.duration;
    piece.a = goal.a - T * (piece.j + T * piece.snap / 2);
    piece.v = goal.v - T * (piece.a + T * (piece.j / 2 + T * piece.snap / 6));
  }
  s_ = piece.s_end = segment_ + 1 < path_.size() ? std::min(s_end, path_[segment_].s1()) : s_end;
  if (segment_ + 1 < path_.size() && s_ >= path_[segment_].s1()) ++segment_;
}

}  // namespace bahnwerk
