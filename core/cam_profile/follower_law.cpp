#include "core/cam_profile/follower_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>
#include <utility>

#include "core/base/progress.hpp"
#include "core/cam/bernstein.hpp"

namespace bahnwerk::cam {
namespace {

constexpr std::size_t orders = 4, most_parts = 100000;

LawSeries<Disc> as_discs(const LawSeries<double>& y) {
  LawSeries<Disc> out;
  for (std::size_t k = 0; k < orders; ++k) out.c[k] = Disc(y.c[k]);
  return out;
}

/// A part of a piece: Bernstein coefficients of all derivatives over it.
struct Part {
  std::size_t piece = 0;
  double begin = 0, width = 1;  // interval of the piece's local parameter
  std::array<std::vector<double>, orders> derivative;
  double upper = HUGE_VAL;
  bool operator<(const Part& other) const { return upper < other.upper; }
};

LawSeries<Disc> enclosed(const Part& part) {
  LawSeries<Disc> out;
  double factorial = 1;
  for (std::size_t k = 0; k < orders; ++k) {
    if (k > 1) factorial *= static_cast<double>(k);
    const auto [low, high] = std::minmax_element(part.derivative[k].begin(), part.derivative[k].end());
    out.c[k] = Disc((*low + *high) / 2 / factorial, (*high - *low) / 2 / factorial);
  }
  return out;
}

class Search {
 public:
  Search(const FollowerLaw& law, const LawFunction& function, double accuracy, Progress progress)
      : law_(law), function_(function), accuracy_(accuracy), progress_(progress) {}

  CertifiedMaximum run() {
    best_.value = -HUGE_VAL;
    for (std::size_t i = 0; i < law_.pieces(); ++i) {
      Part part;
      part.piece = i;
      for (std::size_t k = 0; k < orders; ++k) part.derivative[k] = law_.derivative(i, k);
      for (const double x : {0.0, 0.25, 0.5, 0.75, 1.0}) attain(i, x);
      push(std::move(part));
    }
    for (std::size_t n = 0; !parts_.empty() && n < most_parts; ++n) {
      if (n % 256 == 0) progress_.report("cam", 0.9);
      if (parts_.top().upper <= best_.value + slack()) break;
      Part part = parts_.top();
      parts_.pop();
      if (part.width < 1e-12) {
        finished_ = std::max(finished_, part.upper);
        continue;
      }
      halve(part);
    }
    best_.upper = std::max(best_.value, finished_);
    if (!parts_.empty()) best_.upper = std::max(best_.upper, parts_.top().upper);
    return best_;
  }

 private:
  double slack() const { return 1e-7 * std::abs(best_.value) + accuracy_; }

  LawSeries<Disc> attain(std::size_t piece, double x) {
    const LawSeries<double> y = law_.at(piece, x);
    LawSeries<Disc> g = function_(as_discs(y));
    const double value = g.c[0].centre;
    if (value > best_.value) best_.value = value, best_.at = law_.begin(piece) + x * law_.width(piece), best_.law = y;
    return g;
  }

  void halve(const Part& whole) {
    Part left, right;
    left.piece = right.piece = whole.piece;
    left.width = right.width = whole.width / 2;
    left.begin = whole.begin, right.begin = whole.begin + left.width;
    for (std::size_t k = 0; k < orders; ++k) {
      const auto& b = whole.derivative[k];
      left.derivative[k].resize(b.size()), right.derivative[k].resize(b.size());
      bernstein_split(b, 0.5, left.derivative[k].data(), right.derivative[k].data());
    }
    push(std::move(left));
    push(std::move(right));
  }

  void push(Part part) {
    const double length = part.width * law_.width(part.piece);
    const LawSeries<Disc> middle = attain(part.piece, part.begin + part.width / 2), g = function_(enclosed(part));
    const Disc slope = g.c[1];
    double upper = HUGE_VAL;
    const auto bounded_by = [&](double bound) {
      if (bound < upper) upper = bound;  // a bound that is not a number is none
    };
    bounded_by(g.c[0].high());
    if (slope.known()) {
      bounded_by(middle.c[0].high() + slope.most() * length / 2);
      if (slope.low() > 0) bounded_by(attain(part.piece, part.begin + part.width).c[0].high());
      if (slope.high() < 0) bounded_by(attain(part.piece, part.begin).c[0].high());
    }
    part.upper = upper;
    if (upper <= best_.value + slack())
      finished_ = std::max(finished_, upper);
    else
      parts_.push(std::move(part));
  }

  const FollowerLaw& law_;
  const LawFunction& function_;
  double accuracy_;
  Progress progress_;
  CertifiedMaximum best_;
  double finished_ = -HUGE_VAL;  // largest bound of parts that are not looked at again
  std::priority_queue<Part> parts_;
};

}  // namespace

FollowerLaw::FollowerLaw(const CamLaw& law, double unit) {
  constexpr double turn = 2 * std::numbers::pi;
  const LawExtremes extremes = law.extremes(0);
  lowest_ = extremes.lowest.value;
  stroke_ = unit * (extremes.highest.value - lowest_);
  rate_ = turn / law.duration();
  for (std::size_t i = 0; i < law.pieces(); ++i) {
    Piece piece{law.breaks()[i] * rate_, law.piece_duration(i) * rate_, {}};
    std::vector<double> now = law.piece(i).bernstein;
    for (double& b : now) b = unit * (b - lowest_);
    piece.derivative[0] = now;
    for (std::size_t k = 1; k < orders; ++k) {
      std::vector<double> next(std::max<std::size_t>(1, now.size() - 1));
      next.resize(bernstein_derivative(now, next.data()));
      for (double& b : next) b /= piece.width;
      piece.derivative[k] = now = std::move(next);
    }
    pieces_.push_back(std::move(piece));
  }
}

LawSeries<double> FollowerLaw::at(std::size_t piece, double x) const {
  LawSeries<double> out;
  double factorial = 1;
  for (std::size_t k = 0; k < orders; ++k) {
    if (k > 1) factorial *= static_cast<double>(k);
    out.c[k] = bernstein_value(pieces_[piece].derivative[k], x) / factorial;
  }
  return out;
}

CertifiedMaximum certified_maximum(const FollowerLaw& law, const LawFunction& function, double accuracy,
                                   Progress progress) {
  return Search(law, function, accuracy, progress).run();
}

}  // namespace bahnwerk::cam
