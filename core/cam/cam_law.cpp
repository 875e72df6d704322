#include "core/cam/cam_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

#include "core/cam/bernstein.hpp"
#include "core/numeric/gauss_legendre.hpp"

namespace bahnwerk::cam {
namespace {

/// Writes the coefficients of s^(order) of a piece to `out`; returns their number.
std::size_t derive(const LawPiece& piece, double duration, int order, BernsteinArray& out) {
  std::size_t size = piece.bernstein.size();
  std::copy(piece.bernstein.begin(), piece.bernstein.end(), out.begin());
  for (int r = 0; r < order; ++r) {
    if (size == 1) {
      out[0] = 0;
      return 1;
    }
    size = bernstein_derivative({out.data(), size}, out.data());
    for (std::size_t k = 0; k < size; ++k) out[k] /= duration;
  }
  return size;
}

}  // namespace

CamLaw::CamLaw(std::vector<double> breaks, std::vector<LawPiece> pieces, bool periodic, double travel)
    : breaks_(std::move(breaks)), pieces_(std::move(pieces)), periodic_(periodic), travel_(travel) {
  if (pieces_.empty() || breaks_.size() != pieces_.size() + 1) throw std::invalid_argument("a law without pieces");
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (!(breaks_[i] < breaks_[i + 1])) throw std::invalid_argument("breaks of a law do not ascend");
    if (pieces_[i].bernstein.empty() || pieces_[i].bernstein.size() > max_coefficients)
      throw std::invalid_argument("a law's degree");
    if (i > 0 && pieces_[i].section < pieces_[i - 1].section) throw std::invalid_argument("sections do not ascend");
  }
}

std::size_t CamLaw::max_degree() const {
  std::size_t degree = 0;
  for (const LawPiece& piece : pieces_) degree = std::max(degree, piece.degree());
  return degree;
}

double CamLaw::evaluate(double t, int order, std::size_t& piece) const {
  double cycles = 0;
  if (periodic_) {
    const double whole = duration();
    cycles = std::floor((t - begin()) / whole);
    t -= whole * cycles;
    if (t < begin()) t = begin();
    if (t >= breaks_.back()) t = begin(), ++cycles;
  }
  t = std::clamp(t, breaks_.front(), breaks_.back());
  if (piece >= pieces_.size() || t < breaks_[piece] || t >= breaks_[piece + 1]) {
    const auto next = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, t);
    piece = static_cast<std::size_t>(next - breaks_.begin()) - 1;
  }
  const double value = in_piece(piece, (t - breaks_[piece]) / piece_duration(piece), order);
  return order == 0 ? value + cycles * travel_ : value;
}

double CamLaw::in_piece(std::size_t piece, double x, int order) const {
  BernsteinArray b;
  const std::size_t size = derive(pieces_[piece], piece_duration(piece), order, b);
  return bernstein_value({b.data(), size}, std::clamp(x, 0.0, 1.0));
}

std::vector<double> CamLaw::derivative(std::size_t piece, int order) const {
  BernsteinArray b;
  const std::size_t size = derive(pieces_[piece], piece_duration(piece), order, b);
  return {b.begin(), b.begin() + static_cast<std::ptrdiff_t>(size)};
}

LawPeak CamLaw::peak(int order, std::size_t piece) const {
  BernsteinArray b;
  const std::size_t size = derive(pieces_[piece], piece_duration(piece), order, b);
  BernsteinExtremes found{0, 0};
  take_extremes({b.data(), size}, found);
  const bool high = found.high >= -found.low;
  const double at = std::max(0.0, high ? found.high_at : found.low_at);
  return {high ? found.high : -found.low, breaks_[piece] + at * piece_duration(piece), piece};
}

double CamLaw::mean_square(int order, std::size_t first, std::size_t end) const {
  double sum = 0, whole = 0;
  for (std::size_t i = first; i < end; ++i) {
    const std::vector<double> b = derivative(i, order);
    for (const auto& [place, weight] : gauss_legendre<21>()) {  // exact up to degree 41 of the square
      const double value = bernstein_value(b, (1 + place) / 2);
      sum += weight / 2 * piece_duration(i) * value * value;
    }
    whole += piece_duration(i);
  }
  return sum / whole;
}

double CamLaw::rms(int order) const { return std::sqrt(mean_square(order, 0, pieces_.size())); }

double CamLaw::section_rms(int order, std::size_t section) const {
  std::size_t first = 0;
  while (pieces_[first].section < section) ++first;
  std::size_t end = first;
  while (end < pieces_.size() && pieces_[end].section == section) ++end;
  return std::sqrt(mean_square(order, first, end));
}

LawPeak CamLaw::peak(int order) const {
  LawPeak best{0, begin(), 0};
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    BernsteinArray b;
    const std::size_t size = derive(pieces_[i], piece_duration(i), order, b);
    BernsteinExtremes found{-best.value, best.value};
    take_extremes({b.data(), size}, found);
    const bool high = found.high >= -found.low;
    const double value = high ? found.high : -found.low, at = high ? found.high_at : found.low_at;
    if (at >= 0 && value > best.value) best = {value, breaks_[i] + at * piece_duration(i), i};
  }
  return best;
}

LawExtremes CamLaw::section_extremes(int order, std::size_t section) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  LawExtremes out{{infinity, begin(), 0}, {-infinity, begin(), 0}};
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (section != static_cast<std::size_t>(-1) && pieces_[i].section != section) continue;
    BernsteinArray b;
    const std::size_t size = derive(pieces_[i], piece_duration(i), order, b);
    BernsteinExtremes found{out.lowest.value, out.highest.value};
    take_extremes({b.data(), size}, found);
    if (found.low_at >= 0) out.lowest = {found.low, breaks_[i] + found.low_at * piece_duration(i), i};
    if (found.high_at >= 0) out.highest = {found.high, breaks_[i] + found.high_at * piece_duration(i), i};
  }
  return out;
}

LawExtremes CamLaw::extremes(int order) const { return section_extremes(order, static_cast<std::size_t>(-1)); }

}  // namespace bahnwerk::cam
