#include "core/motion/law/time_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bahnwerk {

std::array<double, 3> turning_points(const LawPiece& p) {
  constexpr double never = std::numeric_limits<double>::infinity();
  std::array<double, 3> at{never, never, never};
  if (p.snap == 0) {
    if (p.j != 0) at[0] = -p.a / p.j;
    return at;
  }
  at[2] = -p.j / p.snap;
  // Solves a + j τ + snap τ²/2 = 0 without cancellation.
  const double root = p.j * p.j - 2 * p.a * p.snap;
  if (root >= 0) {
    const double sum = -(p.j + std::copysign(std::sqrt(root), p.j));
    at[0] = sum / p.snap;
    if (sum != 0) at[1] = 2 * p.a / sum;
  }
  return at;
}

void TimeLaw::append(LawPiece piece) {
  piece.t0 = duration();
  pieces_.push_back(piece);
}

void TimeLaw::append_all(LargeVector<LawPiece>& pieces) {
  double at = duration();
  for (LawPiece& piece : pieces) {
    piece.t0 = at;
    at += piece.duration;
  }
  if (pieces_.empty()) {
    pieces_.swap(pieces);
  } else {
    reserve(pieces.size());
    pieces_.insert(pieces_.end(), pieces.begin(), pieces.end());
  }
  pieces.clear();
}

std::size_t TimeLaw::search(double t, std::size_t hint) const {
  auto begin = pieces_.begin(), end = pieces_.end();
  if (hint < pieces_.size() && pieces_[hint].t0 <= t) {  // ahead, in steps that double
    std::size_t step = 4;
    for (; step < pieces_.size() - hint && pieces_[hint + step].t0 <= t; step *= 2) hint += step;
    begin += static_cast<std::ptrdiff_t>(hint);
    if (step < pieces_.size() - hint) end = begin + static_cast<std::ptrdiff_t>(step);
  }
  const auto after = std::upper_bound(begin, end, t, [](double x, const LawPiece& p) { return x < p.t0; });
  return after == pieces_.begin() ? 0 : static_cast<std::size_t>(after - pieces_.begin()) - 1;
}

void TimeLaw::slow_from(std::size_t first, double factor) {
  double at = first < pieces_.size() ? pieces_[first].t0 : 0;
  for (std::size_t i = first; i < pieces_.size(); ++i) {
    pieces_[i].slow(factor);
    pieces_[i].t0 = at;
    at += pieces_[i].duration;
  }
}

void TimeLaw::slow_sections(std::vector<Slowing> sections) {
  std::sort(sections.begin(), sections.end(), [](const Slowing& a, const Slowing& b) { return a.t < b.t; });
  bool moved = false;
  double at = 0;
  std::size_t first = 0, last = 0;
  for (auto next = sections.begin(); first < pieces_.size() && (moved || next != sections.end()); first = last) {
    for (last = first + 1; last < pieces_.size() && pieces_[last].v > 0;) ++last;
    double factor = 1;
    for (; next != sections.end() && (last == pieces_.size() || next->t < pieces_[last].t0); ++next)
      factor = std::max(factor, next->factor);
    if (!moved) at = pieces_[first].t0;
    moved = moved || factor > 1;
    for (std::size_t i = first; moved && i < last; ++i) {
      if (factor > 1) pieces_[i].slow(factor);
      pieces_[i].t0 = at;
      at += pieces_[i].duration;
    }
  }
}

void TimeLaw::slow(double factor) {
  for (LawPiece& p : pieces_) p.slow(factor);
}

double peak_speed(const TimeLaw& law) {
  double most = 0;
  for (const LawPiece& piece : law.pieces()) {
    most = std::max({most, piece.v, piece.at(piece.duration).v});
    for (const double tau : turning_points(piece))
      if (tau > 0 && tau < piece.duration) most = std::max(most, piece.at(tau).v);
  }
  return most;
}

}  // namespace bahnwerk
